"""Task: localize a robot in a model.

Arguments: `model` (a model folder), `log` (a native log), `options`, `out` (a file to write).
Result: the number of steps.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from app.jobs.tasks import Arguments, Result
from core.log_readers.registry import read_log
from core.pipeline.localizer import LocalizationOptions, localize_log
from core.progress import Progress, part_of
from core.topology import Model
from core.topology.model_folder import read_model

READING_SHARE = 0.1


def run(arguments: Arguments, progress: Progress) -> Result:
    """Writes one line per step."""
    progress(0.0, "reading model and log")
    model = without_labels(read_model(Path(arguments["model"])))
    log = read_log(Path(arguments["log"])).log.without_truth()
    options = LocalizationOptions(**arguments["options"])
    steps = 0
    with Path(arguments["out"]).open("w", encoding="utf-8") as file:
        for step in localize_log(model, log, options, part_of(progress, READING_SHARE, 1.0)):
            file.write(json.dumps(step.as_dict(), allow_nan=False) + "\n")
            steps += 1
    return {"steps": steps}


def without_labels(model: Model) -> Model:
    """The model with ids for names, so that a sentence of a step outlives every renaming."""
    nodes = tuple(replace(node, label=None) for node in model.topology.nodes)
    return replace(model, topology=replace(model.topology, nodes=nodes))
