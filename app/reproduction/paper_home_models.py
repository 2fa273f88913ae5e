"""Models of the paper's home: offline with ten regions, autonomous as in the paper, our default."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from app.reproduction.extent import REGIONS, Extent
from app.reproduction.extraction_snapshots import Snapshot, snapshots
from core.pipeline.corrected_drive import corrected_drive
from core.pipeline.modeller import ModellingOptions, model_log
from core.progress import Progress, part_of
from core.segmentation.convexity import PRINTED, ConvexityConfig, convexity
from core.sensing import RobotLog, Trajectory
from core.simulation import simulate
from core.topology import Model

HOME = "paper"


@dataclass(frozen=True)
class PaperHomeModels:
    """What was made of the mapping drive.

    Attributes:
        drive: the drive with its corrected poses as odometry; all models are made at them.
        models: by name: offline, paper, and default unless the extent is quick.
        snapshots: of the autonomous models, by the same names.
    """

    drive: RobotLog
    models: Mapping[str, Model]
    snapshots: Mapping[str, tuple[Snapshot, ...]]


def paper_home_models(extent: Extent, progress: Progress) -> PaperHomeModels:
    """Drives through the paper's home and models it."""
    log = simulate(HOME, seed=extent.seed, tour="mapping", progress=part_of(progress, 0.0, 0.1))
    drive = corrected(log, extent, part_of(progress, 0.1, 0.4))
    options = {
        "offline": ModellingOptions("offline", "paper", REGIONS, odometry="raw", seed=extent.seed),
        "paper": ModellingOptions("autonomous", "paper", odometry="raw", seed=extent.seed),
    }
    if not extent.quick:
        options["default"] = ModellingOptions("autonomous", odometry="raw", seed=extent.seed)
    models, seen = {}, {}
    blind = drive.without_truth()
    trajectory = Trajectory.from_odometry(blind)
    for i, (name, chosen) in enumerate(options.items()):
        start, stop = (0.4 + 0.6 * k / len(options) for k in (i, i + 1))
        middle = (start + stop) / 2
        models[name] = model_log(blind, chosen, part_of(progress, start, middle))
        if chosen.mode == "autonomous":
            rest = part_of(progress, middle, stop)
            seen[name] = snapshots(blind, trajectory, name == "paper", progress=rest)
    return PaperHomeModels(drive, models, seen)


def corrected(log: RobotLog, extent: Extent, progress: Progress) -> RobotLog:
    """A mapping drive with its odometry made better once, for all models of it."""
    found = corrected_drive(log, extent.odometry, progress)
    part = log.taken(np.arange(*found.whole.part))
    return replace(part, odometry=found.trajectory.poses)


@dataclass(frozen=True)
class NodeConvexity:
    """Three measures for one node: eq. (7) as printed, eq. (7) with unknown grids counted too, and
    the share of hidden pairs that our default uses."""

    node: str
    as_printed: float
    with_unknown: float
    hidden_pairs: float


def convexities(model: Model) -> tuple[NodeConvexity, ...]:
    """The measures of Fig. 15 for every node."""
    found = []
    for node in model.topology.nodes:
        mask = (model.regions == node.region,)
        printed = convexity(mask, model.grid, PRINTED)  # eq. (7)
        ours = convexity(mask, model.grid, ConvexityConfig())
        found.append(NodeConvexity(node.id, printed, ours, node.convexity))
    return tuple(found)
