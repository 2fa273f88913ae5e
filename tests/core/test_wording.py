"""Numbers and names in sentences."""

from __future__ import annotations

import pytest

from core.wording import counted, is_printable


def test_one_is_singular_and_every_other_number_plural() -> None:
    assert [counted(n, "place") for n in (0, 1, 2)] == ["0 places", "1 place", "2 places"]
    assert counted(2, "match", "matches") == "2 matches"


@pytest.mark.parametrize(
    "text", ["kitchen", "", "\u0645\u06cc\u200c\u062e", "\U0001f468\u200d\U0001f469"]
)
def test_names_of_every_language_can_be_shown(text: str) -> None:
    assert is_printable(text)


@pytest.mark.parametrize("text", ["a\nb", "a\x00", "\u202eevil", "\u200d"])
def test_a_name_cannot_hold_what_is_not_seen(text: str) -> None:
    assert not is_printable(text)
