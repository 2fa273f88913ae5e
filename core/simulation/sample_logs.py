"""Makes the sample logs: `python -m core.simulation.sample_logs OUT_DIR`."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from core.log_readers.native import write_native
from core.sensing.ring import RING_PRESETS
from core.sensing.robot_log import RobotLog
from core.simulation.drive import simulate

SAMPLES: dict[str, Callable[[], RobotLog]] = {
    "paper-mapping": lambda: simulate("paper", seed=11),
    "paper-localization": lambda: simulate("paper", seed=21, tour="localization"),
    "paper-changed": lambda: simulate("paper", seed=22, tour="localization", changed=True),
    "flat-mapping": lambda: simulate("random-11", seed=1, ring=RING_PRESETS["circle-8"]),
    "flat-kidnapped": lambda: simulate(
        "random-11", seed=2, tour="localization", ring=RING_PRESETS["circle-8"], kidnap=True
    ),
}
"""The sample logs by name; their README tells what each is good for."""


def write_samples(folder: Path) -> list[Path]:
    """Writes all sample logs into a folder and returns their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for name, drive in SAMPLES.items():
        path = folder / f"{name}.jsonl.gz"
        write_native(drive(), path)
        paths.append(path)
    return paths


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python -m core.simulation.sample_logs OUT_DIR")
    write_samples(Path(sys.argv[1]))
