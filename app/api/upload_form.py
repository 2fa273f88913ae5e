"""A multipart form whose files stream to disk while they arrive, within a limit."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Iterator, Mapping
from dataclasses import dataclass, field
from http import HTTPStatus
from pathlib import Path
from typing import IO, TypeVar

from fastapi import Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, ValidationError
from python_multipart.exceptions import FormParserError
from python_multipart.multipart import MultipartParser, parse_options_header

from app.errors import Problem, TooLarge, Unprocessable
from app.settings import MEBIBYTE

Fields = TypeVar("Fields", bound=BaseModel)
MAX_PARTS = 16
DRAIN_S = 5.0
MAX_FIELD_BYTES = 1 << 17
MAX_NAME_LENGTH = 60
UNSAFE_CHARACTERS = frozenset('<>:"|?*/')
WRITE_BYTES = 1 << 20
"""How much is gathered before it is written, in a thread of its own."""


@dataclass(frozen=True)
class UploadedFile:
    """A file of a form: what the sender calls it, and where it lies now."""

    name: str
    path: Path


@dataclass
class UploadForm:
    """The fields and files of a form, by their names."""

    fields: dict[str, str] = field(default_factory=dict)
    files: dict[str, UploadedFile] = field(default_factory=dict)

    def file(self, name: str) -> UploadedFile:
        """The file with that name.

        Raises:
            Unprocessable: the form has none.
        """
        if name not in self.files:
            raise Unprocessable(f"the form must have a file named {name!r}")
        return self.files[name]


async def receive_form(request: Request, folder: Path, max_bytes: int) -> UploadForm:
    """Reads a multipart request; its files end up in `folder` under names of ours.

    Raises:
        TooLarge: the body is larger than `max_bytes`.
        Problem: it is no multipart form, or a broken one.
    """
    chunks = request.stream()
    if _announced(request) > max_bytes:
        raise await _too_large(chunks, max_bytes)
    with _FormWriter(_boundary(request), folder).open() as writer:
        received, pending = 0, bytearray()
        async for chunk in chunks:
            received += len(chunk)
            if received > max_bytes:
                raise await _too_large(chunks, max_bytes)
            pending += chunk
            if len(pending) >= WRITE_BYTES:
                await asyncio.to_thread(writer.write, bytes(pending))
                pending.clear()
        await asyncio.to_thread(writer.write, bytes(pending))
        return writer.finish()


def parse_fields(schema: type[Fields], fields: Mapping[str, str]) -> Fields:
    """The text fields of a form, checked like a JSON body.

    Raises:
        RequestValidationError: a field is wrong, or is not one of the form's.
    """
    try:
        return schema.model_validate({name: text for name, text in fields.items() if text})
    except ValidationError as error:
        errors = [{**item, "loc": ("body", *item["loc"])} for item in error.errors()]
        raise RequestValidationError(errors) from error


def _announced(request: Request) -> int:
    length = request.headers.get("content-length", "0")
    return int(length) if length.isdecimal() else 0


async def _too_large(chunks: AsyncIterator[bytes], max_bytes: int) -> TooLarge:
    """The error, once the sender has had time to finish: a browser in mid-upload hears no answer."""
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(DRAIN_S):
            async for _ in chunks:
                pass
    return TooLarge(f"an upload may have at most {max_bytes // MEBIBYTE} MB")


def _boundary(request: Request) -> bytes:
    kind, parameters = parse_options_header(request.headers.get("content-type", ""))
    if kind != b"multipart/form-data" or b"boundary" not in parameters:
        raise Problem(
            HTTPStatus.UNSUPPORTED_MEDIA_TYPE, "the upload must be a form (multipart/form-data)"
        )
    return parameters[b"boundary"]


class _FormWriter:
    """Parts of a multipart body, told by the parser's callbacks, into fields and files."""

    def __init__(self, boundary: bytes, folder: Path) -> None:
        self._form = UploadForm()
        self._folder = folder
        self._parts = 0
        self._ended = False
        self._name = ""
        self._header = b""
        self._headers: dict[bytes, bytes] = {}
        self._file: IO[bytes] | None = None
        self._value = bytearray()
        self._parser = MultipartParser(
            boundary,
            {
                "on_part_begin": self._begin_part,
                "on_header_field": self._header_field,
                "on_header_value": self._header_value,
                "on_headers_finished": self._headers_finished,
                "on_part_data": self._part_data,
                "on_part_end": self._end_part,
                "on_end": self._end,
            },
        )

    @contextlib.contextmanager
    def open(self) -> Iterator[_FormWriter]:
        """Closes the file of a part that never ends."""
        try:
            yield self
        finally:
            if self._file is not None:
                self._file.close()

    def write(self, data: bytes) -> None:
        """Takes the next bytes of the body."""
        try:
            self._parser.write(data)
        except FormParserError as error:
            raise Problem(HTTPStatus.BAD_REQUEST, f"the form is broken: {error}") from error

    def finish(self) -> UploadForm:
        """The form, once the body has ended."""
        if not self._ended:
            raise Problem(HTTPStatus.BAD_REQUEST, "the form ends in the middle")
        return self._form

    def _begin_part(self) -> None:
        self._parts += 1
        if self._parts > MAX_PARTS:
            raise TooLarge(f"a form may have at most {MAX_PARTS} parts")
        self._headers, self._header, self._value = {}, b"", bytearray()

    def _header_field(self, data: bytes, start: int, end: int) -> None:
        self._header = data[start:end].lower()

    def _header_value(self, data: bytes, start: int, end: int) -> None:
        self._headers[self._header] = self._headers.get(self._header, b"") + data[start:end]

    def _headers_finished(self) -> None:
        _, options = parse_options_header(self._headers.get(b"content-disposition", b""))
        self._name = options.get(b"name", b"").decode("utf-8", "replace")
        if b"filename" in options:
            name = safe_name(options[b"filename"].decode("utf-8", "replace"))
            path = self._folder / f"part{self._parts}" / name
            path.parent.mkdir()
            self._form.files[self._name] = UploadedFile(name, path)
            self._file = path.open("wb")

    def _part_data(self, data: bytes, start: int, end: int) -> None:
        if self._file is not None:
            self._file.write(data[start:end])
        elif len(self._value) + end - start > MAX_FIELD_BYTES:
            raise TooLarge(f"the field {self._name!r} is too long")
        else:
            self._value += data[start:end]

    def _end_part(self) -> None:
        if self._file is None:
            self._form.fields[self._name] = self._value.decode("utf-8", "replace")
        else:
            self._file.close()
            self._file = None

    def _end(self) -> None:
        self._ended = True


def safe_name(sent: str) -> str:
    """A file name as a browser or a hostile program sends it, made safe to create on any system."""
    last = sent.replace("\\", "/").rsplit("/", 1)[-1]
    kept = "".join("_" if c in UNSAFE_CHARACTERS or not c.isprintable() else c for c in last)
    return kept.strip(" .")[-MAX_NAME_LENGTH:] or "upload"
