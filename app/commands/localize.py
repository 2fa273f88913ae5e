"""`echorooms localize`: where the robot is, one line per time step."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from app.commands.map import RingOption


class Method(StrEnum):
    """Localization methods."""

    default = "default"
    paper = "paper"
    mcl = "mcl"


def localize(
    model_dir: Annotated[Path, typer.Argument(help="A model folder.")],
    log: Annotated[Path, typer.Argument(help="A log of any supported format.")],
    out: Annotated[Path, typer.Option(help="Steps to write: .jsonl.")],
    method: Annotated[
        Method, typer.Option(help="Ours, the paper's as written, or Monte Carlo localization.")
    ] = Method.default,
    step: Annotated[float, typer.Option(help="Metres of travel between time steps.")] = 2.5,
    particles: Annotated[int, typer.Option(help="Of Monte Carlo localization.")] = 10_000,
    seed: Annotated[int, typer.Option(help="Of the particles.")] = 0,
    ring: RingOption = None,
) -> None:
    """Tell where the robot is: node probabilities, one line per time step."""
    import json

    from app.commands.inputs import load_log
    from app.commands.output_file import complete_file
    from app.commands.terminal import progress_bar
    from core.pipeline.localizer import LocalizationOptions, localize_log
    from core.progress import part_of
    from core.topology.model_folder import read_model

    options = LocalizationOptions(method.value, step, particles, seed)
    with progress_bar() as progress, complete_file(out) as file:
        model = read_model(model_dir)
        drive = load_log(log, ring, part_of(progress, 0.0, 0.1))
        for found in localize_log(model, drive, options, part_of(progress, 0.1, 1.0)):
            file.write(json.dumps(found.as_dict()) + "\n")
