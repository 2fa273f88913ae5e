"""The few things that are ever put into a viser scene, checked before they go.

viser sends NaN without a word, and one value that cannot be packed ends every connection of a server.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import viser
from viser import (
    BatchedMeshHandle,
    FrameHandle,
    ImageHandle,
    LabelHandle,
    LineSegmentsHandle,
    MeshHandle,
)

from app.viewer.contour_mesh import Mesh
from app.viewer.palette import Colour, linear

MOST_LABEL_CHARACTERS = 32
LABEL_SCALE = 1.12


class Canvas:
    """A viser scene (of a server: for every tab; of a client: for that tab) behind checks."""

    def __init__(self, scene: viser.SceneApi) -> None:
        self.scene = scene

    def group(self, name: str, visible: bool = True) -> FrameHandle:
        """An empty parent; hiding it hides what is below it."""
        return self.scene.add_frame(name, show_axes=False, visible=visible)

    def mesh(self, name: str, mesh: Mesh, colour: Colour, flat: bool = False) -> MeshHandle | None:
        """A mesh of one colour, or nothing when it has no triangles."""
        if mesh.empty:
            return None
        return self.scene.add_mesh_simple(
            name,
            _finite(mesh.vertices),
            mesh.faces,
            color=colour,
            flat_shading=flat,
            cast_shadow=False,
            receive_shadow=False,
        )

    def lines(
        self,
        name: str,
        segments: npt.NDArray[Any],
        colours: Colour | npt.NDArray[Any],
        thickness: float,
        on_screen: bool = False,
    ) -> LineSegmentsHandle | None:
        """Segments (N, 2, 3) of a thickness in metres, or in pixels; nothing when there are none."""
        if len(segments) == 0:
            return None
        return self.scene.add_line_segments(
            name,
            _finite(segments),
            np.asarray(colours, np.uint8),
            thickness=thickness,
            thickness_units="screen" if on_screen else "world",
        )

    def image(
        self,
        name: str,
        picture: npt.NDArray[np.uint8],
        size: tuple[float, float],
        centre: tuple[float, float, float],
        heading: float,
    ) -> ImageHandle:
        """A picture lying on the floor; its row 0 is the lowest y."""
        return self.scene.add_image(
            name,
            picture,
            render_width=float(size[0]),
            render_height=float(size[1]),
            format="png",
            position=_point(centre),
            wxyz=turned(heading),
            cast_shadow=False,
            receive_shadow=False,
        )

    def label(self, name: str, text: str, position: Sequence[float]) -> LabelHandle:
        """A text whose lower edge is at a point; it always faces the camera."""
        return self.scene.add_label(
            name,
            shortened(text),
            position=_point(position),
            anchor="bottom-center",
            font_screen_scale=LABEL_SCALE,
            depth_test=False,
        )

    def instances(
        self,
        name: str,
        mesh: Mesh,
        positions: npt.NDArray[Any],
        scales: npt.NDArray[Any],
        colours: Sequence[Colour],
        opacity: float | None = None,
        heading: float = 0.0,
    ) -> BatchedMeshHandle | None:
        """Copies of a mesh, each with its scale ((N,) or (N, 3)) and colour; nothing when none."""
        if len(positions) == 0:
            return None
        return self.scene.add_batched_meshes_simple(
            name,
            mesh.vertices,
            mesh.faces,
            np.tile(turned(heading), (len(positions), 1)),
            _finite(positions),
            batched_scales=_finite(scales),
            batched_colors=np.rint(linear(colours)).astype(np.uint8),
            opacity=opacity,
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
        )

    def remove(self, name: str) -> None:
        """Takes a node and all below it out; nothing when there is none."""
        if self.scene.get_handle_by_name(name) is not None:
            self.scene.remove_by_name(name)


def shortened(text: str) -> str:
    """A label that fits: one line, an ellipsis when it is long."""
    line = " ".join(text.split())
    if len(line) <= MOST_LABEL_CHARACTERS:
        return line
    return line[: MOST_LABEL_CHARACTERS - 1].rstrip() + "…"


def turned(heading: float) -> tuple[float, float, float, float]:
    """The quaternion (w, x, y, z) of a turn about +z."""
    return (float(np.cos(heading / 2)), 0.0, 0.0, float(np.sin(heading / 2)))


def _finite(values: npt.NDArray[Any]) -> npt.NDArray[np.float32]:
    array = np.asarray(values, np.float32)
    if not np.isfinite(array).all():
        raise ValueError("what is drawn must be finite")
    return array


def _point(values: Sequence[float]) -> tuple[float, float, float]:
    x, y, z = _finite(np.asarray(values, float)).tolist()
    return (x, y, z)
