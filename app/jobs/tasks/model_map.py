"""Task: model an imported map.

Arguments: `inputs` (one map.yaml), `options`, `out` (the model folder to write).
Result: what the index knows of a model.
"""

from __future__ import annotations

from pathlib import Path

from app.jobs.tasks import Arguments, Result
from app.storage.model_facts import facts_of
from core.mapping.map_server import read_map
from core.pipeline.modeller import ModellingOptions, model_map
from core.progress import Progress, part_of
from core.topology.model_folder import write_model

READING_SHARE, MODELLING_SHARE = 0.05, 0.95


def run(arguments: Arguments, progress: Progress) -> Result:
    """Makes the model and writes its folder."""
    out = Path(arguments["out"])
    progress(0.0, "reading the map")
    model = model_map(
        read_map(Path(arguments["inputs"][0])),
        ModellingOptions(**arguments["options"]),
        part_of(progress, READING_SHARE, MODELLING_SHARE),
    )
    progress(MODELLING_SHARE, "writing the model")
    write_model(model, out)
    return facts_of(out)
