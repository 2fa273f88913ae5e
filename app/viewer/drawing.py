"""Everything that is drawn of a model, computed once, without viser: run it in a thread."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from app.viewer.cell_tiles import Tiles, cell_tiles
from app.viewer.contour_mesh import Extrusion, extrude
from app.viewer.display_grid import DisplayGrid, tidy
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

PATH_HEIGHT = 0.06


@dataclass(frozen=True)
class DrawingConfig:
    """Heights in metres, and the configs of the parts."""

    wall_height: float = 1.15
    furniture_height: float = 0.45
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
        bounds: (x0, y0, x1, y1) of everything known.
        floors: pictures of the themes "light" and "dark"; `floor_margin` metres wider than the grid.
        edges, stems, path: (M, 2, 3) line segments.
        doors: (E, 3).
    """

    geometry: GridGeometry
    bounds: tuple[float, float, float, float]
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
    centres = node_centres(topology, config.graph)
    poses = model.trajectory.poses if model.trajectory is not None else np.zeros((0, 3))
    margin_cells = int(np.ceil(config.floor.margin / grid.geometry.resolution))
    return Drawing(
        geometry=grid.geometry,
        bounds=_bounds(display, model),
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
                float(radius),
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
    )


def relabelled(drawing: Drawing, labels: Mapping[str, str | None]) -> Drawing:
    """The same drawing with other labels."""
    nodes = tuple(replace(node, label=labels.get(node.id)) for node in drawing.nodes)
    return replace(drawing, nodes=nodes)


def _bounds(display: DisplayGrid, model: Model) -> tuple[float, float, float, float]:
    """Corner to corner of what is drawn; the whole grid while nothing is."""
    geometry = model.grid.geometry
    cells = np.argwhere(display.floor | display.solid)
    if len(cells) == 0:
        cells = np.array([[0, 0], [geometry.shape[0] - 1, geometry.shape[1] - 1]])
    low, high = cells.min(axis=0) - 0.5, cells.max(axis=0) + 0.5
    corners = geometry.world_of(np.array([low, high, [low[0], high[1]], [high[0], low[1]]]))
    (x0, y0), (x1, y1) = corners.min(axis=0), corners.max(axis=0)
    return float(x0), float(y0), float(x1), float(y1)
