"""Modelling jobs: a worker writes a model folder, the store takes it over when it is whole."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, TypeVar

from app.errors import Conflict, Problem, Unprocessable
from app.jobs.runner import ActiveJob
from app.services import Services
from app.storage.drift_files import drift_edits
from app.storage.map_source import MAP_YAML
from app.storage.records import JobRecord, ModelRecord, Status
from core.mapping.drift_edits import DriftEdits

KIND = "model"
MOST_DRIFT_EDITS = 500
"""Closures and places of one drive about which something can be said."""
Found = TypeVar("Found")
WORKING_SHARE = 0.98
"""The share of the progress that is the worker's; the rest is for keeping the result."""


@dataclass(frozen=True)
class Modelling:
    """One modelling job (a `Work`).

    Attributes:
        task: `model_log` or `model_map`.
        inputs: the files that the task reads.
        options: what `core.pipeline.modeller.ModellingOptions` takes.
        log_ids: the logs that the finished model is made from.
        labels_from: the model whose labels go along by overlap, as they are when this one is done.
        edit: what is done, in words, when undo is to lead back to the model as it is.
    """

    services: Services
    model_id: str
    task: str
    inputs: Sequence[Path]
    options: Mapping[str, Any]
    log_ids: Sequence[str]
    labels_from: str | None = None
    edit: str | None = None

    async def run(self, job: ActiveJob) -> None:
        """Makes the model."""
        models, limits = self.services.models, self.services.job_limits
        await asyncio.to_thread(models.set_running, self.model_id)

        def report(share: float, what: str) -> None:
            job.report(WORKING_SHARE * share, what)

        with self.services.folder.temporary() as temp:
            made = temp / "model"
            arguments = {
                "inputs": [str(path) for path in self.inputs],
                "options": dict(self.options),
                "out": str(made),
            }
            facts = await self.services.pool.run(self.task, arguments, limits, report)
            with job.commit():
                await asyncio.to_thread(
                    models.publish,
                    self.model_id,
                    made,
                    self.log_ids,
                    facts,
                    self.labels_from,
                    self.edit,
                )

    def ended(self, status: Status, error: str | None) -> None:
        """Notes on the model how its job ended."""
        if status is not Status.DONE:
            self.services.models.set_ended(self.model_id, status, error)


async def model_a_log(
    services: Services,
    log_id: str,
    name: str | None,
    options: Mapping[str, Any],
    labels_from: str | None = None,
    known_robot: bool = False,
) -> tuple[ModelRecord, JobRecord]:
    """A new model of a log, queued.

    Args:
        known_robot: begin with what an earlier drive told of the robot's odometry.

    Raises:
        Unprocessable: there is no such log, no such model to take labels from, or nothing is known
            of the robot.
    """

    def begin() -> tuple[ModelRecord, JobRecord]:
        log = _named("log_id", services.logs.get, log_id)
        if labels_from is not None:
            _named("labels_from", services.models.folder, labels_from)
        known = _known_robot(services, log_id) if known_robot else {}
        model = services.models.add(name or log.name, {**options, **known}, [log_id])
        return model, _begin(services, model.id)

    model, job = await asyncio.to_thread(begin)
    inputs = [services.logs.native_file(log_id)]
    work = Modelling(services, model.id, "model_log", inputs, model.options, [log_id], labels_from)
    services.runner.submit(job, work)
    return model, job


async def model_again(services: Services, model_id: str, log_id: str) -> JobRecord:
    """A model that has grown with a live session, to be made from the session's log, queued.

    Raises:
        NotFound: the model was deleted.
        Conflict: a job is already at the model.
    """

    def begin() -> tuple[ModelRecord, JobRecord]:
        return services.models.get(model_id), _begin(services, model_id)

    model, job = await asyncio.to_thread(begin)
    inputs = [services.logs.native_file(log_id)]
    work = Modelling(
        services, model_id, "model_log", inputs, model.options, [log_id], labels_from=model_id
    )
    services.runner.submit(job, work)
    return job


