"""`echorooms map`: an occupancy grid from a log."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer


class Mapping(StrEnum):
    """Mapping methods."""

    cemal = "cemal"
    bayes = "bayes"


class Odometry(StrEnum):
    """Which trajectory a map is made at."""

    raw = "raw"
    calibrated = "calibrated"
    corrected = "corrected"


RingOption = Annotated[
    str | None,
    typer.Option(help="Sonar ring of a format that has none: a preset's name or a file."),
]
ResolutionOption = Annotated[float, typer.Option(help="Metres per cell.")]
OdometryOption = Annotated[
    Odometry, typer.Option(help="Odometry as it is, or with its drift corrected.")
]
CalibrationOption = Annotated[
    Path | None,
    typer.Option(
        help="JSON file with what is known of the robot's odometry: used when it exists, then written."
    ),
]


def map_log(
    log: Annotated[Path, typer.Argument(help="A log of any supported format.")],
    out: Annotated[Path, typer.Option(help="Folder to write.")],
    method: Annotated[Mapping, typer.Option(help="Mapping method.")] = Mapping.cemal,
    resolution: ResolutionOption = 0.05,
    odometry: OdometryOption = Odometry.corrected,
    ring: RingOption = None,
    calibration: CalibrationOption = None,
) -> None:
    """Make an occupancy grid: map.yaml, map.pgm, trajectory.csv."""
    from app.commands.calibration import keep_calibration, known_calibration
    from app.commands.inputs import load_log
    from app.commands.output_folder import complete_folder
    from app.commands.terminal import progress_bar
    from core.mapping.map_server import write_map
    from core.pipeline.corrected_drive import corrected_drive
    from core.pipeline.mapper import MappingOptions
    from core.pipeline.mapper import map_log as make_map
    from core.progress import part_of

    options = MappingOptions(method.value, resolution)
    with progress_bar() as progress, complete_folder(out) as folder:
        read = load_log(log, ring, part_of(progress, 0.0, 0.05))
        known = known_calibration(calibration, read.ring)
        drive = corrected_drive(read, odometry.value, part_of(progress, 0.05, 0.7), known=known)
        result = make_map(drive.log, drive.trajectory, options, part_of(progress, 0.7, 1.0))
        write_map(result.grid, folder)
        drive.whole.trajectory.write_csv(folder / "trajectory.csv")
    keep_calibration(calibration, drive.whole.calibration, read.ring)
    for sentence in drive.whole.sentences:
        typer.echo(sentence)
