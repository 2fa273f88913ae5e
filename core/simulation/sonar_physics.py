"""Which echo a sonar hears: rays through a wide beam, mirror-like walls, corners, edges, bounces.

At 40-50 kHz a plastered wall is nearly a mirror: it answers when the beam meets it squarely. The
model follows the physics of Kleeman and Kuc (2008) with rays:

* Rays leave the transducer over the whole beam, each with the sound pressure of its direction
  (eq. 4's directivity).
* Where a ray meets a face, a small part comes straight back: much when it meets the face squarely
  (within the `lobe` of the surface), hardly any at a glance. The rest goes on as by a mirror.
* A mirrored ray that passes close to the transducer is heard: from a wall met squarely after one
  reflection, from a corner of two walls after two. Longer detours give readings that are too long.
* Convex edges (door jambs, furniture) diffract a little of what meets them.

The first echo above the threshold is the reading, as in a time-of-flight module.
"""

from __future__ import annotations

import math

import numpy as np

from core.geometry import FloatArray
from core.sensing.beam import directivity
from core.sensing.ring import SonarRing
from core.simulation.echo import TABLE_STEP, first_echoes, near_faces
from core.simulation.outline import Outline
from core.simulation.sonar_model import SonarModel


class SonarPhysics:
    """The sonars of one ring in one home; `scan` gives what they read at a pose."""

    def __init__(self, outline: Outline, ring: SonarRing, model: SonarModel) -> None:
        self._outline = outline
        self._ring = ring
        self._model = model
        self._mounts = np.array([(s.x, s.y, s.heading) for s in ring.sonars], float)
        self._limits = np.array(
            [(s.min_range, s.max_range, s.beam_width) for s in ring.sonars], float
        )
        quarter = np.arange(0.0, math.pi / 2 + TABLE_STEP, TABLE_STEP)
        self._pressure = np.array(
            [np.sqrt(directivity(quarter, s.beam_width)) for s in ring.sonars]
        )

    def scan(self, pose: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Ranges (S,) in metres, NaN = no echo, of all sonars at a true pose of the robot (3,)."""
        count = len(self._ring)
        thresholds = self._model.threshold * np.exp(
            rng.normal(0.0, self._model.threshold_spread, count)
        )
        near = near_faces(self._outline.faces, pose[0], pose[1], self._ring.reach)
        echoes = first_echoes(
            pose,
            self._mounts,
            self._limits,
            self._pressure,
            self._outline.faces[near],
            self._outline.normals[near],
            self._outline.surfaces[near],
            self._outline.edges,
            thresholds,
            (
                self._model.ray_spacing,
                self._model.beam_share,
                self._model.capture,
                self._model.mirror_loss_with_range,
                self._model.scatter_loss_with_range,
                self._model.edge_strength,
            ),
            self._model.bounces,
        )
        return self._measured(echoes[:, 0], echoes[:, 1] / thresholds, rng)

    def _measured(
        self, ranges: FloatArray, excess: FloatArray, rng: np.random.Generator
    ) -> FloatArray:
        """Noise, faults and quantisation added to the ideal ranges (inf = no echo)."""
        model, count = self._model, len(ranges)
        low, high = self._limits[:, 0], self._limits[:, 1]
        chance, anywhere, noise = rng.random(count), rng.random(count), rng.standard_normal(count)
        heard = np.isfinite(ranges)
        true = np.where(heard, ranges, high)
        value = true + noise * (model.noise + model.noise_per_metre * true)
        value = value + model.lateness / np.maximum(excess, 1.0)
        value = np.where(heard, value, np.inf)
        bound = model.dropouts
        value = np.where(chance < bound, np.inf, value)
        stray = (chance >= bound) & (chance < bound + model.outliers)
        value = np.where(stray, low + anywhere * (high - low), value)
        bound += model.outliers
        crossed = (chance >= bound) & (chance < bound + model.crosstalk)
        value = np.where(crossed, low + anywhere * np.maximum(true - low, 0.0), value)
        value = np.round(np.maximum(value, low) / model.step) * model.step
        return np.where(value <= high, value, np.nan)
