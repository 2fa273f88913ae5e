"""What the paper itself prints in Section 5. Nearly all of its results are figures without numbers."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class PrintedValue:
    """A value that the paper prints: where, of what, and `key`, the name of ours in results.json,
    whose unit is SI."""

    section: str
    what: str
    printed: str
    key: str
    unit: str = ""


PRINTED_VALUES = (
    PrintedValue("5", "size of the home", "11.4 m x 8.7 m", "paper_home.size_m", "m"),
    PrintedValue("5", "speed of the robot", "about 0.15 m/s", "paper_home.speed_m_s", "m/s"),
    PrintedValue("5", "rate of the sonar scans", "4 Hz", "paper_home.scan_rate_hz", "Hz"),
    PrintedValue("5", "size of a grid", "5 cm", "paper_home.resolution_m", "m"),
    PrintedValue(
        "5.1, Fig. 13", "subregions, offline (given)", "10", "paper_home.models.offline.nodes"
    ),
    PrintedValue("5.1, Fig. 14", "subregions, autonomous", "10", "paper_home.models.paper.nodes"),
    PrintedValue(
        "5.1, Fig. 15",
        "largest convexity measure of a subregion, eq. (7)",
        "below c_t = 0.2",
        "paper_home.models.paper.convexity_as_printed_max",
    ),
    PrintedValue(
        "5.2.1, Fig. 20",
        "static: steps not updated",
        "2 (steps 5 and 12)",
        "paper_home.localization.static.paper.rejected_steps",
    ),
    PrintedValue(
        "5.2.2, Fig. 25",
        "changed: steps not updated",
        "2 (steps 5 and 9)",
        "paper_home.localization.changed.paper.rejected_steps",
    ),
)


def value_at(results: object, key: str) -> object:
    """The value under a dotted key; None where it was not made."""
    for part in key.split("."):
        results = results.get(part) if isinstance(results, dict) else None
    return results
