"""Which sample logs were loaded once: one that somebody has deleted does not come back."""

from __future__ import annotations

from sqlalchemy import insert, select

from app.storage.database import Database
from app.storage.tables import samples


class SampleStore:
    """Remembers file names. Thread-safe."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def loaded(self) -> set[str]:
        """The names of all files that were loaded."""
        with self._database.read() as connection:
            return set(connection.execute(select(samples.c.file_name)).scalars())

    def add(self, file_name: str) -> None:
        """Notes that a file was loaded."""
        with self._database.write() as connection:
            connection.execute(insert(samples).values(file_name=file_name))
