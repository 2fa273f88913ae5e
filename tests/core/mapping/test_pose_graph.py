"""The pose graph on a hand-made square drive."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.geometry import between
from core.mapping.graph_terms import Link
from core.mapping.odometry_model import (
    OdometryNoise,
    integrate,
    motions,
    through_nodes,
    without_systematic_error,
)
from core.mapping.pose_graph import PoseGraph
from core.mapping.reflection_points import path_length

SIDE, STEP = 4.0, 0.1


def square_drive(rounds: int = 2) -> np.ndarray:
    """True poses of a drive round a square of 4 m, turning on the spot in its corners."""
    steps = [(STEP, 0.0, 0.0)] * round(SIDE / STEP) + [(0.0, 0.0, math.pi / 2 / 10)] * 10
    return integrate(np.zeros(3), np.array(steps * 4 * rounds))


def with_error(poses: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Odometry from which taking out the systematic error (3,) gives the poses."""
    steps = motions(poses)
    steps[:, :2] /= 1 + error[0]
    distance = np.hypot(steps[:, 0], steps[:, 1])
    steps[:, 2] = (steps[:, 2] - error[2] * distance) / (1 + error[1])
    return integrate(poses[0], steps)


def solved(odometry: np.ndarray, links: list[Link], nodes: np.ndarray) -> PoseGraph:
    graph = PoseGraph(odometry, nodes, OdometryNoise())
    for _ in range(len(nodes) - 1):
        graph.extend()
    graph.links = links
    graph.solve(20)
    return graph


@pytest.fixture
def truth() -> np.ndarray:
    return square_drive()


@pytest.fixture
def nodes(truth: np.ndarray) -> np.ndarray:
    return np.append(np.arange(0, len(truth) - 1, 10), len(truth) - 1)


def closures(truth: np.ndarray, nodes: np.ndarray) -> list[Link]:
    """The second round meets the first at every second node."""
    information = np.diag([1 / 0.05**2, 1 / 0.05**2, 1 / 0.02**2])
    half = (len(nodes) - 1) // 2
    return [
        Link(i, i + half, between(truth[nodes[i]], truth[nodes[i + half]]), information)
        for i in range(0, half, 2)
    ]


def test_systematic_errors_are_taken_out_exactly() -> None:
    truth = square_drive()
    error = np.array([0.01, -0.02, 0.003])

    assert without_systematic_error(with_error(truth, error), error) == pytest.approx(
        truth, abs=1e-9
    )


def test_closures_bring_a_drifted_square_back_and_calibrate_the_robot(
    truth: np.ndarray, nodes: np.ndarray
) -> None:
    odometry = with_error(truth, np.array([0.0, 0.02, 0.004]))
    before = np.hypot(*(odometry - truth)[:, :2].T).max()

    graph = solved(odometry, closures(truth, nodes), nodes)

    after = np.hypot(*(graph.poses - truth[nodes])[:, :2].T).max()
    assert before > 0.5
    assert after < 0.1 * before
    assert graph.error[1] == pytest.approx(0.02, abs=0.01)
    assert (graph.error_sigma() < OdometryNoise().systematic)[1:].all()


def test_one_false_closure_among_true_ones_is_ignored(truth: np.ndarray, nodes: np.ndarray) -> None:
    links = closures(truth, nodes)
    information = links[0].information
    wrong = between(truth[nodes[5]], truth[nodes[30]]) + np.array([1.5, -1.0, 0.8])
    false = Link(5, 30, wrong, information)

    graph = solved(truth, [*links, false], nodes)

    assert np.hypot(*(graph.poses - truth[nodes])[:, :2].T).max() < 0.02
    assert graph.link_weights[-1] < 0.01
    assert graph.link_weights[:-1].min() > 0.9


def test_without_closures_the_odometry_stays(truth: np.ndarray, nodes: np.ndarray) -> None:
    odometry = with_error(truth, np.array([0.01, 0.02, 0.004]))

    graph = solved(odometry, [], nodes)

    assert graph.poses == pytest.approx(odometry[nodes], abs=1e-6)
    assert graph.pose_sigma()[0] == pytest.approx(np.zeros(3), abs=1e-3)
    assert graph.pose_sigma()[-1, 0] > graph.pose_sigma()[10, 0] > 0


def test_wall_directions_hold_the_heading(truth: np.ndarray, nodes: np.ndarray) -> None:
    odometry = with_error(truth, np.array([0.0, 0.0, 0.005]))
    graph = PoseGraph(odometry, nodes, OdometryNoise())
    for _ in range(len(nodes) - 1):
        graph.extend()
    graph.walls = {k: float(-truth[n, 2]) for k, n in enumerate(nodes)}
    graph.solve(20)

    off = np.degrees(np.abs(np.angle(np.exp(1j * (graph.poses[:, 2] - truth[nodes, 2])))))
    assert off.max() < 1.0
    per_round = 2 * math.pi * graph.error[1] + 4 * SIDE * graph.error[2]
    assert per_round == pytest.approx(4 * SIDE * 0.005, rel=0.25)


def test_a_trajectory_through_the_odometrys_own_nodes_is_the_odometry(
    truth: np.ndarray, nodes: np.ndarray
) -> None:
    length = path_length(truth, 0.3)

    again = through_nodes(truth, length, nodes, truth[nodes])

    assert again == pytest.approx(truth, abs=1e-9)
