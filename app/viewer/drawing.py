"""Everything that is drawn of a model, computed once, without viser: run it in a thread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull

from app.viewer.cell_tiles import Tiles, cell_tiles
from app.viewer.contour_mesh import Extrusion, extrude
from app.viewer.display_grid import DisplayGrid, tidy
from app.viewer.drift_drawing import DriftDrawing, draw_drift
from app.viewer.floor_image import (
    DARK,
    LIGHT,
    FloorConfig,
    Picture,
    grid_picture,
    picture_scale,
    region_picture,
    region_shapes,
)
from app.viewer.graph_shapes import (
    GraphConfig,
    doorways,
    edge_segments,
    node_centres,
    node_radii,
    stem_segments,
)
from app.viewer.palette import Colour, node_colours
from app.viewer.paths import path_segments
from core.geometry import FloatArray, IntArray
from core.mapping.occupancy_grid import GridGeometry
from core.topology import Model
from core.topology.timeline import moments

PATH_HEIGHT = 0.06


@dataclass(frozen=True)
class DrawingConfig:
    """Heights in metres, and the configs of the parts."""

    wall_height: float = 1.15
    furniture_height: float = 0.45
    ordinary_extent: float = 16.0
    """Diagonal of a home in which the marks have their own size; larger ones get larger marks."""
    most_mark_scale: float = 3.0
    floor: FloorConfig = field(default_factory=FloorConfig)
    graph: GraphConfig = field(default_factory=GraphConfig)


@dataclass(frozen=True)
class Floor:
    """The pictures of one theme."""

    grid: Picture
    regions: Picture


@dataclass(frozen=True)
class NodeMark:
    """A node as it is drawn; `centre` is the sphere's (x, y, z)."""

    id: str
    region: int
    centre: tuple[float, float, float]
    radius: float
    area: float
    colour: Colour
    label: str | None


@dataclass(frozen=True)
class Drawing:
    """What the scene consists of, in world metres.

    Attributes:
        outline: (K, 2) convex hull of everything that is drawn.
        mark_scale: how much thicker marks (nodes, lines) are than in an ordinary home.
        floors: pictures of the themes "light" and "dark"; `floor_margin` metres wider than the grid.
        edges, stems, path: (M, 2, 3) line segments.
        doors: (E, 3).
        moments: the steps of the drive that made the model, each with its decisions.
        step_pictures: what each of them looked like.
        drift: the drive before and after its correction; None where that was not kept.
    """

    geometry: GridGeometry
    outline: FloatArray
    mark_scale: float
    display: DisplayGrid
    regions: IntArray
    floors: Mapping[str, Floor]
    floor_margin: float
    walls: Extrusion
    furniture: Extrusion
    nodes: tuple[NodeMark, ...]
    edges: FloatArray
    stems: FloatArray
    doors: FloatArray
    path: FloatArray
    tiles: Tiles
    wall_height: float
    furniture_height: float
    moments: Sequence[Mapping[str, Any]] = ()
    step_pictures: Sequence[bytes] = ()
    drift: DriftDrawing | None = None


def draw(
    model: Model, config: DrawingConfig | None = None, earlier: Drawing | None = None
) -> Drawing:
    """The drawing of a model; nodes keep the hues of an earlier drawing of it."""
    config = config or DrawingConfig()
    grid, topology = model.grid, model.topology
    display = tidy(grid)
    before = {node.id: node.colour for node in earlier.nodes} if earlier is not None else {}
    colours = node_colours(topology, model.regions, before)
    scale = picture_scale(grid.geometry.shape, config.floor)
    region_colours = {node.region: colours[node.id] for node in topology.nodes}
    shapes = region_shapes(model.regions, display, config.floor, scale, grid.geometry.resolution)
    floors = {
        name: Floor(
            grid_picture(grid, display, theme, config.floor, scale),
            region_picture(shapes, region_colours, theme),
        )
        for name, theme in (("light", LIGHT), ("dark", DARK))
    }
    outline = _outline(display, model)
    extent = float(np.linalg.norm(np.ptp(outline, axis=0)))
    scale_of_marks = float(np.clip(extent / config.ordinary_extent, 1.0, config.most_mark_scale))
    centres = node_centres(topology, config.graph)
    poses = model.trajectory.poses if model.trajectory is not None else np.zeros((0, 3))
    margin_cells = int(np.ceil(config.floor.margin / grid.geometry.resolution))
    return Drawing(
        geometry=grid.geometry,
        outline=outline,
        mark_scale=scale_of_marks,
        display=display,
        regions=model.regions,
        floors=floors,
        floor_margin=margin_cells * grid.geometry.resolution,
        walls=extrude(display.walls, display.level, config.wall_height, grid.geometry),
        furniture=extrude(display.furniture, display.level, config.furniture_height, grid.geometry),
        nodes=tuple(
            NodeMark(
                node.id,
                node.region,
                (float(x), float(y), float(z)),
                float(radius) * scale_of_marks,
                node.area_m2,
                colours[node.id],
                node.label,
            )
            for node, (x, y, z), radius in zip(
                topology.nodes, centres, node_radii(topology, config.graph), strict=True
            )
        ),
        edges=edge_segments(topology, config.graph),
        stems=stem_segments(centres),
        doors=doorways(topology, config.graph),
        path=path_segments(poses, PATH_HEIGHT),
        tiles=cell_tiles(model, region_colours),
        wall_height=config.wall_height,
        furniture_height=config.furniture_height,
        moments=moments(model.history),
        step_pictures=model.timeline,
        drift=draw_drift(model),
    )


def relabelled(drawing: Drawing, labels: Mapping[str, str | None]) -> Drawing:
    """The same drawing with other labels."""
    nodes = tuple(replace(node, label=labels.get(node.id)) for node in drawing.nodes)
    return replace(drawing, nodes=nodes)


def _outline(display: DisplayGrid, model: Model) -> FloatArray:
    """Convex hull of what is drawn, of the whole grid while nothing is."""
    geometry = model.grid.geometry
    drawn = display.floor | display.solid
    if not drawn.any():
        drawn = np.ones(geometry.shape, bool)
    rows = np.flatnonzero(drawn.any(axis=1))
    first = drawn[rows].argmax(axis=1)
    last = drawn.shape[1] - 1 - drawn[rows, ::-1].argmax(axis=1)
    ends = np.concatenate((np.column_stack((rows, first)), np.column_stack((rows, last))))
    corners = np.array([(-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)])
    cells = (ends[:, None] + corners).reshape(-1, 2)
    return geometry.world_of(cells[ConvexHull(cells).vertices])
