"""The part of a view that belongs to one tab: lights, layers, selection, measure, playback."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np
import viser
from viser import FrameHandle

from app.viewer.belief_scene import BeliefScene
from app.viewer.camera import View
from app.viewer.canvas import LABEL_SCALE, Canvas
from app.viewer.drawing import Drawing
from app.viewer.drift_scene import DriftScene
from app.viewer.graph_shapes import circle
from app.viewer.label_layout import LabelBox, visible_labels
from app.viewer.layers import LABELS, LayerSwitch
from app.viewer.live_scene import LiveScene
from app.viewer.moment_scene import MomentScene
from app.viewer.palette import Colour
from app.viewer.picking import region_outline
from app.viewer.scene import label_position, label_text, sphere

SELECTED: Colour = (24, 92, 255)
MEASURE: Colour = (224, 36, 94)
LIGHTS: Mapping[str, tuple[float, float]] = {"light": (2.0, 1.7), "dark": (1.05, 1.0)}
"""Intensity of the hemisphere and of the directional light in each theme."""
SUN = (-4.0, -7.0, 10.0)
OUTLINE_HEIGHT, OUTLINE_WIDTH, RING_WIDTH, MEASURE_HEIGHT = 0.06, 0.08, 0.06, 0.08
MEASURE_RADIUS = 0.08
"""Metres."""
RING_SHARE = 1.55
"""Of the selection's ring against its sphere."""


class TabScene:
    """What one connected browser sees beyond the shared scene."""

    def __init__(self, client: viser.ClientHandle, drawing: Drawing) -> None:
        self.client = client
        self.drawing = drawing
        self._canvas = Canvas(client.scene)
        self.layers = LayerSwitch(self._canvas)
        self.belief = BeliefScene(client, self._canvas)
        self.moment = MomentScene(self._canvas)
        self.live = LiveScene(client, self._canvas)
        self.drift = DriftScene(self._canvas)
        self._sky = client.scene.add_light_hemisphere(
            "/lights/sky", sky_color=(255, 255, 255), ground_color=(186, 194, 214), intensity=2.0
        )
        self._sun = client.scene.add_light_directional(
            "/lights/sun", color=(255, 250, 240), intensity=1.7, position=SUN
        )
        self._label_groups: dict[str, FrameHandle] = {}

    def redraw(self, drawing: Drawing) -> None:
        """The shared scene shows another drawing now."""
        self.drawing = drawing
        for group in self._label_groups.values():
            group.remove()
        self._label_groups.clear()

    def wear(self, theme: str) -> None:
        """Floor and light of a theme."""
        self.layers.wear(theme)
        self._sky.intensity, self._sun.intensity = LIGHTS[theme]

    def select(self, node_id: str | None, others: Collection[str] = ()) -> None:
        """Marks nodes: a line around each one's region and a ring around its sphere."""
        nodes = [node for node in self.drawing.nodes if node.id == node_id or node.id in others]
        if not nodes:
            self._canvas.remove("/selection")
            return
        outlines = [region_outline(self.drawing, node.region, OUTLINE_HEIGHT) for node in nodes]
        rings = [circle(node.centre, node.radius * RING_SHARE) for node in nodes]
        size = self.drawing.mark_scale
        for name, lines, width in (
            ("/selection/outline", outlines, OUTLINE_WIDTH),
            ("/selection/ring", rings, RING_WIDTH),
        ):
            self._canvas.lines(name, np.concatenate(lines), SELECTED, width * size)

    def measure(self, points: Sequence[tuple[float, float]]) -> None:
        """Shows none, one or two measured points, the latter with their distance."""
        self._canvas.remove("/measure")
        if not points:
            return
        flat = np.array([(x, y, MEASURE_HEIGHT) for x, y in points])
        self._canvas.instances(
            "/measure/ends",
            sphere(2),
            flat,
            np.full(len(flat), MEASURE_RADIUS * self.drawing.mark_scale),
            [MEASURE] * len(flat),
        )
        if len(flat) == 2:
            self._canvas.lines("/measure/line", flat[None], MEASURE, 3.0, on_screen=True)
            distance = float(np.linalg.norm(flat[1] - flat[0]))
            self._canvas.label("/measure/label", f"{distance:.2f} m", flat.mean(axis=0).tolist())

    def declutter(self, view: View, picture_height: float, selected: str | None) -> None:
        """Hides labels that would cover others from where the camera is."""
        boxes = [
            LabelBox(
                label_text(node.label, node.region),
                label_position(node),
                node.area + (1e6 if node.id == selected else 0.0),
            )
            for node in self.drawing.nodes
        ]
        shown = visible_labels(boxes, view, picture_height, LABEL_SCALE)
        for index, (node, visible) in enumerate(zip(self.drawing.nodes, shown, strict=True)):
            group = self._label_groups.get(node.id)
            if group is None and not visible:
                self._label_groups[node.id] = self._canvas.group(f"/{LABELS}/{index}", False)
            elif group is not None and group.visible != visible:
                group.visible = visible

    def stand_at(self, view: View, far: float) -> None:
        """Moves the camera there at once."""
        camera = self.client.camera
        with self.client.atomic():
            camera.far = far
            camera.max_orbit_distance = far
            camera.up_direction = view.up
            camera.position = view.position
            camera.look_at = view.look_at
            camera.fov = view.fov
