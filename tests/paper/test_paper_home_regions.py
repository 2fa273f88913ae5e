"""Section 5.1 on a drive through a home like the paper's: ten subregions there, "the three rooms were
allocated to three different subregions" and "the kitchen was extracted" as another one."""

from __future__ import annotations

import pytest

from core.evaluation import GroundTruth
from core.evaluation.ground_truth import aligned, alignment
from core.evaluation.region_metrics import RegionMetrics, region_metrics
from core.pipeline.modeller import ModellingOptions, model_log
from core.pipeline.odometry import OdometryChoice
from core.simulation import build_home, simulate, truth_of

SEED = 1001
"""A drive that no option of the method was chosen on."""
OWN_NODE = 0.7
"""IoU from which a node is the room's own."""
ROOMS = ("bedroom", "study", "child's room")


def modelled(odometry: OdometryChoice) -> RegionMetrics:
    """The paper's method on the drive, held against the true rooms."""
    home = build_home("paper")
    log, true = simulate(home, seed=SEED), truth_of(home)
    model = model_log(log.without_truth(), ModellingOptions(method="paper", odometry=odometry))
    assert log.truth is not None
    assert model.trajectory is not None
    frame = aligned(model.grid.geometry, alignment(log.truth, model.trajectory.poses))
    explored = true.explored(log)
    truth = GroundTruth(
        true.geometry, true.occupied, true.free, explored, true.rooms, true.names, true.door_gaps
    )
    return region_metrics(model.regions, frame, truth)


@pytest.mark.parametrize(("odometry", "own"), [("raw", (*ROOMS, "kitchen")), ("corrected", ROOMS)])
def test_the_paper_s_method_finds_about_ten_regions_with_the_rooms_as_nodes_of_their_own(
    odometry: OdometryChoice, own: tuple[str, ...]
) -> None:
    found = modelled(odometry)
    assert 8 <= found.count <= 12
    assert found.purity > 0.85
    for room in own:
        assert found.rooms[room].best_iou >= OWN_NODE, room
