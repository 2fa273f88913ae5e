"""The tables of the report, from `results.json`'s dictionary."""

from __future__ import annotations

from typing import Any

from app.reproduction.page import Table

NAMES = {
    "precision_2": "occupied cells within 2 cells of something occupied",
    "recall_2": "seen surfaces with an occupied cell within 2 cells",
    "free_iou": "free space, intersection over union",
    "leak_m2": "free space claimed behind walls, m2",
    "doors_blocked": "doors blocked in the map",
    "leaks": "rooms joined through walls",
    "count": "regions",
    "coverage": "floor with a region",
    "purity": "floor whose region lies mostly in its room",
    "ari": "adjusted Rand index, regions against rooms",
    "merged_iou_mean": "rooms as unions of regions, mean IoU",
    "hidden_mean": "hidden pairs, mean",
    "hidden_max": "hidden pairs, worst region",
    "accuracy": "right node, all steps",
    "late": "right node, after the fifth step",
    "converged": "drives that were once certain and right",
    "false_certain": "steps certain (p > 0.9) and wrong",
    "calibration_error": "expected calibration error",
    "position_error": "median position error after the fifth step, m",
}


def printed_table(results: dict[str, Any]) -> Table:
    """The values that the paper prints, ours beside them."""
    rows = tuple(
        (
            value["section"],
            value["what"],
            value["printed"],
            f"{_text(value['ours'])} {value['unit']}",
        )
        for value in results["paper_values"]
    )
    return Table(
        "Values that the paper prints",
        ("Section", "Quantity", "Paper (real robot)", "Here (simulated)"),
        rows,
        "The paper gives its other results as figures without numbers. Its home, drives and seeds "
        "are not public; agreement of single values is not to be expected.",
        numbers_from=4,
    )


def drive_table(results: dict[str, Any]) -> Table:
    """The drives through the paper's home by method."""
    rows = []
    for kind, found in results["paper_home"]["localization"].items():
        for method, told in found.items():
            if isinstance(told, dict):
                score = told["score"]
                rows.append(
                    (
                        f"{kind}, {method}",
                        str(score["steps"]),
                        *(_text(score[key]) for key in ("accuracy", "late", "converged_m")),
                        *(_text(score[key]) for key in ("false_certain", "position_error")),
                        _text(told["rejected_steps"]),
                    )
                )
    return Table(
        "One drive each through the paper's home",
        ("Drive", "Steps", "Right", "Right, late", "Converged, m", "False, certain", "Error, m",
         "Not updated"),
        tuple(rows),
        "Late: after the fifth step. Converged: metres driven until certain and right, - for never. "
        "One drive says little; see the table over homes.",
    )  # fmt: skip


def map_table(results: dict[str, Any]) -> Table:
    """The map of the paper's home against the truth."""
    found = results["paper_home"]["map"]
    keys = ("precision_2", "recall_2", "free_iou", "leak_m2", "doors_blocked", "leaks")
    rows = tuple((NAMES[key], _text(found[key])) for key in keys)
    return Table("The map against the truth", ("Figure", "Value"), rows)


def spread_table(results: dict[str, Any], group: str, figures: dict[str, Any]) -> Table:
    """Mean, spread and worst of one group of figures over the random homes."""
    rows = tuple(
        (NAMES[key], *(_text(value[part]) for part in ("mean", "spread", "worst", "homes")))
        for key, value in figures.items()
    )
    return Table(
        f"{group[0].upper()}{group[1:]}",
        ("Figure", "Mean", "Standard deviation", "Worst home", "Homes"),
        rows,
    )


def homes_table(results: dict[str, Any]) -> Table:
    """The random homes."""
    rows = tuple(
        (home["name"], str(home["rooms"]), str(home["nodes"]))
        for home in results["random_homes"]["homes"]
    )
    return Table("The homes", ("Home", "Rooms", "Nodes of the model"), rows)


def _text(value: Any) -> str:
    """A value for people."""
    if value is None:
        return "-"
    if isinstance(value, list):
        return ", ".join(_text(inner) for inner in value) or "none"
    return f"{value:.3g}" if isinstance(value, float) else str(value)
