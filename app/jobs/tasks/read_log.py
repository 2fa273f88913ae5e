"""Task: read an uploaded log, check it, and prepare the folder that becomes its place in the store.

Arguments: `upload` (path), `ring` (a preset's name, the text of a ring file, or null), `out` (folder).
Result: what `app.storage.records.LogRecord` knows of a log.
"""

from __future__ import annotations

import json
from pathlib import Path

from app.jobs.tasks import Arguments, Result
from app.storage.log_files import NATIVE_FILE, ORIGINAL_FOLDER, REPORT_FILE
from core.log_readers.native import write_native
from core.log_readers.registry import read_log
from core.log_readers.ring_file import ring_from_bytes
from core.progress import Progress, part_of
from core.sensing.ring import RING_PRESETS, SonarRing

READING_SHARE = 0.7


def run(arguments: Arguments, progress: Progress) -> Result:
    """Reads the log."""
    upload, out = Path(arguments["upload"]), Path(arguments["out"])
    loaded = read_log(upload, _ring(arguments["ring"]), part_of(progress, 0.0, READING_SHARE))
    log = loaded.log
    progress(READING_SHARE, "keeping the log")
    (out / ORIGINAL_FOLDER).mkdir(parents=True)
    upload.rename(out / ORIGINAL_FOLDER / upload.name)
    write_native(log, out / NATIVE_FILE)
    report = json.dumps(loaded.report.as_dict(), allow_nan=False)
    (out / REPORT_FILE).write_text(report, encoding="utf-8")
    return {
        "name": log.name or upload.name,
        "scans": len(log),
        "sonars": len(log.ring),
        "duration_s": log.duration_s,
        "distance_m": log.distance_m,
    }


def _ring(given: str | None) -> SonarRing | None:
    if given is None:
        return None
    if given in RING_PRESETS:
        return RING_PRESETS[given]
    return ring_from_bytes(given.encode(), "ring")
