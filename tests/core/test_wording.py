"""Numbers in sentences."""

from __future__ import annotations

from core.wording import counted


def test_one_is_singular_and_every_other_number_plural() -> None:
    assert [counted(n, "place") for n in (0, 1, 2)] == ["0 places", "1 place", "2 places"]
    assert counted(2, "match", "matches") == "2 matches"
