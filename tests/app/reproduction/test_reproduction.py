"""The command from end to end."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from app.cli import run


def test_a_folder_of_something_else_is_left_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "map.yaml").write_text("mine", encoding="utf-8")
    assert run(["reproduce", "--quick", "--out", str(tmp_path)]) == 2
    assert "no report folder" in capsys.readouterr().err
    assert (tmp_path / "map.yaml").read_text(encoding="utf-8") == "mine"


def test_no_homes_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["reproduce", "--homes", "0", "--out", str(tmp_path / "r")]) == 2
    assert "0 homes" in capsys.readouterr().err


@pytest.mark.slow
def test_quick_reproduction_is_complete_and_repeatable(tmp_path: Path) -> None:
    texts = []
    for name in ("a", "b"):
        assert run(["reproduce", "--quick", "--out", str(tmp_path / name)]) == 0
        assert (tmp_path / name / "report.html").stat().st_size > 1_000_000
        texts.append((tmp_path / name / "results.json").read_text(encoding="utf-8"))
    assert texts[0] == texts[1]
    results = json.loads(texts[0])
    assert results["paper_home"]["models"]["offline"]["nodes"] == 10
    assert results["paper_home"]["localization"]["static"]["default"]["score"]["accuracy"] > 0.8
    assert len(results["random_homes"]["homes"]) == 1
