"""How much of Section 5 is run, and how often."""

from __future__ import annotations

from dataclasses import dataclass

from core.errors import UsageError
from core.pipeline.localizer import STEP_DISTANCE, LocalizationMethod
from core.pipeline.odometry import OdometryChoice

FIRST_SEED = 1000
"""Number of the first random home: no parameter was chosen on those from here on."""
MOST_HOMES = 1000
"""More random homes than this would take days."""
REGIONS = 10
"""k of the offline method (paper, 5.1)."""


@dataclass(frozen=True)
class Extent:
    """What is run.

    Attributes:
        seed: of all drives and of everything that is drawn.
        homes: number of random homes for the table.
        quick: the paper's home with less: no default model, no Monte Carlo localization, no drift
            correction; random homes are modelled offline.
        step: metres between two steps of the localization.
        particles: of Monte Carlo localization.
    """

    seed: int = 0
    homes: int = 3
    quick: bool = False
    step: float = STEP_DISTANCE
    particles: int = 10_000

    def __post_init__(self) -> None:
        if self.seed < 0:
            raise UsageError(f"the seed {self.seed} is negative; take a number from 0")
        if not 1 <= self.homes <= MOST_HOMES:
            raise UsageError(f"{self.homes} homes: choose from 1 to {MOST_HOMES}")

    @property
    def methods(self) -> tuple[LocalizationMethod, ...]:
        """Localization methods that are compared."""
        return ("default", "paper") if self.quick else ("default", "paper", "mcl")

    @property
    def odometry(self) -> OdometryChoice:
        """What is done to the odometry of mapping drives."""
        return "calibrated" if self.quick else "corrected"

    @property
    def home_names(self) -> tuple[str, ...]:
        """The random homes of the table."""
        return tuple(f"random-{FIRST_SEED + i}" for i in range(self.homes))
