"""What figures of a map are put together from: plotly traces in world coordinates (metres)."""

from __future__ import annotations

from typing import Any

import numpy as np
import plotly.graph_objects as go

from app.reproduction.figures.colours import MAP_SCALE, PATH, TEMPLATE, region_colour
from core.geometry import AnyArray, FloatArray, IntArray
from core.mapping import GridGeometry, OccupancyGrid
from core.topology import Model

PANEL_HEIGHT = 430
"""Pixels of one map."""
NODE_SIZE, ARROW = 20, 0.5
"""Pixels of a node, metres of a heading."""
LAYOUT: dict[str, Any] = {
    "template": "plotly_white",
    "font": {"family": "system-ui, sans-serif", "size": 13},
    "margin": {"l": 50, "r": 20, "t": 40, "b": 45},
    "showlegend": False,
}


def axes(geometry: GridGeometry) -> tuple[FloatArray, FloatArray]:
    """World x of the columns and y of the rows of a grid that is not turned."""
    rows, cols = geometry.shape
    x = geometry.origin[0] + (np.arange(cols) + 0.5) * geometry.resolution
    y = geometry.origin[1] + (np.arange(rows) + 0.5) * geometry.resolution
    return np.round(x, 3), np.round(y, 3)


def image(values: AnyArray, geometry: GridGeometry, **how: Any) -> go.Heatmap:
    """A label image or grid (rows, cols) at its place in the world."""
    x, y = axes(geometry)
    shown = {"showscale": False, "hoverinfo": "skip", **how}
    return go.Heatmap(z=values.astype(np.uint8), x=x, y=y, **shown)


def grid_layer(grid: OccupancyGrid) -> go.Heatmap:
    """A trinary map."""
    return image(grid.state, grid.geometry, colorscale=MAP_SCALE, zmin=0, zmax=2)


def region_layers(grid: OccupancyGrid, regions: IntArray) -> list[go.Heatmap]:
    """A map with its regions coloured."""
    values = [int(v) for v in np.unique(regions[regions > 0])]
    dense = np.searchsorted(values, regions) + 1
    shown = np.where((regions > 0) & grid.free, dense, 0)
    layers = [grid_layer(grid)]
    if values:
        scale = [[0.0, "rgba(0,0,0,0)"]]
        scale += [[(i + 1) / len(values), region_colour(v)] for i, v in enumerate(values)]
        layers.append(image(shown, grid.geometry, colorscale=scale, zmin=0, zmax=len(values)))
    return layers


def graph_layers(model: Model) -> list[go.Scatter]:
    """Nodes and edges; an edge runs through its doorway."""
    at = {node.id: node.position for node in model.topology.nodes}
    x: list[float | None] = []
    y: list[float | None] = []
    for edge in model.topology.edges:
        for point in (at[edge.source], edge.doorway, at[edge.target]):
            x.append(round(point[0], 3))
            y.append(round(point[1], 3))
        x.append(None)
        y.append(None)
    nodes = model.topology.nodes
    lines = {"mode": "lines", "line": {"color": "#444", "width": 2}, "hoverinfo": "skip"}
    marks = go.Scatter(
        x=[round(n.position[0], 3) for n in nodes],
        y=[round(n.position[1], 3) for n in nodes],
        mode="markers+text",
        text=[n.id for n in nodes],
        textfont={"size": 11, "color": "#111"},
        hovertext=[f"{n.name}: {n.area_m2:.1f} m2" for n in nodes],
        hoverinfo="text",
        marker={
            "size": NODE_SIZE,
            "color": "#fff",
            "line": {"color": [region_colour(n.region) for n in nodes], "width": 3},
        },
    )
    return [go.Scatter(x=x, y=y, **lines), marks]


def path_layer(poses: FloatArray, colour: str = PATH, width: float = 1.5) -> go.Scatter:
    """A driven path (N, 2 or 3), thinned to what can be seen."""
    shown = np.round(poses[:: max(1, len(poses) // 600), :2], 3)
    line = {"color": colour, "width": width}
    return go.Scatter(x=shown[:, 0], y=shown[:, 1], mode="lines", line=line, hoverinfo="skip")


def points_layer(points: FloatArray, colour: str = TEMPLATE, size: float = 3.5) -> go.Scatter:
    """Points (N, 2)."""
    shown = np.round(points, 3)
    marker = {"color": colour, "size": size}
    return go.Scatter(x=shown[:, 0], y=shown[:, 1], mode="markers", marker=marker, hoverinfo="skip")


def robot_layer(pose: FloatArray, colour: str) -> go.Scatter:
    """A robot: a circle and its heading."""
    tip = pose[:2] + ARROW * np.array([np.cos(pose[2]), np.sin(pose[2])])
    return go.Scatter(
        x=[round(float(pose[0]), 3), round(float(tip[0]), 3)],
        y=[round(float(pose[1]), 3), round(float(tip[1]), 3)],
        mode="lines+markers",
        line={"color": colour, "width": 3},
        marker={"size": [11, 1], "color": colour},
        hoverinfo="skip",
    )


def as_map(figure: go.Figure, row: int | None = None, col: int | None = None) -> None:
    """Metres alike in both directions, no grid lines."""
    place = {} if row is None else {"row": row, "col": col}
    plain = {"showgrid": False, "zeroline": False}
    figure.update_xaxes(constrain="domain", ticksuffix=" m", **plain, **place)
    figure.update_yaxes(constrain="domain", **plain, **place)
    for axis in figure.select_yaxes(**place):
        axis.scaleanchor = axis.anchor or "x"
