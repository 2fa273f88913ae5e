"""`echorooms reproduce`: Section 5 of the paper from simulated homes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def reproduce(
    out: Annotated[Path, typer.Option(help="Folder for report.html and results.json.")],
    homes: Annotated[
        int | None, typer.Option(help="Random homes in the table; by default 3, with --quick 1.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Of all drives and everything that is drawn.")] = 0,
    quick: Annotated[
        bool, typer.Option("--quick", help="A first look: fewer models, methods and homes.")
    ] = False,
) -> None:
    """Redo the paper's experiments in simulated homes: one page that works offline, and figures."""
    from app.commands.output_folder import complete_folder
    from app.commands.terminal import progress_bar
    from app.reproduction.extent import Extent

    standard = 1 if quick else 3
    extent = Extent(seed, standard if homes is None else homes, quick)
    with progress_bar() as progress, complete_folder(out, "report.html", "report") as folder:
        from app.reproduction.reproduction import reproduce_section_5

        reproduce_section_5(extent, progress).write(folder)
