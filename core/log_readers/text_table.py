"""Rows of numbers in a text file."""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from core.errors import LogError, TooLargeError
from core.geometry import FloatArray, IntArray
from core.log_readers.draft_log import Finding
from core.log_readers.limits import ReadLimits
from core.log_readers.text_description import NAMED_DELIMITERS, Column, TextFile
from core.wording import counted

BLANKS = frozenset(("", "-", "na", "n/a", "null", "none", "nan"))
"""Fields that say nothing; in a range they mean no echo."""
PROGRESS_EVERY = 5000


@dataclass(frozen=True)
class TextTable:
    """The columns that were asked for, in the file's units.

    Attributes:
        values: (N, C) in the order of `TextFile.all_columns`; NaN for a blank field.
        lines: (N,) 1-based.
        skipped: a last line that was cut.
    """

    values: FloatArray
    lines: IntArray
    skipped: tuple[Finding, ...]


def read_table(
    lines: Iterable[tuple[int, bytes]],
    file: TextFile,
    source: str,
    limits: ReadLimits,
    progress: Callable[[], None],
) -> TextTable:
    """Reads the rows of a text file.

    Raises:
        LogError: no rows, a row with another number of columns, a field that is no number.
        TooLargeError: more numbers than the limit.
    """
    numbers, values, skipped = array("q"), array("d"), []
    layout: _Layout | None = None
    heading_row = file.has_header
    header: list[str] | None = None
    for number, raw in lines:
        if number <= file.skip_rows:
            continue
        text = _text(raw, source, number)
        if file.comment and file.comment in text:
            text = text.partition(file.comment)[0]
        if not text.strip():
            continue
        if heading_row:
            header, heading_row = _split(text, _delimiter(file, text)), False
            continue
        layout = layout or _layout(file, text, header, source, number)
        fields = _split(text, layout.delimiter)
        if len(fields) != layout.width:
            if not raw.endswith(b"\n") and len(numbers) and len(fields) < layout.width:
                skipped.append(Finding.at("last line cut in the middle", [number], source))
                continue
            raise LogError(
                f"{counted(len(fields), 'column')} where the rows above have {layout.width}",
                source,
                number,
            )
        values.extend(_numbers([fields[i] for i in layout.wanted], file, source, number))
        numbers.append(number)
        if len(values) > limits.max_readings:
            raise TooLargeError(f"{source}: more than {limits.max_readings} numbers")
        if len(numbers) % PROGRESS_EVERY == 0:
            progress()
    if layout is None:
        raise LogError("there are no rows in it", source)
    shape = (len(numbers), len(layout.wanted))
    return TextTable(np.array(values).reshape(shape), np.array(numbers), tuple(skipped))


@dataclass(frozen=True)
class _Layout:
    """How a row is taken apart; None as delimiter is white space."""

    delimiter: str | None
    width: int
    wanted: list[int]


def _layout(
    file: TextFile, text: str, header: list[str] | None, source: str, number: int
) -> _Layout:
    """The layout that the first row shows."""
    delimiter = _delimiter(file, text)
    width = len(_split(text, delimiter))
    wanted = [_index(column, header, source) for column in file.all_columns]
    if max(wanted) >= width:
        raise LogError(
            f"column {max(wanted)} is asked for, but there are {width} (the first is 0)",
            source,
            number,
        )
    return _Layout(delimiter, width, wanted)


def _index(column: Column, header: list[str] | None, source: str) -> int:
    if isinstance(column, int):
        return column
    if header is None or column not in header:
        there = ", ".join(header or [])[:100]
        raise LogError(f"there is no column {column!r}; there are: {there or 'no names'}", source)
    return header.index(column)


def _delimiter(file: TextFile, text: str) -> str | None:
    if file.delimiter == "whitespace":
        return None
    if file.delimiter != "auto":
        return NAMED_DELIMITERS.get(file.delimiter, file.delimiter)
    likely = (";", "\t") if file.decimal == "," else (",", ";", "\t")
    return next((delimiter for delimiter in likely if delimiter in text), None)


def _split(text: str, delimiter: str | None) -> list[str]:
    if delimiter is None:
        return text.split()
    return [field.strip().strip('"') for field in text.split(delimiter)]


def _text(raw: bytes, source: str, number: int) -> str:
    try:
        return raw.decode("utf-8-sig" if number == 1 else "utf-8")
    except UnicodeDecodeError as error:
        raise LogError("not UTF-8 text", source, number) from error


def _numbers(fields: list[str], file: TextFile, source: str, number: int) -> list[float]:
    """The numbers in the fields of a row; NaN for a blank field."""
    if file.decimal == ",":
        fields = [field.replace(",", ".") for field in fields]
    try:
        return [float(field) for field in fields]
    except ValueError:
        return [_number_or_blank(field, source, number) for field in fields]


def _number_or_blank(field: str, source: str, number: int) -> float:
    try:
        return float(field)
    except ValueError:
        if field.strip().lower() in BLANKS:
            return math.nan
        raise LogError(f"{field[:40]!r} is no number", source, number) from None
