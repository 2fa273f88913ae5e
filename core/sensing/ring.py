"""The ring of sonars on the robot."""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass

MURATA_MA40B8_BEAM = math.radians(50)
"""Full beam angle of the paper's transducer: 25 degrees to each side (Sect. 5)."""
POLAROID_BEAM = math.radians(30)
"""Full beam angle of the Pioneer's transducers (Kleeman and Kuc 2008)."""


@dataclass(frozen=True)
class Sonar:
    """One transducer: pose in the robot's frame (m, rad), full beam angle (rad), range limits (m)."""

    x: float
    y: float
    heading: float
    beam_width: float
    min_range: float
    max_range: float


@dataclass(frozen=True)
class SonarRing:
    """The sonars of a robot and the radius (m) of its round footprint."""

    sonars: tuple[Sonar, ...]
    robot_radius: float

    def __len__(self) -> int:
        return len(self.sonars)

    @property
    def max_range(self) -> float:
        """The farthest that any sonar of the ring can see, in metres."""
        return max(sonar.max_range for sonar in self.sonars)

    @property
    def reach(self) -> float:
        """The farthest point from the robot's centre that a reading can speak of, in metres."""
        return max(math.hypot(s.x, s.y) + s.max_range for s in self.sonars)

    @property
    def fingerprint(self) -> str:
        """Tells robots apart by what their logs say of them: 16 hexadecimal digits of the geometry."""
        values = [self.robot_radius]
        for s in self.sonars:
            values += [s.x, s.y, s.heading, s.beam_width, s.min_range, s.max_range]
        text = ",".join(f"{value + 0.0:.3f}" for value in values)
        return hashlib.sha256(text.encode()).hexdigest()[:16]


def circle(
    count: int,
    radius: float = 0.2,
    beam_width: float = MURATA_MA40B8_BEAM,
    max_range: float = 4.0,
    min_range: float = 0.1,
    robot_radius: float = 0.22,
) -> SonarRing:
    """A ring of `count` sonars evenly spaced on a circle, the first one looking ahead."""
    sonars = []
    for i in range(count):
        a = math.remainder(2 * math.pi * i / count, 2 * math.pi)
        x, y = radius * math.cos(a), radius * math.sin(a)
        sonars.append(Sonar(round(x, 6), round(y, 6), a, beam_width, min_range, max_range))
    return SonarRing(tuple(sonars), robot_radius)


_P3DX_FRONT_MM_DEG = ((69, 136, 90), (114, 119, 50), (148, 78, 30), (166, 27, 10))
_P3DX_REAR_MM_DEG = ((-157, 136, 90), (-203, 119, 130), (-237, 78, 150), (-255, 27, 170))


def _pioneer(table: tuple[tuple[int, int, int], ...]) -> list[Sonar]:
    """The left half of a Pioneer array and its mirror image, left to right."""
    left = [
        Sonar(x / 1000, y / 1000, math.radians(deg), POLAROID_BEAM, 0.15, 5.0)
        for x, y, deg in table
    ]
    right = [
        Sonar(s.x, -s.y, -s.heading, s.beam_width, s.min_range, s.max_range) for s in reversed(left)
    ]
    return left + right


def _presets() -> dict[str, SonarRing]:
    front = _pioneer(_P3DX_FRONT_MM_DEG)
    rear = _pioneer(_P3DX_REAR_MM_DEG)
    rear_clockwise = rear[::-1]
    return {
        "paper-12": circle(12),
        "circle-8": circle(8),
        "circle-16": circle(16),
        "p3dx-front-8": SonarRing(tuple(front), 0.26),
        "p3dx-16": SonarRing(tuple(front + rear_clockwise), 0.26),
    }


RING_PRESETS: dict[str, SonarRing] = _presets()
"""Rings by name. `paper-12`: 12 sonars every 30 degrees on a circle of 0.2 m (Sect. 5)."""
