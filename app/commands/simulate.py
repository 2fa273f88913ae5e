"""`echorooms simulate`: a log with ground truth from a simulated home."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from app.commands.map import RingOption


class Tour(StrEnum):
    """What the simulated robot drives."""

    mapping = "mapping"
    localization = "localization"


class SimulatedOdometry(StrEnum):
    """How good the simulated odometry is."""

    none = "none"
    calibrated = "calibrated"
    bad = "bad"


def _list_homes(wanted: bool) -> None:
    if wanted:
        from core.simulation.homes import home_names

        typer.echo("\n".join(home_names()))
        raise typer.Exit


def simulate(
    home: Annotated[str, typer.Argument(help="paper, random-17, mirrored, ... (see --list)")],
    out: Annotated[Path, typer.Option(help="Log to write: .jsonl or .jsonl.gz.")],
    seed: Annotated[int, typer.Option(help="Of the drive and the noise.")] = 0,
    tour: Annotated[Tour, typer.Option(help="The drive.")] = Tour.mapping,
    odometry: Annotated[
        SimulatedOdometry, typer.Option(help="Errors of the odometry; none = true poses.")
    ] = SimulatedOdometry.calibrated,
    ring: RingOption = None,
    changed: Annotated[
        bool, typer.Option("--changed", help="Sofa and chair moved, a door shut.")
    ] = False,
    kidnap: Annotated[
        bool, typer.Option("--kidnap", help="Carried elsewhere half-way (localization).")
    ] = False,
    show_list: Annotated[
        bool,
        typer.Option("--list", callback=_list_homes, is_eager=True, help="List the homes."),
    ] = False,
) -> None:
    """Simulate a drive through a home: a log with ground truth."""
    from app.commands.terminal import progress_bar
    from core.log_readers.native import write_native
    from core.log_readers.ring_file import load_ring
    from core.simulation.drive import simulate as drive

    known = load_ring(ring) if ring else None
    with progress_bar() as progress:
        log = drive(
            home,
            seed=seed,
            tour=tour.value,
            odometry=odometry.value,
            ring=known,
            changed=changed,
            kidnap=kidnap,
            progress=progress,
        )
        out.absolute().parent.mkdir(parents=True, exist_ok=True)
        write_native(log, out)
