"""Task: model one or more logs of one drive.

Arguments: `inputs` (paths of native logs, in order), `options`, `out` (the model folder to write).
Result: what the index knows of a model.
"""

from __future__ import annotations

import functools
from pathlib import Path

from pydantic import TypeAdapter

from app.jobs.tasks import Arguments, Result
from app.storage.model_facts import facts_of
from core.log_readers.registry import read_log
from core.pipeline.modeller import ModellingOptions, model_log
from core.progress import Progress, part_of
from core.sensing.robot_log import join
from core.topology.model_folder import write_model

OPTIONS_JSON: TypeAdapter[ModellingOptions] = TypeAdapter(ModellingOptions)
READING_SHARE, MODELLING_SHARE = 0.05, 0.95


def run(arguments: Arguments, progress: Progress) -> Result:
    """Makes the model and writes its folder."""
    out = Path(arguments["out"])
    progress(0.0, "reading the log")
    logs = [read_log(Path(path)).log.without_truth() for path in arguments["inputs"]]
    model = model_log(
        functools.reduce(join, logs),
        OPTIONS_JSON.validate_python(arguments["options"]),
        part_of(progress, READING_SHARE, MODELLING_SHARE),
    )
    progress(MODELLING_SHARE, "writing the model")
    write_model(model, out)
    return facts_of(out)
