"""The records of models as rows of the database."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, RowMapping, delete, insert, select

from app.storage.records import ModelRecord, Status
from app.storage.tables import model_logs


def row_of(record: ModelRecord) -> dict[str, Any]:
    """A record as a row of the models; its logs are rows of their own."""
    row = vars(record) | {
        "options": json.dumps(dict(record.options)),
        "labels": json.dumps(record.labels),
    }
    del row["log_ids"]
    return row


def record_of(row: RowMapping, log_ids: Mapping[str, Sequence[str]]) -> ModelRecord:
    """The record of a row; `log_ids` are those of each model."""
    return ModelRecord(
        **{
            **row,
            "status": Status(row["status"]),
            "options": json.loads(row["options"]),
            "labels": tuple(json.loads(row["labels"])),
            "log_ids": tuple(log_ids[row["id"]]),
        }
    )


def link_logs(connection: Connection, model_id: str, log_ids: Sequence[str]) -> None:
    """Replaces the logs that a model is made from."""
    connection.execute(delete(model_logs).where(model_logs.c.model_id == model_id))
    for position, log_id in enumerate(log_ids):
        connection.execute(
            insert(model_logs).values(model_id=model_id, log_id=log_id, position=position)
        )


def log_ids_of(connection: Connection, model_ids: Sequence[str]) -> dict[str, list[str]]:
    """The logs of each of the models, in order."""
    grouped: dict[str, list[str]] = {model_id: [] for model_id in model_ids}
    rows = connection.execute(
        select(model_logs)
        .where(model_logs.c.model_id.in_(model_ids))
        .order_by(model_logs.c.position)
    )
    for row in rows:
        grouped[row.model_id].append(row.log_id)
    return grouped