async def model_drift_again(
    services: Services, model_id: str, change: Callable[[DriftEdits], DriftEdits], what: str
) -> JobRecord:
    """The model, to be made again with what a person says about its drift, queued.

    Args:
        change: of what was said before.
        what: is said, in words.

    Raises:
        NotFound: there is no such model.
        Unprocessable: it was not made from a drive whose odometry was corrected.
        Conflict: it is not made yet, or a job is at it.
    """

    def begin() -> tuple[ModelRecord, JobRecord, dict[str, Any]]:
        with services.models.locked():
            model = services.models.get(model_id)
            if model.options.get("odometry", "corrected") != "corrected" or not model.log_ids:
                raise Unprocessable("the model has no corrected drive about which to say anything")
            edits = change(drift_edits(services.models.folder(model_id)))
            if edits.count > MOST_DRIFT_EDITS:
                raise Unprocessable(f"more than {MOST_DRIFT_EDITS} words about one drive")
            options = {**model.options, "edits": asdict(edits)}
            return model, _begin(services, model_id), options

    model, job, options = await asyncio.to_thread(begin)
    inputs = [services.logs.native_file(log_id) for log_id in model.log_ids]
    work = Modelling(
        services, model_id, "model_log", inputs, options, model.log_ids, model_id, what
    )
    services.runner.submit(job, work)
    return job


async def model_a_map(
    services: Services, source: Path, name: str, options: Mapping[str, Any]
) -> tuple[ModelRecord, JobRecord]:
    """A new model of a map that a worker has checked, queued.

    Args:
        source: the folder with `map.yaml` and its image; it is taken over.
    """

    def begin() -> tuple[ModelRecord, JobRecord, Path]:
        model = services.models.add(name, options, [])
        kept = services.models.add_source(model.id, source)
        return model, _begin(services, model.id), kept

    model, job, kept = await asyncio.to_thread(begin)
    work = Modelling(services, model.id, "model_map", [kept / MAP_YAML], options, [])
    services.runner.submit(job, work)
    return model, job


async def continue_model(services: Services, model_id: str, log_id: str) -> JobRecord:
    """The model, to be made again from its logs and another one of the same drive, queued.

    Raises:
        NotFound: there is no such model.
        Unprocessable: there is no such log, or the model cannot go on with it.
        Conflict: a job is already at the model.
    """

    def begin() -> tuple[ModelRecord, JobRecord, DriftEdits]:
        model = services.models.get(model_id)
        _named("log_id", services.logs.get, log_id)
        if not model.log_ids:
            raise Unprocessable("the model was made from a map: it has no drive to go on with")
        if log_id in model.log_ids:
            raise Unprocessable("the model already has this log")
        made = services.models.history(model_id) is not None
        edits = drift_edits(services.models.folder(model_id)) if made else DriftEdits()
        return model, _begin(services, model_id), edits

    model, job, edits = await asyncio.to_thread(begin)
    log_ids = [*model.log_ids, log_id]
    inputs = [services.logs.native_file(part) for part in log_ids]
    options = {**model.options, "edits": asdict(edits)}
    work = Modelling(
        services, model_id, "model_log", inputs, options, log_ids, labels_from=model_id
    )
    services.runner.submit(job, work)
    return job


def _begin(services: Services, model_id: str) -> JobRecord:
    with services.models.locked():
        model = services.models.get(model_id)
        if model.job_id is not None and not model.status.ended:
            raise Conflict(f"the model {model.name!r} is being made; wait for its job or cancel it")
        job = services.jobs.add(KIND, model_id)
        services.models.set_job(model_id, job.id)
        return job


def _known_robot(services: Services, log_id: str) -> dict[str, Any]:
    """The modeller's option that holds what is known of a log's robot."""
    known = services.calibrations.get(services.logs.ring_of(log_id))
    if known is None:
        raise Unprocessable("calibration: nothing is known of this robot's odometry yet")
    return {"known": dict(known.found)}


def _named(field: str, get: Callable[[str], Found], identifier: str) -> Found:
    """What a field of a body names."""
    try:
        return get(identifier)
    except Problem as error:
        raise Unprocessable(f"{field}: {error.detail}") from error
