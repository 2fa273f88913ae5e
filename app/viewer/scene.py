"""Puts a drawing into viser's scene. It draws; everything was computed in `drawing`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import numpy as np
import viser
from viser import LabelHandle

from app.viewer.canvas import Canvas, shortened
from app.viewer.contour_mesh import Mesh
from app.viewer.drawing import Drawing, NodeMark
from app.viewer.graph_shapes import icosphere, unit_square
from app.viewer.layers import (
    CELLS,
    GRAPH,
    GRID,
    LABELS,
    PATH,
    REGIONS,
    THEMES,
    WALLS,
    LayerSwitch,
)
from app.viewer.palette import Colour
from app.viewer.paths import path_colours

WALL_TOP: Colour = (236, 239, 245)
WALL_SIDE: Colour = (176, 184, 200)
FURNITURE_TOP: Colour = (222, 226, 234)
FURNITURE_SIDE: Colour = (158, 166, 184)
EDGES: Mapping[str, Colour] = {"light": (52, 62, 98), "dark": (196, 208, 236)}
STEMS: Mapping[str, Colour] = {"light": (150, 158, 178), "dark": (110, 120, 144)}
"""Colours of the graph's lines in each theme."""
MOST_SHOWN = 30
"""Characters of a label in the picture; a longer one would lie across half the home."""
LABEL_GAP = 0.12
"""Metres between a node's sphere and its label."""
EDGE_WIDTH, STEM_WIDTH, PATH_WIDTH, DOOR_RADIUS = 0.055, 0.018, 0.045, 0.055
"""Metres."""
GRID_LEVEL, REGION_LEVEL = -0.01, 0.01
"""Metres above the floor."""


def label_text(label: str | None, region: int) -> str:
    """What the 3D view calls a node: its label, cut where it is long, or a stand-in without one."""
    if not label:
        return f"Region {region}"
    return label if len(label) <= MOST_SHOWN else f"{label[: MOST_SHOWN - 1].rstrip()}…"


def label_position(node: NodeMark) -> tuple[float, float, float]:
    """Where the lower edge of a node's label is: above the sphere, also for eyes straight above."""
    x, y, z = node.centre
    return (x, y + node.radius, z + node.radius + LABEL_GAP)


class ModelScene:
    """The part of a view that all tabs share: one drawing in a server's scene."""

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self._canvas = Canvas(server.scene)
        self._labels: dict[str, LabelHandle] = {}
        server.scene.configure_default_lights(enabled=False)
        server.scene.configure_environment_map(None)
        LayerSwitch(self._canvas)

    def draw(self, drawing: Drawing) -> None:
        """Draws, or draws anew. Encodes pictures: call it in a thread."""
        canvas, size = self._canvas, drawing.mark_scale
        self._floor(drawing)
        self._walls(drawing)
        self._graph(drawing)
        path = f"/{PATH}/line"
        self._keep(
            path,
            canvas.lines(path, drawing.path, path_colours(len(drawing.path)), PATH_WIDTH * size),
        )
        cells, tiles = f"/{CELLS}/tiles", drawing.tiles
        self._keep(
            cells,
            canvas.instances(
                cells,
                unit_square(),
                tiles.centres,
                tiles.sizes,
                tiles.colours,
                heading=drawing.geometry.origin[2],
            ),
        )
        self._draw_labels(drawing)

    def set_labels(self, labels: Mapping[str, str]) -> None:
        """Changes the texts of nodes that are drawn, in every tab at once."""
        for node, text in labels.items():
            handle = self._labels.get(node)
            if handle is not None and handle.text != shortened(text):
                handle.text = shortened(text)

    def _floor(self, drawing: Drawing) -> None:
        geometry = drawing.geometry
        rows, cols = geometry.shape
        width, height = cols * geometry.resolution, rows * geometry.resolution
        x, y = geometry.world_of(np.array([rows / 2 - 0.5, cols / 2 - 0.5])).tolist()
        heading, margin = geometry.origin[2], 2 * drawing.floor_margin
        for theme, floor in drawing.floors.items():
            self._canvas.image(
                f"/{GRID}/{theme}/picture",
                floor.grid,
                (width + margin, height + margin),
                (x, y, GRID_LEVEL),
                heading,
            )
            self._canvas.image(
                f"/{REGIONS}/{theme}/picture",
                floor.regions,
                (width, height),
                (x, y, REGION_LEVEL),
                heading,
            )

    def _walls(self, drawing: Drawing) -> None:
        parts: tuple[tuple[str, Mesh, Colour, bool], ...] = (
            ("top", drawing.walls.cap, WALL_TOP, True),
            ("side", drawing.walls.sides, WALL_SIDE, False),
            ("low_top", drawing.furniture.cap, FURNITURE_TOP, True),
            ("low_side", drawing.furniture.sides, FURNITURE_SIDE, False),
        )
        for part, mesh, colour, flat in parts:
            name = f"/{WALLS}/{part}"
            self._keep(name, self._canvas.mesh(name, mesh, colour, flat))

    def _graph(self, drawing: Drawing) -> None:
        canvas, nodes, count = self._canvas, f"/{GRAPH}/nodes", len(drawing.doors)
        size = drawing.mark_scale
        for theme in THEMES:
            edges, stems, doors = (
                f"/{GRAPH}/{theme}/{part}" for part in ("edges", "stems", "doors")
            )
            self._keep(edges, canvas.lines(edges, drawing.edges, EDGES[theme], EDGE_WIDTH * size))
            self._keep(stems, canvas.lines(stems, drawing.stems, STEMS[theme], STEM_WIDTH * size))
            bends = [EDGES[theme]] * count
            sizes = np.full(count, DOOR_RADIUS * size)
            self._keep(doors, canvas.instances(doors, sphere(1), drawing.doors, sizes, bends))
        spheres = canvas.instances(
            nodes,
            sphere(3),
            np.array([node.centre for node in drawing.nodes]).reshape(-1, 3),
            np.array([node.radius for node in drawing.nodes]),
            [node.colour for node in drawing.nodes],
        )
        self._keep(nodes, spheres)

    def _draw_labels(self, drawing: Drawing) -> None:
        for stale in range(len(drawing.nodes), len(self._labels)):
            self._canvas.remove(f"/{LABELS}/{stale}")
        self._labels = {
            node.id: self._canvas.label(
                f"/{LABELS}/{index}/text",
                label_text(node.label, node.region),
                label_position(node),
            )
            for index, node in enumerate(drawing.nodes)
        }

    def _keep(self, name: str, handle: object | None) -> None:
        """Takes what an earlier drawing left under a name out when this one has nothing there."""
        if handle is None:
            self._canvas.remove(name)


@cache
def sphere(subdivisions: int) -> Mesh:
    """A unit sphere, made once."""
    return icosphere(subdivisions)
