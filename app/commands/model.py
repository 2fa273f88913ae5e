"""`echorooms model`: regions, topology and rooms from a log or a map."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from app.commands.map import (
    CalibrationOption,
    Mapping,
    Odometry,
    OdometryOption,
    ResolutionOption,
    RingOption,
)

if TYPE_CHECKING:
    from core.pipeline.modeller import ModellingOptions
    from core.progress import Progress
    from core.topology import Model


class Mode(StrEnum):
    """Modelling modes."""

    autonomous = "autonomous"
    offline = "offline"


class Method(StrEnum):
    """Ours or the paper's."""

    default = "default"
    paper = "paper"


def model(
    inputs: Annotated[
        list[Path], typer.Argument(help="One or more logs of one drive, or a map.yaml.")
    ],
    out: Annotated[Path, typer.Option(help="Model folder to write.")],
    regions: Annotated[
        int | None, typer.Option(help="Number of regions (offline, Sect. 3.1 of the paper).")
    ] = None,
    mode: Annotated[
        Mode | None, typer.Option(help="By default autonomous for logs without --regions.")
    ] = None,
    method: Annotated[
        Method, typer.Option(help="EchoRooms' default or the paper as written.")
    ] = Method.default,
    mapping: Annotated[Mapping, typer.Option(help="Mapping method.")] = Mapping.cemal,
    odometry: OdometryOption = Odometry.corrected,
    resolution: ResolutionOption = 0.05,
    ring: RingOption = None,
    seed: Annotated[int, typer.Option(help="Of everything that is drawn.")] = 0,
    calibration: CalibrationOption = None,
) -> None:
    """Divide a home into regions and rooms. Labels in an existing --out folder are kept."""
    from app.commands.output_folder import complete_folder
    from app.commands.terminal import progress_bar
    from core.pipeline.modeller import ModellingOptions
    from core.topology.model_folder import read_model, write_model

    options = ModellingOptions(
        mode.value if mode else None,
        method.value,
        regions,
        mapping.value,
        odometry.value,
        resolution,
        seed,
    )
    previous = read_model(out) if (out / "topology.json").is_file() else None
    with progress_bar() as progress, complete_folder(out) as folder:
        write_model(_make(inputs, options, ring, progress, previous, calibration), folder)


def _make(
    inputs: list[Path],
    options: ModellingOptions,
    ring: str | None,
    progress: Progress,
    previous: Model | None,
    calibration: Path | None,
) -> Model:
    from dataclasses import replace
    from functools import reduce

    from app.commands.calibration import keep_calibration, known_calibration
    from app.commands.inputs import load_log, map_yaml_of
    from core.errors import UsageError
    from core.mapping.map_server import read_map
    from core.pipeline.corrected_drive import calibration_of
    from core.pipeline.modeller import model_log, model_map
    from core.progress import part_of
    from core.sensing.robot_log import join

    maps = [map_yaml for path in inputs if (map_yaml := map_yaml_of(path))]
    if maps:
        if calibration is not None:
            raise UsageError("--calibration is of a robot's odometry: a map has none")
        if len(inputs) > 1:
            raise UsageError("a model is made from one map or from logs: give one map only")
        return model_map(read_map(maps[0]), options, progress, previous)
    logs = [load_log(path, ring, part_of(progress, 0.0, 0.05)) for path in inputs]
    log = reduce(join, logs)
    options = replace(options, known=known_calibration(calibration, log.ring))
    made = model_log(log, options, part_of(progress, 0.05, 1.0), previous)
    keep_calibration(calibration, calibration_of(made), log.ring)
    return made
