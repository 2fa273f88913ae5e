"""The sections of the report: which figure is drawn from what."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from app.reproduction import tables
from app.reproduction.figures import map_figures, spread_figures, step_figures
from app.reproduction.localized_drive import LocalizedDrive
from app.reproduction.many_homes import HomeFigures
from app.reproduction.page import Figure, Section, Table
from app.reproduction.paper_home_models import HOME, PaperHomeModels, convexities
from core.simulation import build_home, truth_of
from core.simulation.changes import changed_home

SAMPLES = {"static": 6, "changed": 3}
"""Steps shown in Figs. 19 and 24."""
NUMBERS = {"static": ("16", "19", "20", "21"), "changed": ("23", "24", "25", "26")}
"""The paper's figures: path, sampled steps, probability, entropy."""
METHOD_NAMES = {
    "default": "default method",
    "paper": "the paper's method as written",
    "mcl": "Monte Carlo localization",
}
TITLES = {
    "paper": "as in the paper",
    "default": "EchoRooms' default",
}


def setup_section(paper_home: PaperHomeModels, results: dict[str, Any]) -> Section:
    """Home, drive and map, and the paper's printed values."""
    truth = truth_of(build_home(HOME))
    model = paper_home.models["offline"]
    drive = paper_home.drive.truth
    home = [] if drive is None else [map_figures.home_figure(truth, drive)]
    parts: list[Figure | Table] = [tables.printed_table(results)]
    parts += [
        Figure(
            "fig-12",
            "Fig. 12: the home and the mapping drive",
            "Floor plan of our own in the paper's size, with the true path of the drive.",
            figure,
        )
        for figure in home
    ]
    parts.append(
        Figure(
            "fig-map",
            "The grid map (CEMAL)",
            "White is free, black occupied, grey unknown; the line is the path it was made at.",
            map_figures.map_figure(model),
        )
    )
    parts.append(tables.map_table(results))
    text = (
        "The paper drove a real robot through one home. Here a simulated robot with twelve simulated "
        "sonars drives through a simulated home of that size and kind.",
    )
    return Section("setup", "Setup", text, tuple(parts))


def modelling_section(paper_home: PaperHomeModels) -> Section:
    """5.1: Figs. 13-15."""
    offline = paper_home.models["offline"]
    nodes = len(offline.topology.nodes)
    parts = [
        Figure(
            "fig-13",
            "Fig. 13: offline modelling, ten regions given",
            f"{nodes} nodes, {len(offline.topology.edges)} edges.",
            map_figures.model_figure(offline),
        )
    ]
    for name, seen in paper_home.snapshots.items():
        model = paper_home.models[name]
        how = TITLES[name]
        parts.append(
            Figure(
                f"fig-14-{name}",
                f"Fig. 14: autonomous modelling, {how}",
                f"Coloured: extracted so far; the blue mark is the robot. At the end "
                f"{len(model.topology.nodes)} nodes; the paper has 10 in its home.",
                map_figures.extraction_figure(seen, model),
            )
        )
        parts.append(
            Figure(
                f"fig-15-{name}",
                f"Fig. 15: convexity measures, {how}",
                "Eq. (7) as printed counts occupied grids only and hardly sees thin walls; the other "
                "two bars are stricter, and values above c_t are shown as they are.",
                map_figures.convexity_figure(convexities(model)),
            )
        )
    return Section("modelling", "5.1 Topological modelling", (), tuple(parts))


