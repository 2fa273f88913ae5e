"""Figs. 12-16, 22 and 23: homes, maps, regions, convexity, paths."""

from __future__ import annotations

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from app.reproduction.extraction_snapshots import Snapshot
from app.reproduction.figures.colours import (
    ADDED,
    GONE,
    MAP_SCALE,
    PATH,
    REJECTED,
    UPDATED,
)
from app.reproduction.figures.layers import (
    LAYOUT,
    PANEL_HEIGHT,
    as_map,
    graph_layers,
    grid_layer,
    image,
    path_layer,
    region_layers,
    robot_layer,
)
from app.reproduction.localized_drive import LocalizedDrive
from app.reproduction.paper_home_models import NodeConvexity
from core.geometry import FloatArray
from core.simulation.home_truth import HomeTruth
from core.topology import Model

THRESHOLD = 0.2
"""c_t (paper, 5.1)."""


def home_figure(truth: HomeTruth, path: FloatArray) -> go.Figure:
    """Fig. 12: the home as it really is, and the true mapping drive (N, 3)."""
    state = truth.occupied * 1 + 1
    figure = go.Figure(
        [image(state, truth.geometry, colorscale=MAP_SCALE, zmin=0, zmax=2), path_layer(path)]
    )
    return _one_map(figure)


def map_figure(model: Model) -> go.Figure:
    """The grid map that all models of the home are made from."""
    layers = [grid_layer(model.grid)]
    if model.trajectory is not None:
        layers.append(path_layer(model.trajectory.poses, width=1))
    return _one_map(go.Figure(layers))


def model_figure(model: Model) -> go.Figure:
    """Fig. 13: regions, and the topology extracted from them."""
    figure = make_subplots(1, 2, subplot_titles=("(a) regions", "(b) topology"))
    figure.add_traces(region_layers(model.grid, model.regions), rows=1, cols=1)
    figure.add_traces([grid_layer(model.grid), *graph_layers(model)], rows=1, cols=2)
    as_map(figure)
    return figure.update_layout(height=PANEL_HEIGHT, **LAYOUT)


def extraction_figure(snapshots: tuple[Snapshot, ...], model: Model) -> go.Figure:
    """Fig. 14: regions extracted so far, and the final model."""
    titles = [f"({'abcdefgh'[i]}) after {s.t:.0f} s" for i, s in enumerate(snapshots)]
    titles.append(f"({'abcdefgh'[len(snapshots)]}) the model")
    columns = 2
    rows = (len(titles) + columns - 1) // columns
    figure = make_subplots(rows, columns, subplot_titles=titles, vertical_spacing=0.08)
    for i, snapshot in enumerate(snapshots):
        place = {"rows": i // columns + 1, "cols": i % columns + 1}
        figure.add_traces(region_layers(snapshot.grid, snapshot.regions), **place)
        figure.add_traces([robot_layer(snapshot.pose, PATH)], **place)
    place = {"rows": len(snapshots) // columns + 1, "cols": len(snapshots) % columns + 1}
    final = [*region_layers(model.grid, model.regions), *graph_layers(model)]
    figure.add_traces(final, **place)
    as_map(figure)
    return figure.update_layout(height=PANEL_HEIGHT * rows, **LAYOUT)


def convexity_figure(measures: tuple[NodeConvexity, ...]) -> go.Figure:
    """Fig. 15: the measure of eq. (7) for each node, and what else can be meant by it."""
    nodes = [m.node for m in measures]
    bars = {
        "eq. (7) as printed": ([m.as_printed for m in measures], "#4c78a8"),
        "eq. (7), unknown grids counted": ([m.with_unknown for m in measures], "#f58518"),
        "hidden pairs (default)": ([m.hidden_pairs for m in measures], "#54a24b"),
    }
    figure = go.Figure(
        [
            go.Bar(x=nodes, y=[round(v, 4) for v in values], name=name, marker_color=colour)
            for name, (values, colour) in bars.items()
        ]
    )
    figure.add_hline(y=THRESHOLD, line_dash="dash", annotation_text="c_t = 0.2")
    layout = LAYOUT | {"showlegend": True, "legend": {"orientation": "h", "y": 1.12}}
    return figure.update_layout(
        barmode="group", xaxis_title="node", yaxis_title="convexity measure", height=380, **layout
    )


def changes_figure(before: HomeTruth, after: HomeTruth) -> go.Figure:
    """Fig. 22: what has changed in the home."""
    gone, added = before.occupied & ~after.occupied, after.occupied & ~before.occupied
    shown = before.occupied * 1
    shown[gone], shown[added] = 2, 3
    scale = [[0.0, "#fff"], [1 / 3, "#22252b"], [2 / 3, GONE], [1.0, ADDED]]
    figure = go.Figure([image(shown, before.geometry, colorscale=scale, zmin=0, zmax=3)])
    return _one_map(figure)


def path_figure(model: Model, drive: LocalizedDrive, method: str) -> go.Figure:
    """Figs. 16 and 23: the true path on the map; numbers where a step was made."""
    steps = drive.steps[method]
    at = [int(abs(drive.log.t - step.t).argmin()) for step in steps]
    colours = [UPDATED if step.updated else REJECTED for step in steps]
    numbers = go.Scatter(
        x=drive.truth[at, 0].round(3),
        y=drive.truth[at, 1].round(3),
        mode="markers+text",
        text=[str(step.step) for step in steps],
        textfont={"size": 10, "color": "#fff"},
        marker={"size": 18, "color": colours},
        hovertext=[step.why for step in steps],
        hoverinfo="text",
    )
    return _one_map(go.Figure([grid_layer(model.grid), path_layer(drive.truth), numbers]))


def _one_map(figure: go.Figure) -> go.Figure:
    as_map(figure)
    return figure.update_layout(height=PANEL_HEIGHT + 60, **LAYOUT)
