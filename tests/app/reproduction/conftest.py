"""A tiny case by hand: two rooms side by side, a drive with two steps, two homes of the table."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.reproduction.extent import Extent
from app.reproduction.extraction_snapshots import Snapshot
from app.reproduction.localized_drive import LocalizedDrive
from app.reproduction.many_homes import HomeFigures
from app.reproduction.paper_home_models import PaperHomeModels
from core.evaluation.localization import StepOutcome, outcomes
from core.localization.localization_step import Candidate, LocalizationStep
from core.mapping import GridGeometry, OccupancyGrid
from core.pipeline.modeller import ModellingOptions, model_map
from core.sensing import RING_PRESETS, RobotLog, Trajectory
from core.topology import Model


@pytest.fixture(scope="session")
def drive() -> RobotLog:
    """A straight drive through the living room of the paper's home, 1.2 m in 8 s."""
    t = np.arange(33) * 0.25
    poses = np.column_stack((4.6 + 0.15 * t, np.full(33, 4.2), np.zeros(33)))
    ring = RING_PRESETS["paper-12"]
    ranges = np.full((33, len(ring)), 1.0)
    return RobotLog("drive", ring, t, poses, ranges, np.ones(ranges.shape, bool), poses)


@pytest.fixture(scope="session")
def model(drive: RobotLog) -> Model:
    """A map of 8 m x 4 m with a wall across its middle and a door in it, in two regions."""
    free = np.zeros((80, 160), bool)
    free[2:-2, 2:-2] = True
    free[:, 79:81] = False
    free[30:50, 79:81] = True
    grid = OccupancyGrid.of(GridGeometry(0.05, (2.0, 2.0, 0.0), free.shape), free, ~free)
    made = model_map(grid, ModellingOptions("offline", regions=2))
    return replace(
        made,
        trajectory=Trajectory.from_odometry(drive),
        provenance={**made.provenance, "mapping": {"method": "by hand"}},
    )


@pytest.fixture(scope="session")
def localized(model: Model, drive: RobotLog) -> LocalizedDrive:
    """Two steps by the paper's method: the first is updated, the second is not."""
    assert drive.truth is not None
    nodes = [node.id for node in model.topology.nodes]
    probabilities = dict(zip(nodes, (0.75, 0.25), strict=True))
    candidates = {node: Candidate(drive.truth[0], 0.5) for node in nodes}
    first = LocalizationStep(
        1, 4.0, probabilities, 0.0, nodes[0], drive.truth[16], 0.81, True, candidates,
        np.array([[1.0, 0.0], [0.0, 1.0]]), "by hand",
    )  # fmt: skip
    steps = (first, replace(first, step=2, t=8.0, updated=False))
    judged = tuple(outcomes(steps, model, drive.t, drive.truth))
    return LocalizedDrive(1, False, drive, drive.truth, {"paper": steps}, {"paper": judged})


@pytest.fixture(scope="session")
def paper_home(drive: RobotLog, model: Model) -> PaperHomeModels:
    """The same model for both ways of modelling, one snapshot."""
    seen = (Snapshot(4.0, model.grid, model.regions, drive.odometry[16]),)
    return PaperHomeModels(drive, {"offline": model, "paper": model}, {"paper": seen})


def home_figures(name: str, accuracy: float) -> HomeFigures:
    """A home of the table with a share of right steps."""
    step = StepOutcome(2.0, 2.5, accuracy > 0.9, 0.95, 0.95, 0.0, 0.1)
    groups = {"map": {"leak_m2": 1 - accuracy}, "static, paper": {"accuracy": accuracy}}
    return HomeFigures(name, 5, 9, groups, {"static, paper": (step,)})


@pytest.fixture(scope="session")
def homes() -> tuple[HomeFigures, ...]:
    """Two homes."""
    return home_figures("random-1000", 0.5), home_figures("random-1001", 1.0)


@pytest.fixture(scope="session")
def extent() -> Extent:
    """What the tiny case stands for."""
    return Extent(homes=2, quick=True)
