"""What one tab sees of a robot's belief: bars, the robot, its local map and the candidates.

Everything keeps its place in the scene from step to step and only changes values, so that nothing
flickers while a localization is played.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import viser

from app.viewer.belief_shapes import BarPlan, arrow, evenly, unknown_spot
from app.viewer.canvas import Canvas, turned
from app.viewer.drawing import Drawing
from app.viewer.graph_shapes import unit_box
from app.viewer.layers import BARS, ROBOT
from app.viewer.palette import Colour, linear, mix
from app.viewer.scene import LABEL_GAP, sphere
from core.geometry import FloatArray

TEMPLATE: Colour = (224, 36, 94)
HULL: Colour = (38, 44, 60)
NOSE: Colour = (255, 196, 0)
MOST_TEMPLATE_POINTS = 300
TEMPLATE_RADIUS, TEMPLATE_HEIGHT = 0.045, 0.12
ROBOT_RADIUS, ROBOT_HEIGHT, ROBOT_CLEARANCE = 0.22, 0.24, 0.04
CANDIDATE_LENGTH, CANDIDATE_LEVEL = 0.5, 0.05
"""Metres."""
SHADE: Colour = (16, 20, 36)
SHADE_SHARE = 0.5
"""What darkens the colour of a node, so that its candidate stands out from its own floor."""
LEAST_CANDIDATE_SHARE = 0.55
"""Size of a candidate that fits nothing against one that fits everything."""
UNKNOWN_TEXT = "unknown"
GONE = 1e-4
"""Scale of an instance that is not to be seen; viser does not take 0."""
_BOXES, _UNKNOWN = f"/{BARS}/boxes", f"/{BARS}/unknown"
_BODY, _TEMPLATE, _CANDIDATES = f"/{ROBOT}/body", f"/{ROBOT}/template", f"/{ROBOT}/candidates"


class BeliefScene:
    """The belief of one step in a client's scene."""

    def __init__(self, client: viser.ClientHandle, canvas: Canvas) -> None:
        self._client = client
        self._canvas = canvas

    def show_bars(self, drawing: Drawing, plan: BarPlan | None) -> None:
        """A bar at every node, and one beside the home for `unknown`; None takes them out."""
        if plan is None or len(plan.feet) == 0:
            self._canvas.remove(_BOXES)
            self._canvas.remove(_UNKNOWN)
            return
        bars = self._canvas.scene.get_handle_by_name(_BOXES)
        if isinstance(bars, viser.BatchedMeshHandle) and np.allclose(
            bars.batched_positions, plan.feet, atol=1e-4
        ):
            with self._client.atomic():
                bars.batched_scales = plan.scales.astype(np.float32)
                bars.batched_colors = _linear(plan.colours)
        else:
            self._canvas.instances(_BOXES, unit_box(), plan.feet, plan.scales, plan.colours)
        self._show_unknown_label(drawing, plan.tells_unknown)

    def show_robot(self, drawing: Drawing, pose: Sequence[float] | None) -> None:
        """The robot at a pose (x, y, heading), or nowhere."""
        if pose is None:
            self._canvas.remove(_BODY)
            return
        x, y, heading = (float(value) for value in pose)
        handle = self._canvas.scene.get_handle_by_name(_BODY)
        if handle is None:
            handle = self._make_robot(ROBOT_RADIUS * drawing.mark_scale)
        with self._client.atomic():
            handle.position = (x, y, 0.0)
            handle.wxyz = turned(heading)

    def show_template(self, drawing: Drawing, points: FloatArray) -> None:
        """The points (K, 2) of the local map, in the world."""
        if len(points) == 0:
            self._canvas.remove(_TEMPLATE)
            return
        kept = points[evenly(len(points), MOST_TEMPLATE_POINTS)]
        positions = np.column_stack((kept, np.full(len(kept), TEMPLATE_HEIGHT)))
        balls = self._canvas.scene.get_handle_by_name(_TEMPLATE)
        if isinstance(balls, viser.BatchedMeshHandle):
            balls.batched_positions = positions.astype(np.float32)
        else:
            radii = np.full(len(kept), TEMPLATE_RADIUS * drawing.mark_scale)
            self._canvas.instances(
                _TEMPLATE, sphere(1), positions, radii, [TEMPLATE] * len(positions)
            )

    def show_candidates(
        self, drawing: Drawing, candidates: Mapping[str, Sequence[float]] | None
    ) -> None:
        """An arrow in a node's colour at its candidate (x, y, heading, score 0..1); None: no arrows."""
        if candidates is None or not drawing.nodes:
            self._canvas.remove(_CANDIDATES)
            return
        nodes = drawing.nodes
        given = np.array([candidates.get(n.id, (*n.centre[:2], 0.0, np.nan)) for n in nodes])
        missing = np.isnan(given[:, 3])
        share = LEAST_CANDIDATE_SHARE + (1 - LEAST_CANDIDATE_SHARE) * np.clip(given[:, 3], 0, 1)
        scales = np.where(missing, GONE, share * CANDIDATE_LENGTH * drawing.mark_scale)
        positions = np.column_stack((given[:, :2], np.full(len(nodes), CANDIDATE_LEVEL)))
        turns = np.array([turned(heading) for heading in given[:, 2]], np.float32)
        arrows = self._canvas.scene.get_handle_by_name(_CANDIDATES)
        if not isinstance(arrows, viser.BatchedMeshHandle):
            colours = [mix(node.colour, SHADE, SHADE_SHARE) for node in nodes]
            made = self._canvas.instances(_CANDIDATES, arrow(), positions, scales, colours)
            if made is not None:
                made.batched_wxyzs = turns
            return
        with self._client.atomic():
            arrows.batched_positions = positions.astype(np.float32)
            arrows.batched_scales = scales.astype(np.float32)
            arrows.batched_wxyzs = turns

    def clear(self) -> None:
        """Takes everything out."""
        self.clear_nodes()
        for name in (_BODY, _TEMPLATE):
            self._canvas.remove(name)

    def clear_nodes(self) -> None:
        """Takes out what stands at the nodes, as before a model with other nodes is drawn."""
        for name in (_BOXES, _UNKNOWN, _CANDIDATES):
            self._canvas.remove(name)

    def _show_unknown_label(self, drawing: Drawing, shown: bool) -> None:
        name = f"{_UNKNOWN}/text"
        if not shown:
            self._canvas.remove(_UNKNOWN)
        elif self._canvas.scene.get_handle_by_name(name) is None:
            x, y = unknown_spot(drawing)
            self._canvas.label(name, UNKNOWN_TEXT, (x, y, BarPlan.FULL_HEIGHT + LABEL_GAP))

    def _make_robot(self, radius: float) -> viser.FrameHandle:
        scene = self._client.scene
        body = self._canvas.group(_BODY)
        scene.add_cylinder(
            f"{_BODY}/hull",
            radius=radius,
            height=ROBOT_HEIGHT,
            color=HULL,
            position=(0, 0, ROBOT_CLEARANCE + ROBOT_HEIGHT / 2),
            cast_shadow=False,
            receive_shadow=False,
        )
        scene.add_box(
            f"{_BODY}/nose",
            color=NOSE,
            dimensions=(radius, radius / 3, ROBOT_CLEARANCE),
            position=(radius * 0.55, 0.0, ROBOT_HEIGHT + ROBOT_CLEARANCE * 1.5),
            cast_shadow=False,
            receive_shadow=False,
        )
        return body


def _linear(colours: Sequence[Colour]) -> np.ndarray:
    return np.rint(linear(colours)).astype(np.uint8)
