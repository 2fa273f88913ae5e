"""The index: tables, migrations, transactions."""

from __future__ import annotations

import sqlite3
from pathlib import Path

import pytest
from sqlalchemy import insert, inspect, select
from sqlalchemy.exc import IntegrityError

from app.storage.database import Database
from app.storage.migrations import MIGRATIONS
from app.storage.tables import metadata, model_logs, samples
from core.errors import InputError


def test_the_migrations_make_the_tables_that_the_program_uses(tmp_path: Path) -> None:
    database = Database(tmp_path / "index.sqlite")
    with database.read() as connection:
        made = inspect(connection)
        for table in metadata.sorted_tables:
            columns = {
                (column["name"], type(column["type"]).__name__, column["nullable"])
                for column in made.get_columns(table.name)
            }
            assert columns == {
                (
                    column.name,
                    type(column.type).__name__.upper().replace("STRING", "VARCHAR"),
                    column.nullable,
                )
                for column in table.columns
            }, table.name
        assert set(made.get_table_names()) == {table.name for table in metadata.sorted_tables}
    database.close()


def test_an_index_is_opened_again_as_it_was(tmp_path: Path) -> None:
    first = Database(tmp_path / "index.sqlite")
    with first.write() as connection:
        connection.execute(insert(samples).values(file_name="a"))
    first.close()
    second = Database(tmp_path / "index.sqlite")
    with second.read() as connection:
        assert connection.execute(select(samples.c.file_name)).scalars().all() == ["a"]
        assert connection.exec_driver_sql("PRAGMA user_version").scalar() == len(MIGRATIONS)
        assert connection.exec_driver_sql("PRAGMA journal_mode").scalar() == "wal"
    second.close()


def test_an_index_of_a_newer_program_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "index.sqlite"
    with sqlite3.connect(path) as connection:
        connection.execute("PRAGMA user_version = 999")
    with pytest.raises(InputError, match="newer EchoRooms"):
        Database(path)


def test_a_file_that_is_no_index_is_told(tmp_path: Path) -> None:
    path = tmp_path / "index.sqlite"
    path.write_bytes(b"this is no database" * 100)
    with pytest.raises(InputError, match="no index of EchoRooms"):
        Database(path)


def test_a_failed_transaction_leaves_nothing(tmp_path: Path) -> None:
    database = Database(tmp_path / "index.sqlite")

    def fail() -> None:
        with database.write() as connection:
            connection.execute(insert(samples).values(file_name="a"))
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    with database.read() as connection:
        assert connection.execute(select(samples)).all() == []
    database.close()


def test_foreign_keys_are_enforced(tmp_path: Path) -> None:
    database = Database(tmp_path / "index.sqlite")
    with pytest.raises(IntegrityError), database.write() as connection:
        connection.execute(insert(model_logs).values(model_id="x", log_id="y", position=0))
    database.close()
