"""The tables of the index. `migrations.py` creates them; a test keeps the two alike."""

from __future__ import annotations

from sqlalchemy import Column, Float, ForeignKey, Integer, MetaData, String, Table, Text

metadata = MetaData()

logs = Table(
    "logs",
    metadata,
    Column("id", String, primary_key=True),
    Column("name", String, nullable=False),
    Column("created", Float, nullable=False),
    Column("scans", Integer, nullable=False),
    Column("sonars", Integer, nullable=False),
    Column("duration_s", Float, nullable=False),
    Column("distance_m", Float, nullable=False),
    Column("size_bytes", Integer, nullable=False),
)

models = Table(
    "models",
    metadata,
    Column("id", String, primary_key=True),
    Column("name", String, nullable=False),
    Column("created", Float, nullable=False),
    Column("updated", Float, nullable=False),
    Column("status", String, nullable=False),
    Column("error", Text),
    Column("job_id", String),
    Column("options", Text, nullable=False),
    Column("nodes", Integer, nullable=False),
    Column("rooms", Integer, nullable=False),
    Column("area_m2", Float, nullable=False),
    Column("labels", Text, nullable=False),
    Column("size_bytes", Integer, nullable=False),
    Column("revision", Integer, nullable=False),
)

model_logs = Table(
    "model_logs",
    metadata,
    Column("model_id", ForeignKey("models.id", ondelete="CASCADE"), primary_key=True),
    Column("log_id", ForeignKey("logs.id", ondelete="RESTRICT"), primary_key=True),
    Column("position", Integer, nullable=False),
)

localizations = Table(
    "localizations",
    metadata,
    Column("id", String, primary_key=True),
    Column("name", String, nullable=False),
    Column("created", Float, nullable=False),
    Column("model_id", ForeignKey("models.id", ondelete="CASCADE"), nullable=False),
    Column("log_id", ForeignKey("logs.id", ondelete="RESTRICT"), nullable=False),
    Column("status", String, nullable=False),
    Column("error", Text),
    Column("job_id", String),
    Column("options", Text, nullable=False),
    Column("steps", Integer, nullable=False),
)

jobs = Table(
    "jobs",
    metadata,
    Column("id", String, primary_key=True),
    Column("kind", String, nullable=False),
    Column("subject_id", String, nullable=False),
    Column("status", String, nullable=False),
    Column("error", Text),
    Column("created", Float, nullable=False),
    Column("started", Float),
    Column("finished", Float),
)

calibrations = Table(
    "calibrations",
    metadata,
    Column("ring", String, primary_key=True),
    Column("model_name", String, nullable=False),
    Column("kept", Float, nullable=False),
    Column("found", Text, nullable=False),
)
"""What is known of a robot's odometry, by the fingerprint of its sonar ring."""

samples = Table("samples", metadata, Column("file_name", String, primary_key=True))
"""Sample logs that were loaded once: one that was deleted does not come back."""
