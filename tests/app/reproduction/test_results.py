"""results.json holds what was found, and only what JSON can hold."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from app.reproduction.extent import Extent
from app.reproduction.localized_drive import LocalizedDrive
from app.reproduction.many_homes import HomeFigures, spread_of
from app.reproduction.paper_home_models import PaperHomeModels
from app.reproduction.results import results_of
from core.errors import UsageError


@pytest.fixture(scope="module")
def results(
    extent: Extent,
    paper_home: PaperHomeModels,
    localized: LocalizedDrive,
    homes: tuple[HomeFigures, ...],
) -> dict[str, Any]:
    return results_of(extent, paper_home, {"static": localized}, homes)


def test_results_are_plain_json(results: dict[str, Any]) -> None:
    assert json.loads(json.dumps(results, allow_nan=False)) == results


def test_rejected_steps_and_probabilities_are_those_of_the_steps(results: dict[str, Any]) -> None:
    found = results["paper_home"]["localization"]["static"]["paper"]
    assert found["rejected_steps"] == [2]
    assert found["max_probability"] == [0.75, 0.75]
    assert found["entropy"] == [0.81, 0.81]


def test_printed_values_of_the_paper_stand_beside_ours(results: dict[str, Any]) -> None:
    ours = {value["what"]: value["ours"] for value in results["paper_values"]}
    assert ours["size of the home"] == pytest.approx([11.4, 8.7])
    assert ours["rate of the sonar scans"] == pytest.approx(4.0)
    assert ours["speed of the robot"] == pytest.approx(0.15)
    assert ours["static: steps not updated"] == [2]
    assert ours["changed: steps not updated"] is None


def test_spread_over_homes(results: dict[str, Any]) -> None:
    spread = results["random_homes"]["spread"]
    assert spread["static, paper"]["accuracy"] == pytest.approx(
        {"mean": 0.75, "spread": 0.353553, "worst": 0.5, "homes": 2}
    )
    assert spread["map"]["leak_m2"]["worst"] == pytest.approx(0.5)


def test_a_number_of_regions_has_no_worst_home() -> None:
    assert spread_of("count", [8.0, 12.0]).worst is None


def test_values_that_are_not_finite_are_left_out_of_the_mean() -> None:
    found = spread_of("position_error", [0.1, np.nan, 0.3])
    assert (found.mean, found.worst, found.homes) == (pytest.approx(0.2), 0.3, 2)


@pytest.mark.parametrize("wrong", [{"homes": 0}, {"homes": 1001}, {"seed": -1}])
def test_an_extent_that_cannot_be_is_refused(wrong: dict[str, int]) -> None:
    with pytest.raises(UsageError):
        Extent(**wrong)  # type: ignore[arg-type]
