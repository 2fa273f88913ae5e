"""The SQLite index: one file, many readers beside one writer, foreign keys enforced."""

from __future__ import annotations

from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, create_engine, event
from sqlalchemy.exc import DatabaseError

from app.storage.migrations import migrate
from core.errors import InputError

BUSY_TIMEOUT_MS = 10_000


class Database:
    """Transactions on the index. Thread-safe."""

    def __init__(self, path: Path) -> None:
        """Creates the index or brings it up to date.

        Raises:
            InputError: the file is no such index, or a newer EchoRooms has used it.
        """
        self._writer = create_engine(f"sqlite:///{path}")
        self._reader = self._writer.execution_options(read_only=True)
        event.listen(self._writer, "connect", _configure)
        event.listen(self._writer, "begin", _begin)
        try:
            with self.write() as connection:
                migrate(connection)
        except DatabaseError as error:
            self.close()
            raise InputError(f"{path} is no index of EchoRooms ({error.orig})") from error

    def read(self) -> AbstractContextManager[Connection]:
        """A transaction that only reads."""
        return self._reader.begin()

    def write(self) -> AbstractContextManager[Connection]:
        """A transaction that may write: committed at the end, rolled back on an exception."""
        return self._writer.begin()

    def close(self) -> None:
        """Closes every connection."""
        self._writer.dispose()


def _configure(connection: Any, record: Any) -> None:
    """Settings of every new connection. The driver must not begin transactions by itself."""
    connection.isolation_level = None
    for pragma in (
        f"busy_timeout = {BUSY_TIMEOUT_MS}",
        "journal_mode = WAL",
        "synchronous = FULL",
        "foreign_keys = ON",
    ):
        connection.execute(f"PRAGMA {pragma}")


def _begin(connection: Connection) -> None:
    """A writer takes the lock at once: no transaction fails half-way for want of it."""
    read_only = connection.get_execution_options().get("read_only", False)
    connection.exec_driver_sql("BEGIN" if read_only else "BEGIN IMMEDIATE")