def localization_section(
    kind: str, paper_home: PaperHomeModels, drive: LocalizedDrive, results: dict[str, Any]
) -> Section:
    """5.2.1 (static) or 5.2.2 (changed): a drive by every method."""
    model = paper_home.models["paper"]
    parts: list[Figure | Table] = []
    if drive.changed:
        before = build_home(HOME)
        after = truth_of(changed_home(before, drive.seed))
        parts.append(
            Figure(
                "fig-22",
                "Fig. 22: what has changed in the home",
                "Red: gone; blue: added (a door shut, a chair pushed).",
                map_figures.changes_figure(truth_of(before), after),
            )
        )
    else:
        parts.append(tables.drive_table(results))
    for method in drive.steps:
        parts += _method_figures(kind, method, drive, paper_home)
    number = "5.2.2" if drive.changed else "5.2.1"
    what = "changed home" if drive.changed else "static environment"
    text = (
        "As in the paper, the robot is localized in the model of Fig. 14 (as in the paper) and starts "
        f"anywhere in the home; {len(model.topology.nodes)} nodes. Steps that did not change the "
        "belief are orange. A node that holds several rooms is easily right: see Fig. 14.",
    )
    return Section(f"localization-{kind}", f"{number} Localization, {what}", text, tuple(parts))


def _method_figures(
    kind: str, method: str, drive: LocalizedDrive, paper_home: PaperHomeModels
) -> list[Figure]:
    model, steps = paper_home.models["paper"], drive.steps[method]
    path, sampled, probability, entropy = NUMBERS[kind]
    how = METHOD_NAMES[method]
    shown = step_figures.sampled_steps(steps, SAMPLES[kind])
    rows = [
        (path, "path", "True path; numbers are steps.", map_figures.path_figure(model, drive, method)),
        (sampled, "sampled steps",
         "Above: the template (red) laid on the map at the most probable place; green is where the "
         "robot really is. Below: probability of every node.",
         step_figures.steps_figure(model, drive, shown)),
    ]  # fmt: skip
    if kind == "static" and method == "paper":
        first = ("17", "template of the first step", "In the robot's frame.",
                 step_figures.template_figure(steps[0]))  # fmt: skip
        second = ("18", "candidates of the first step", "Node and correlation.",
                  step_figures.candidates_figure(model, steps[0]))  # fmt: skip
        rows[1:1] = [first, second]
    value = (
        ("probability of the true node", step_figures.true_probability_figure(drive, method))
        if drive.changed
        else ("maximum node probability", step_figures.max_probability_figure(drive, method))
    )
    rows.append((probability, value[0], "", value[1]))
    rows.append((entropy, "entropy", "0 = certain, 1 = no idea.",
                 step_figures.entropy_figure(drive, method)))  # fmt: skip
    return [
        Figure(f"fig-{number}-{method}", f"Fig. {number}: {what}, {how}", caption, figure)
        for number, what, caption, figure in rows
    ]


def homes_section(homes: tuple[HomeFigures, ...], results: dict[str, Any]) -> Section:
    """What the paper does not have: many homes."""
    parts: list[Figure | Table] = [tables.homes_table(results)]
    parts += [
        tables.spread_table(results, group, figures)
        for group, figures in results["random_homes"]["spread"].items()
    ]
    parts.append(
        Figure(
            "fig-accuracy",
            "Right node by method",
            "One point is one home.",
            spread_figures.accuracy_figure(homes),
        )
    )
    parts.append(
        Figure(
            "fig-reliability",
            "Reliability diagram",
            "All steps of all homes; on the dashed line told probabilities are kept.",
            spread_figures.reliability_figure(homes),
        )
    )
    text = (
        f"{len(homes)} random homes that no parameter was chosen on, each mapped once and driven "
        "through twice: unchanged, and after a seat was carried out, a chair moved and a door shut. "
        "Few homes make a rough estimate: run with more --homes for a better one.",
    )
    return Section("homes", "Over many homes", text, tuple(parts))


def sections_of(
    paper_home: PaperHomeModels,
    drives: Mapping[str, LocalizedDrive],
    homes: tuple[HomeFigures, ...],
    results: dict[str, Any],
) -> tuple[Section, ...]:
    """The whole report."""
    localization = (
        localization_section(kind, paper_home, drive, results) for kind, drive in drives.items()
    )
    return (
        setup_section(paper_home, results),
        modelling_section(paper_home),
        *localization,
        homes_section(homes, results),
    )
