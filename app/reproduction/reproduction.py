"""Section 5 of the paper from simulated homes: one report page and its figures of merit."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.reproduction.extent import Extent
from app.reproduction.localized_drive import localized_drive
from app.reproduction.many_homes import KINDS, many_homes
from app.reproduction.page import page_of
from app.reproduction.paper_home_models import HOME, paper_home_models
from app.reproduction.results import NOTE, results_of
from app.reproduction.sections import sections_of
from core.progress import Progress, no_progress, part_of

TITLE = "Section 5 reproduced: sonar maps, regions and localization in simulated homes"
REPORT, RESULTS = "report.html", "results.json"
MODELLED, LOCALIZED, COUNTED = 0.4, 0.55, 0.98
"""Shares of the time after which the stages are over."""


@dataclass(frozen=True)
class Reproduction:
    """The page and the figures of merit."""

    page: str
    results: dict[str, Any]

    def write(self, folder: Path) -> None:
        """Writes report.html and results.json."""
        (folder / REPORT).write_text(self.page, encoding="utf-8")
        text = json.dumps(self.results, indent=1, allow_nan=False)
        (folder / RESULTS).write_text(text + "\n", encoding="utf-8")


def reproduce_section_5(extent: Extent, progress: Progress = no_progress) -> Reproduction:
    """Runs everything; the same extent gives the same results."""
    paper_home = paper_home_models(extent, part_of(progress, 0.0, MODELLED))
    model, drives = paper_home.models["paper"], {}
    for i, (kind, changed) in enumerate(KINDS.items(), 1):
        share = (LOCALIZED - MODELLED) / len(KINDS)
        part = part_of(progress, MODELLED + share * (i - 1), MODELLED + share * i)
        drives[kind] = localized_drive(
            HOME, model, paper_home.drive, extent.seed + i, changed, extent, part
        )
    homes = many_homes(extent, part_of(progress, LOCALIZED, COUNTED))
    progress(COUNTED, "drawing figures")
    results = results_of(extent, paper_home, drives, homes)
    page = page_of(TITLE, NOTE, sections_of(paper_home, drives, homes, results))
    progress(1.0, "done")
    return Reproduction(page, results)
