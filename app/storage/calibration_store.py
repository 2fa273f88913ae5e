"""What is known of robots' odometry, to be offered for their next logs."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping

from sqlalchemy import delete, insert, select

from app.storage.database import Database
from app.storage.records import CalibrationRecord
from app.storage.tables import calibrations


class CalibrationStore:
    """Keeps one calibration for each robot, told apart by its sonar ring. Thread-safe."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def keep(self, ring: str, model_name: str, found: Mapping[str, float]) -> CalibrationRecord:
        """Keeps what a drive told; what was known before is replaced."""
        record = CalibrationRecord(ring, model_name, time.time(), dict(found))
        with self._database.write() as connection:
            connection.execute(delete(calibrations).where(calibrations.c.ring == ring))
            row = vars(record) | {"found": json.dumps(record.found)}
            connection.execute(insert(calibrations).values(**row))
        return record

    def get(self, ring: str) -> CalibrationRecord | None:
        """What is known of a robot, or None."""
        statement = select(calibrations).where(calibrations.c.ring == ring)
        with self._database.read() as connection:
            row = connection.execute(statement).mappings().first()
        if row is None:
            return None
        return CalibrationRecord(**{**row, "found": json.loads(row["found"])})

    def forget(self, ring: str) -> None:
        """Nothing is known of the robot any more."""
        with self._database.write() as connection:
            connection.execute(delete(calibrations).where(calibrations.c.ring == ring))
