import numpy as np
import pytest

from core.segmentation import boundary_features, boundary_model, room_features, room_model
from core.segmentation.decision_forest import DecisionForest, stored_forest


@pytest.fixture
def forest():
    """Two trees: one splits at feature 0, one always says 1."""
    return DecisionForest(
        root=np.array([0, 3]),
        feature=np.array([0, -1, -1, -1]),
        threshold=np.array([0.5, 0.25, 0.75, 1.0]),
        ahead=np.array([2, 0, 0, 0]),
    )


def test_small_values_go_to_the_next_knot_and_large_ones_ahead(forest):
    answers = forest.mean(np.array([[0.5, 9.0], [0.6, 9.0]]))
    assert answers == pytest.approx([(0.25 + 1) / 2, (0.75 + 1) / 2])


def test_no_question_no_answer(forest):
    assert forest.mean(np.zeros((0, 2))).shape == (0,)


def test_a_stored_forest_answers_the_same(forest, tmp_path, monkeypatch):
    forest.write(tmp_path / "forest.npz")
    monkeypatch.setattr("core.segmentation.decision_forest.files", lambda _: tmp_path)
    asked = np.array([[0.4], [0.9]])
    assert stored_forest("forest.npz").mean(asked).tolist() == forest.mean(asked).tolist()


@pytest.mark.parametrize(
    ("stored", "features"),
    [
        (boundary_model.STORED, boundary_features.FEATURES),
        (room_model.STORED, room_features.FEATURES),
    ],
)
def test_the_forests_of_the_program_ask_for_features_that_exist(stored, features):
    forest = stored_forest(stored)
    assert set(forest.feature.tolist()) == {-1, *range(len(features))}
    answers = forest.threshold[forest.feature < 0]
    assert answers.min() >= 0
    assert answers.max() <= 1
