"""All live sessions of a server: begun, found again after a crash, fed, and turned into logs."""

from __future__ import annotations

import asyncio
import logging
import os
import time
from dataclasses import replace
from typing import Any, Literal

from app.errors import Conflict, NotFound, Unprocessable
from app.jobs.modelling import model_a_log, model_again
from app.jobs.reading import keep_log, read_upload
from app.live.commits import GroupCommit
from app.live.growth import Growth
from app.live.session import Acknowledgement, LiveRecord, LiveSession, LiveStatus
from app.live.store import LiveStore
from app.live.workers import LiveWorkers
from app.services import Services
from app.storage.data_folder import new_id
from app.storage.records import JobRecord, ModelRecord
from core.log_readers.native import parse_header

logger = logging.getLogger(__name__)
Mode = Literal["mapping", "localization"]


class LiveHub:
    """The sessions. Event loop's thread only."""

    def __init__(self, services: Services) -> None:
        self._services = services
        self._store = LiveStore(services.folder)
        self._commits = GroupCommit()
        self._workers = LiveWorkers(services.settings.max_jobs, services.job_limits)
        self._ended: dict[str, LiveRecord] = {}
        self._running: dict[str, LiveSession] = {}
        self._growth: dict[str, Growth] = {}
        self._finishing: set[asyncio.Task[None]] = set()

    async def recover(self) -> None:
        """Goes on with what a stop or a crash of the server has interrupted."""
        for record in await asyncio.to_thread(lambda: list(self._store.records())):
            if record.status is LiveStatus.ENDED:
                self._ended[record.id] = record
                continue
            recording = await asyncio.to_thread(self._store.recording, record.id)
            self._begin(LiveSession(record, recording, self._commits))
            if record.status is LiveStatus.FINISHING:
                self._finish_later(self._running[record.id])

    async def close(self) -> None:
        """Stops; running sessions go on with the next start."""
        for growth in self._growth.values():
            await growth.close()
        for task in self._finishing:
            task.cancel()
        if self._finishing:
            await asyncio.wait(self._finishing)
        await self._workers.close()
        await self._commits.close()

    async def create(
        self, mode: Mode, header: dict[str, Any], model_id: str | None, origin: str = ""
    ) -> LiveRecord:
        """A new session.

        Raises:
            LogError, TooLargeError: the header is wrong.
            Unprocessable, Conflict: there is no such model to localize in, or it is not made yet.
        """
        name = parse_header(header)[0] or "live drive"
        record = await asyncio.to_thread(self._new_record, mode, name, model_id)
        record = replace(record, origin=origin)
        recording = await asyncio.to_thread(self._store.create, record, header)
        self._begin(LiveSession(record, recording, self._commits))
        return record

    def session(self, session_id: str) -> LiveSession:
        """A session that has not ended.

        Raises:
            NotFound: there is none of that id.
            Conflict: it has ended.
        """
        if session_id in self._ended:
            raise Conflict("the session has ended: no more scans are taken")
        if session_id not in self._running:
            raise NotFound("live session", session_id)
        return self._running[session_id]

    def running(self, view_id: str) -> LiveSession | None:
        """The session of that id if it has not ended. For any thread."""
        return self._running.get(view_id)

    def model_of(self, view_id: str) -> str:
        """The model to be shown for the id of a session, or of a model. For any thread."""
        running, ended = self._running.get(view_id), self._ended.get(view_id)
        record = running.record if running is not None else ended
        return view_id if record is None else record.model_id

    def record(self, session_id: str) -> LiveRecord:
        """Where a session stands.

        Raises:
            NotFound: there is none of that id.
        """
        if session_id in self._ended:
            return self._ended[session_id]
        session = self.session(session_id)
        recording = session.recording
        return replace(session.record, stored=recording.stored, last_t=recording.last_t)

    def records(self) -> list[LiveRecord]:
        """All sessions, the newest first."""
        every = [*self._ended.values(), *(self.record(key) for key in self._running)]
        return sorted(every, key=lambda record: -record.created)

    async def take(self, session_id: str, records: Any) -> Acknowledgement:
        """Keeps scans of a session; returns once they are safe (see `LiveSession.take`)."""
        session = self.session(session_id)
        acknowledgement = await session.take(records)
        self._growth[session_id].look()
        return acknowledgement

    async def save(self, session_id: str) -> tuple[ModelRecord, JobRecord]:
        """Keeps what a session has recorded so far as a log, and makes a model of that.

        Raises:
            NotFound, Conflict: there is no such session, or it has ended.
            LogError: there is too little in it yet.
        """
        session, services = self.session(session_id), self._services
        with services.folder.temporary() as temp:
            upload = temp / "live.jsonl"
            recorded = await asyncio.to_thread(session.recording.so_far)
            await asyncio.to_thread(upload.write_bytes, recorded)
            log = await keep_log(services, upload, None, temp)
        names = session.record.model_id if session.record.mode == "mapping" else None
        if names is not None and await asyncio.to_thread(services.models.load, names) is None:
            names = None
        return await model_a_log(services, log.id, None, {"mode": "autonomous"}, names)

    async def finish(self, session_id: str) -> LiveRecord:
        """Ends a session: it becomes an ordinary log, and its model is made a last time.

        Raises:
            NotFound, Conflict: there is none, or it has ended.
        """
        session = self.session(session_id)
        if session.record.status is LiveStatus.RUNNING:
            session.record = replace(session.record, status=LiveStatus.FINISHING)
            await asyncio.to_thread(self._store.save, session.record)
            self._finish_later(session)
        return self.record(session_id)

    def _new_record(self, mode: Mode, name: str, model_id: str | None) -> LiveRecord:
        models, now = self._services.models, time.time()
        if mode == "mapping":
            model_id = models.add(name, {"mode": "autonomous"}, []).id
            return LiveRecord(model_id, mode, name, new_id(), model_id, now)
        if model_id is None:
            raise Unprocessable("localization needs the id of a model: give model_id")
        try:
            models.folder(model_id)
        except NotFound as error:
            raise Unprocessable(str(error.detail)) from error
        return LiveRecord(new_id(), mode, name, new_id(), model_id, now)

    def _begin(self, session: LiveSession) -> None:
        self._running[session.record.id] = session
        self._growth[session.record.id] = Growth(self._services, session, self._workers)

    def _finish_later(self, session: LiveSession) -> None:
        task = asyncio.create_task(self._finish(session), name=f"finish {session.record.id}")
        self._finishing.add(task)
        task.add_done_callback(self._finishing.discard)

    async def _finish(self, session: LiveSession) -> None:
        record, recording = session.record, session.recording
        try:
            await self._growth[record.id].close()
            await self._commits.store(recording, [])
            if recording.stored:
                await self._keep_log(record)
        except Exception:
            logger.exception(
                "live session %s could not be finished; a restart tries again", record.id
            )
            return
        record = replace(
            record, status=LiveStatus.ENDED, stored=recording.stored, last_t=recording.last_t
        )
        await asyncio.to_thread(self._store.save, record)
        await asyncio.to_thread(self._store.remove_recording, record.id)
        self._ended[record.id] = record
        del self._running[record.id], self._growth[record.id]
        session.events.send({"type": "ended", "log_id": record.log_id, "model_id": record.model_id})

    async def _keep_log(self, record: LiveRecord) -> None:
        """The recording as a log, unless a crash came right after that, and its model."""
        services = self._services
        with services.folder.temporary() as temp:
            upload, prepared = temp / "live.jsonl", temp / "log"
            await asyncio.to_thread(os.link, self._store.recording_file(record.id), upload)
            try:
                await asyncio.to_thread(services.logs.get, record.log_id)
            except NotFound:
                arguments = {"upload": str(upload), "ring": None, "out": str(prepared)}
                summary = await read_upload(services, "read_log", arguments)
                await asyncio.to_thread(services.logs.add, prepared, summary, record.log_id)
        if record.mode == "mapping":
            try:
                await model_again(services, record.model_id, record.log_id)
            except NotFound:
                logger.info("live session %s: its model was deleted", record.id)
