"""What one tab sees of a live robot: its way, its beams, and where it heard echoes just now.

Everything keeps its place in the scene and only changes values, so that nothing flickers at 4 Hz.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np
import viser

from app.viewer.beam_shapes import ECHO, MISS, UNSEEN, BeamPlan, arc, fan
from app.viewer.belief_scene import NOSE
from app.viewer.canvas import Canvas, turned
from app.viewer.layers import BEAMS, REGIONS, ROBOT
from app.viewer.palette import Colour, linear
from app.viewer.scene import sphere
from core.geometry import FloatArray

TENTATIVE: Colour = (150, 120, 60)
TENTATIVE_WIDTH = 0.035
WAY: Colour = (24, 92, 255)
WAY_WIDTH, WAY_HEIGHT = 0.04, 0.05
FAN_HEIGHT, ARC_HEIGHT, DOT_HEIGHT, DOT_RADIUS = 0.14, 0.17, 0.1, 0.028
"""Metres."""
PIN_HEIGHT, PIN_RADIUS, PIN_WIDTH = 1.35, 0.09, 0.025
"""Metres: above the walls, below the names."""
CHUNK = 64
"""Segments of the way in one piece; only the last one changes while the robot drives."""
FADES = (1.0, 0.5, 0.22)
"""Opacity of the echoes of the last scans, the newest first."""
FAN_OPACITY, ARC_OPACITY, DOT_OPACITY = 0.17, 0.95, 0.7
MOST_DOTS = 600
"""Echoes that are remembered as dots: about the last 20 s of twelve sonars."""
_TENTATIVE = f"/{REGIONS}/tentative"
_PIN = f"/{ROBOT}/pin"
_FANS, _ARCS, _DOTS, _WAY = f"/{BEAMS}/fans", f"/{BEAMS}/arcs", f"/{BEAMS}/dots", f"/{ROBOT}/way"


class LiveScene:
    """The live robot in a client's scene."""

    def __init__(self, client: viser.ClientHandle, canvas: Canvas) -> None:
        self._client = client
        self._canvas = canvas
        self._drawn: list[int] = []
        self._recent: deque[BeamPlan] = deque(maxlen=len(FADES))
        self._dots: deque[tuple[float, float]] = deque(maxlen=MOST_DOTS)

    def show_way(self, segments: FloatArray, anew: bool) -> None:
        """The way (K, 2, 2), metres; `anew`: it is another one, not the same one grown."""
        if anew:
            self._drawn = []
        pieces = [segments[i : i + CHUNK] for i in range(0, len(segments), CHUNK)]
        for number, piece in enumerate(pieces):
            known = self._drawn[number] if number < len(self._drawn) else 0
            if known != len(piece) or number >= len(self._drawn) - 1:
                self._show_piece(f"{_WAY}/{number}", piece)
        for stale in range(len(pieces), len(self._drawn)):
            self._canvas.remove(f"{_WAY}/{stale}")
        self._drawn = [len(piece) for piece in pieces]

    def show_pin(self, pose: FloatArray | None) -> None:
        """A pin over the robot (3,), so that walls do not hide where it is; None: no pin."""
        if pose is None:
            self._canvas.remove(_PIN)
            return
        handle = self._canvas.scene.get_handle_by_name(_PIN)
        if handle is None:
            handle = self._make_pin()
        handle.position = (float(pose[0]), float(pose[1]), 0.0)

    def show_beams(self, plans: Sequence[BeamPlan]) -> None:
        """The beams of the last scans, the newest last; none: no beams."""
        self._recent.clear()
        self._recent.extend(plans)
        if not plans:
            self._canvas.remove(_FANS)
            self._canvas.remove(_ARCS)
            return
        self._show_fans(plans[-1])
        self._show_arcs()

    def show_tentative(self, outlines: Sequence[FloatArray], size: float) -> None:
        """Closed outlines (K, 2) of parts that are no regions yet; `size`: of marks in this home."""
        closed = [np.concatenate((outline, outline[:1])) for outline in outlines]
        flat = [np.stack((line[:-1], line[1:]), axis=1) for line in closed]
        segments = np.concatenate(flat) if flat else np.zeros((0, 2, 2))
        raised = np.concatenate((segments, np.full((*segments.shape[:2], 1), WAY_HEIGHT)), axis=2)
        if self._canvas.lines(_TENTATIVE, raised, TENTATIVE, TENTATIVE_WIDTH * size) is None:
            self._canvas.remove(_TENTATIVE)

    def add_dots(self, plan: BeamPlan) -> None:
        """Remembers where echoes were heard."""
        along = np.column_stack((np.cos(plan.headings), np.sin(plan.headings)))
        points = plan.feet + plan.reaches[:, None] * along
        self._dots.extend((float(x), float(y)) for x, y in points[plan.echoes])
        self._show_dots()

    def clear_dots(self) -> None:
        """Forgets them: a map has been drawn of them."""
        self._dots.clear()
        self._canvas.remove(_DOTS)

    def clear(self) -> None:
        """Takes everything out."""
        self.show_way(np.zeros((0, 2, 2)), anew=True)
        self._canvas.remove(_WAY)
        self.show_pin(None)
        self.show_beams([])
        self.clear_dots()
        self.show_tentative([], 1.0)

    def _make_pin(self) -> viser.FrameHandle:
        pin = self._canvas.group(_PIN)
        foot, head = (0.0, 0.0, 0.0), (0.0, 0.0, PIN_HEIGHT)
        self._canvas.lines(f"{_PIN}/stem", np.array([[foot, head]]), NOSE, PIN_WIDTH)
        self._canvas.instances(
            f"{_PIN}/head", sphere(2), np.array([head]), np.array([PIN_RADIUS]), [NOSE]
        )
        return pin

    def _show_piece(self, name: str, piece: FloatArray) -> None:
        """A piece of the way, filled up to CHUNK with segments of no length."""
        ends = np.concatenate((piece, np.tile(piece[-1, 1], (CHUNK - len(piece), 2, 1))))
        points = np.concatenate((ends, np.full((CHUNK, 2, 1), WAY_HEIGHT)), axis=2)
        handle = self._canvas.scene.get_handle_by_name(name)
        if isinstance(handle, viser.LineSegmentsHandle):
            handle.points = points.astype(np.float32)
        else:
            self._canvas.lines(name, points, WAY, WAY_WIDTH)

    def _show_fans(self, plan: BeamPlan) -> None:
        colours = [ECHO if echo else MISS for echo in plan.echoes]
        positions = _raised(plan.feet, FAN_HEIGHT)
        self._show_shapes(
            _FANS, [plan], positions, plan.scales(np.ones(len(colours), bool)), colours
        )

    def _show_arcs(self) -> None:
        newest = list(self._recent)[::-1]
        plans = newest + [newest[-1]] * (len(FADES) - len(newest))
        positions = np.concatenate([_raised(plan.feet, ARC_HEIGHT) for plan in plans])
        scales = np.concatenate([plan.scales(plan.echoes) for plan in plans])
        for age in range(len(newest), len(FADES)):
            scales[age * len(plans[0].feet) : (age + 1) * len(plans[0].feet)] = UNSEEN
        self._show_shapes(_ARCS, plans, positions, scales, [ECHO] * len(scales))

    def _show_shapes(
        self,
        name: str,
        plans: Sequence[BeamPlan],
        positions: FloatArray,
        scales: FloatArray,
        colours: Sequence[Colour],
    ) -> None:
        turns = np.array([turned(h) for plan in plans for h in plan.headings], np.float32)
        handle = self._canvas.scene.get_handle_by_name(name)
        if isinstance(handle, viser.BatchedMeshHandle):
            with self._client.atomic():
                handle.batched_positions = positions.astype(np.float32)
                handle.batched_wxyzs = turns
                handle.batched_scales = scales.astype(np.float32)
                handle.batched_colors = np.rint(linear(colours)).astype(np.uint8)
            return
        fans = name == _FANS
        shape = fan(plans[0].shape_width) if fans else arc(plans[0].shape_width)
        opacity = FAN_OPACITY if fans else ARC_OPACITY
        made = self._canvas.instances(name, shape, positions, scales, colours, opacity)
        if made is not None:
            made.batched_wxyzs = turns
            if not fans:
                made.batched_opacities = np.repeat(FADES, len(plans[0].feet)).astype(np.float32)

    def _show_dots(self) -> None:
        """All dots; those that are not there yet lie invisible at the first."""
        if not self._dots:
            return
        missing = MOST_DOTS - len(self._dots)
        places = np.array([*self._dots, *[self._dots[0]] * missing])
        positions = _raised(places, DOT_HEIGHT)
        scales = np.repeat((DOT_RADIUS, UNSEEN), (len(self._dots), missing)).astype(np.float32)
        handle = self._canvas.scene.get_handle_by_name(_DOTS)
        if isinstance(handle, viser.BatchedMeshHandle):
            with self._client.atomic():
                handle.batched_positions = positions.astype(np.float32)
                handle.batched_scales = scales
        else:
            colours = [ECHO] * MOST_DOTS
            self._canvas.instances(_DOTS, sphere(0), positions, scales, colours, DOT_OPACITY)


def _raised(points: FloatArray, height: float) -> FloatArray:
    return np.column_stack((points, np.full(len(points), height)))
