"""The live session as one tab shows it: now or a moment before, drawn or paused, followed or not."""

from __future__ import annotations

import time

import numpy as np

from app.viewer.beam_shapes import BeamPlan, plan_beams
from app.viewer.drawing import Drawing
from app.viewer.following import following
from app.viewer.live_scene import FADES
from app.viewer.live_track import LiveTrack
from app.viewer.messages import Live
from app.viewer.playback import Playback
from app.viewer.tab_camera import TabCamera, camera_view
from app.viewer.tab_scene import TabScene
from core.geometry import FloatArray

AROUND_ROBOT, BESIDE_ROBOT = 3.5, 0.6
"""Metres around it that are in the picture before there is a map, and later."""
_CORNERS = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
_FIT_EVERY = 2.0
"""Seconds: a robot that leaves the picture is in it again after this long at most."""


class TabLive:
    """What a tab shows of a session; it outlives a lost 3D view. Event loop's thread only."""

    def __init__(self, track: LiveTrack, playback: Playback, camera: TabCamera) -> None:
        self._track = track
        self._playback = playback
        self._camera = camera
        self._follow = self._follows = False
        self._paused = False
        self._at: float | None = None
        self._shown = -1
        self._found = 0
        self._fitted_at = -np.inf

    def join(self, scene: TabScene) -> None:
        """A 3D view has connected."""
        self._draw(scene, anew=True)
        self._show_tentative(scene)

    def redraw(self, scene: TabScene) -> None:
        """The model has grown."""
        self._show_tentative(scene)
        if not self._follow:
            self._camera.fit_again(scene)

    def show(self, message: Live, scene: TabScene | None) -> None:
        """How the page wants it."""
        self._follows = self._follows and message.follow
        self._follow, self._paused, self._at = message.follow, message.paused, message.at
        self._believe(scene)
        if scene is not None:
            self._draw(scene, anew=True)
            self._go_along(scene)

    def moved(self, scene: TabScene | None, anew: bool) -> None:
        """The session has a scan more (`anew`: or many)."""
        if scene is None:
            return
        first = self._shown < 0
        self._draw(scene, anew)
        if self._shown >= 0 and (first or time.monotonic() - self._fitted_at > _FIT_EVERY):
            self._fitted_at = time.monotonic()
            self._camera.fit_again(scene)
        self._go_along(scene)

    def believed(self, scene: TabScene | None) -> None:
        """It is known better where the robot is, and how sure that is."""
        if self._paused or self._at is not None:
            return
        self._believe(scene)
        if scene is not None:
            self._draw(scene, anew=True)

    def mapped(self, scene: TabScene | None) -> None:
        """What the robot has heard is in the map now."""
        if scene is not None:
            scene.live.clear_dots()

    def end(self, scene: TabScene | None) -> None:
        """The session is over; the model stays."""
        self._playback.show(None, scene)
        if scene is not None:
            scene.live.clear()

    def outline(self, drawing: Drawing, other: FloatArray) -> FloatArray:
        """(K, 2) what a camera shows: the `other` things, and the robot with a little around it."""
        pose = self._pose()
        if pose is None:
            return other
        if not drawing.display.floor.any():
            return pose[:2] + AROUND_ROBOT * _CORNERS
        return np.concatenate((other, pose[:2] + BESIDE_ROBOT * _CORNERS))

    def _draw(self, scene: TabScene, anew: bool) -> None:
        """Draws the moment; `anew`: not what comes right after what is drawn."""
        track = self._track
        if not len(track) or (self._paused and not anew):
            return
        index = track.index_at(self._at)
        if index == self._shown and not anew:
            return
        pose = track.pose(index)
        scene.belief.show_robot(scene.drawing, None if pose is None else pose.tolist())
        scene.live.show_pin(pose)
        other_way = anew or index < self._shown or track.found != self._found
        scene.live.show_way(track.path(index), other_way)
        self._shown, self._found = index, track.found
        first = max(0, index - len(FADES) + 1)
        plans = [plan for plan in (_plan(track, i) for i in range(first, index + 1)) if plan]
        scene.live.show_beams(plans)
        if plans and self._at is None and not track.localizes:
            scene.live.add_dots(plans[-1])

    def _believe(self, scene: TabScene | None) -> None:
        if not len(self._track):
            return
        belief = self._track.belief(self._track.index_at(self._at))
        if belief is not None or self._playback.belief is not None:
            self._playback.show(belief, scene)

    def _go_along(self, scene: TabScene) -> None:
        pose = self._pose()
        if self._follow and not self._paused and pose is not None:
            view = following(camera_view(scene.client), pose, begins=not self._follows)
            self._follows = True
            self._camera.follow(scene, view)

    def _pose(self) -> FloatArray | None:
        track = self._track
        return track.pose(track.index_at(self._at)) if len(track) else None

    def _show_tentative(self, scene: TabScene) -> None:
        scene.live.show_tentative(_tentative_parts(scene.drawing), scene.drawing.mark_scale)


def _plan(track: LiveTrack, index: int) -> BeamPlan | None:
    pose = track.pose(index)
    return None if pose is None else plan_beams(track.ring, pose, track.ranges(index))


def _tentative_parts(drawing: Drawing) -> list[FloatArray]:
    """Closed outlines (K, 2) of what the last step of the drive did not make regions of yet."""
    decisions = drawing.moments[-1]["decisions"] if drawing.moments else []
    return [np.array(d["hull"], float) for d in decisions if not d["accepted"] and d["hull"]]
