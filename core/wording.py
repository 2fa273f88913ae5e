"""Numbers and names in sentences."""

from __future__ import annotations


def counted(number: int, noun: str, plural: str = "") -> str:
    """A number with its noun: "1 place", "3 places"; `plural` where an s does not make it."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"


JOINERS = "\u200c\u200d"
"""Invisible, but part of words (Persian, Hindi) and of emoji (families)."""


def is_printable(text: str) -> bool:
    """Whether a name can be shown as it is: no control characters, line breaks or turned directions."""
    bare = text.translate(dict.fromkeys(map(ord, JOINERS)))
    return bare.isprintable() and bool(bare) == bool(text)
