"""Numbers in sentences."""

from __future__ import annotations


def counted(number: int, noun: str, plural: str = "") -> str:
    """A number with its noun: "1 place", "3 places"; `plural` where an s does not make it."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"
