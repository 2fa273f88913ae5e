"""Searching and sorting of lists."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sqlalchemy import ColumnElement, Table, and_, or_, true

from app.errors import Unprocessable


@dataclass(frozen=True)
class Sorting:
    """The column to sort by; a leading minus in `of` turns the order round."""

    column: str
    descending: bool

    @classmethod
    def of(cls, text: str) -> Sorting:
        """`name` or `-created`."""
        return cls(text.removeprefix("-"), text.startswith("-"))


def matching(query: str, *columns: ColumnElement[str]) -> ColumnElement[bool]:
    """Rows in which every word of the query occurs in one of the columns, upper or lower case."""
    words = query.split()
    return and_(
        true(),
        *(or_(*(column.icontains(word, autoescape=True) for column in columns)) for word in words),
    )


def ordering(
    table: Table, sorting: Sorting, allowed: Sequence[str]
) -> tuple[ColumnElement[object], ...]:
    """The order of a list; equal rows in the order of their ids.

    Raises:
        Unprocessable: there is no such column to sort by.
    """
    if sorting.column not in allowed:
        raise Unprocessable(f"sort: must be one of {', '.join(allowed)}, with - for descending")
    column = table.c[sorting.column]
    return (column.desc() if sorting.descending else column.asc(), table.c.id.asc())
