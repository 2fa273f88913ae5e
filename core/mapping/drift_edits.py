"""What a person says about the drift of a drive.

A person sees at once what a sonar cannot: that these two corridors are two, that this is the same
door. `said_links` brings it into the pose graph.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from core.errors import InputError

CLOSURE_ID = re.compile(r"c-?\d{1,15}_-?\d{1,15}")
"""What `Closure.id` looks like."""


@dataclass(frozen=True)
class SamePlace:
    """At these two times (s) the robot was at the same place, give or take a step."""

    t_source: float
    t_target: float


@dataclass(frozen=True)
class Dragged:
    """At a time (s) the robot was at this place (m) of the map; without a heading (rad) that stays open."""

    t: float
    x: float
    y: float
    heading: float | None = None


@dataclass(frozen=True)
class DriftEdits:
    """All that was said about a drive.

    Attributes:
        rejected: ids of closures that are wrong.
        accepted: ids of closures that are right although the program did not believe them.
        same_places: places that the program did not find again.
        dragged: stretches that belong elsewhere.
    """

    rejected: tuple[str, ...] = ()
    accepted: tuple[str, ...] = ()
    same_places: tuple[SamePlace, ...] = ()
    dragged: tuple[Dragged, ...] = ()

    def rejecting(self, closure_id: str) -> DriftEdits:
        """With one closure called wrong."""
        bare = self.forgetting(closure_id)
        return replace(bare, rejected=(*bare.rejected, closure_id))

    def accepting(self, closure_id: str) -> DriftEdits:
        """With one closure called right."""
        bare = self.forgetting(closure_id)
        return replace(bare, accepted=(*bare.accepted, closure_id))

    def calling_same(self, places: SamePlace) -> DriftEdits:
        """With two places called the same."""
        return replace(self, same_places=(*self.same_places, places))

    def parting(self, places: SamePlace) -> DriftEdits:
        """With two places no longer called the same.

        Raises:
            InputError: they were not.
        """
        others = tuple(said for said in self.same_places if said != places)
        if len(others) == len(self.same_places):
            raise InputError(
                f"nobody called the places at {places.t_source:g} s and {places.t_target:g} s the same"
            )
        return replace(self, same_places=others)

    def dragging(self, place: Dragged) -> DriftEdits:
        """With a stretch put elsewhere; what was said about the same time before is replaced."""
        others = tuple(before for before in self.dragged if before.t != place.t)
        return replace(self, dragged=(*others, place))

    def releasing(self, t: float) -> DriftEdits:
        """With the stretch that was dragged at a time (s) left where the program puts it.

        Raises:
            InputError: none was.
        """
        others = tuple(said for said in self.dragged if said.t != t)
        if len(others) == len(self.dragged):
            raise InputError(f"nobody dragged the drive at {t:g} s")
        return replace(self, dragged=others)

    def forgetting(self, closure_id: str) -> DriftEdits:
        """With nothing said about one closure: the program decides again."""
        return replace(
            self,
            rejected=tuple(said for said in self.rejected if said != closure_id),
            accepted=tuple(said for said in self.accepted if said != closure_id),
        )

    @property
    def count(self) -> int:
        """How much was said."""
        return sum(map(len, (self.rejected, self.accepted, self.same_places, self.dragged)))

    @property
    def decisive(self) -> bool:
        """Something was said that the odometry alone cannot fulfil."""
        return bool(self.accepted or self.same_places or self.dragged)
