"""The index grows with the product: numbered steps, the number of the last one in `user_version`.

A step, once released, is never edited; a change of the tables is a new step at the end.
"""

from __future__ import annotations

from sqlalchemy import Connection

from core.errors import InputError

_INITIAL = (
    """CREATE TABLE logs (
        id VARCHAR NOT NULL PRIMARY KEY, name VARCHAR NOT NULL, created FLOAT NOT NULL,
        scans INTEGER NOT NULL, sonars INTEGER NOT NULL, duration_s FLOAT NOT NULL,
        distance_m FLOAT NOT NULL, size_bytes INTEGER NOT NULL)""",
    """CREATE TABLE models (
        id VARCHAR NOT NULL PRIMARY KEY, name VARCHAR NOT NULL, created FLOAT NOT NULL,
        updated FLOAT NOT NULL, status VARCHAR NOT NULL, error TEXT, job_id VARCHAR,
        options TEXT NOT NULL, nodes INTEGER NOT NULL, rooms INTEGER NOT NULL,
        area_m2 FLOAT NOT NULL, labels TEXT NOT NULL, size_bytes INTEGER NOT NULL,
        revision INTEGER NOT NULL)""",
    """CREATE TABLE model_logs (
        model_id VARCHAR NOT NULL REFERENCES models (id) ON DELETE CASCADE,
        log_id VARCHAR NOT NULL REFERENCES logs (id) ON DELETE RESTRICT,
        position INTEGER NOT NULL, PRIMARY KEY (model_id, log_id))""",
    "CREATE INDEX model_logs_of_log ON model_logs (log_id)",
    """CREATE TABLE jobs (
        id VARCHAR NOT NULL PRIMARY KEY, kind VARCHAR NOT NULL, subject_id VARCHAR NOT NULL,
        status VARCHAR NOT NULL, error TEXT, created FLOAT NOT NULL, started FLOAT,
        finished FLOAT)""",
    "CREATE INDEX jobs_of_status ON jobs (status)",
    "CREATE TABLE samples (file_name VARCHAR NOT NULL PRIMARY KEY)",
)

_LOCALIZATIONS = (
    """CREATE TABLE localizations (
        id VARCHAR NOT NULL PRIMARY KEY, name VARCHAR NOT NULL, created FLOAT NOT NULL,
        model_id VARCHAR NOT NULL REFERENCES models (id) ON DELETE CASCADE,
        log_id VARCHAR NOT NULL REFERENCES logs (id) ON DELETE RESTRICT,
        status VARCHAR NOT NULL, error TEXT, job_id VARCHAR, options TEXT NOT NULL,
        steps INTEGER NOT NULL)""",
    "CREATE INDEX localizations_of_model ON localizations (model_id)",
    "CREATE INDEX localizations_of_log ON localizations (log_id)",
)

_CALIBRATIONS = (
    """CREATE TABLE calibrations (
        ring VARCHAR NOT NULL PRIMARY KEY, model_name VARCHAR NOT NULL, kept FLOAT NOT NULL,
        found TEXT NOT NULL)""",
)

MIGRATIONS: tuple[tuple[str, ...], ...] = (_INITIAL, _LOCALIZATIONS, _CALIBRATIONS)


def migrate(connection: Connection) -> None:
    """Brings the tables up to date, all steps in the caller's transaction.

    Raises:
        InputError: a newer EchoRooms has used this index.
    """
    version = int(connection.exec_driver_sql("PRAGMA user_version").scalar_one())
    if version > len(MIGRATIONS):
        raise InputError(
            "the data folder was used by a newer EchoRooms; update EchoRooms or use another folder"
        )
    for step in MIGRATIONS[version:]:
        for statement in step:
            connection.exec_driver_sql(statement)
    connection.exec_driver_sql(f"PRAGMA user_version = {len(MIGRATIONS)}")
