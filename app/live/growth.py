"""What a session's worker finds out goes to the model and to those who listen."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import time
from pathlib import Path
from typing import Any

from app.errors import Problem
from app.live.session import LiveSession
from app.live.workers import LiveWorkers
from app.services import Services
from app.storage.model_facts import TOPOLOGY_FILE, read_json
from core.errors import EchoRoomsError

logger = logging.getLogger(__name__)
BEHIND_S = 0.5
"""Seconds between a scan and its place in the map from which on the session is behind."""
PAUSE_AFTER_FAILURE_S = 2.0


class Growth:
    """Lets a worker take in what one session records, as long as there is something new."""

    def __init__(self, services: Services, session: LiveSession, workers: LiveWorkers) -> None:
        self._services = services
        self._session = session
        self._workers = workers
        self._news = asyncio.Event()
        self._since: float | None = None
        self._was_behind = self._grown = False
        self._model: asyncio.Task[None] | None = None
        self._task = asyncio.create_task(self._grow(), name=f"grow {session.record.id}")
        self.look()

    def look(self) -> None:
        """There may be new scans."""
        if self._since is None:
            self._since = time.monotonic()
        self._news.set()

    async def close(self) -> None:
        """Stops; the worker forgets the session."""
        running = [task for task in (self._task, self._model) if task is not None]
        for task in running:
            task.cancel()
        await asyncio.wait(running)
        with contextlib.suppress(EchoRoomsError):
            await self._workers.forget(self._session.record.id)

    async def _grow(self) -> None:
        while True:
            await self._news.wait()
            self._news.clear()
            asked, self._since = self._since, None
            try:
                while await self._advance():
                    self._tell_how_far_behind(asked)
                self._tell_how_far_behind(asked)
            except EchoRoomsError as error:
                logger.warning("live session %s: %s", self._session.record.id, error)
                await asyncio.sleep(PAUSE_AFTER_FAILURE_S)
            except Exception:
                logger.exception("live session %s: a step failed", self._session.record.id)
                await asyncio.sleep(PAUSE_AFTER_FAILURE_S)

    async def _advance(self) -> bool:
        """Takes in some scans; whether there are more."""
        services, session = self._services, self._session
        record = session.record
        arguments = {
            "recording": str(session.recording.path),
            "mode": record.mode,
            "size": session.recording.size,
        }
        if record.mode == "localization":
            folder = await asyncio.to_thread(services.models.folder, record.model_id)
            arguments["model"] = str(folder)
        result = await self._workers.run(record.id, "advance", arguments)
        if "frame" in result:
            session.frame = result["frame"]
        if result["scans"]:
            session.events.send({"type": "taken_in", "t": result["t"], "frame": session.frame})
        if "belief" in result:
            session.events.send(await asyncio.to_thread(self._belief, result["belief"]))
        if result.get("grown"):
            self._grown = True
        if self._grown and not result["behind"] and (self._model is None or self._model.done()):
            self._grown = False
            self._model = asyncio.create_task(self._make_model(), name=f"model {record.id}")
        return bool(result["behind"])

    async def _make_model(self) -> None:
        """Makes the model anew as soon as no scan of any session waits for the worker."""
        record = self._session.record
        try:
            with self._services.folder.temporary() as temp:
                out = {"out": str(temp / "model")}
                result = await self._workers.run(record.id, "model", out, urgent=False)
                await self._publish(temp / "model", result)
        except EchoRoomsError as error:
            logger.info("live session %s: no model (%s)", record.id, error)
        except Problem as problem:
            logger.info("live session %s: no model (%s)", record.id, problem.detail)
        except Exception:
            logger.exception("live session %s: no model", record.id)
        if self._grown:
            self.look()

    async def _publish(self, made: Path, result: dict[str, Any]) -> None:
        models, record, facts = self._services.models, self._session.record, result["facts"]
        await asyncio.to_thread(models.publish, record.model_id, made, [], facts, record.model_id)
        revision = (await asyncio.to_thread(models.get, record.model_id)).revision
        common = {"t": result["t"], "model_id": record.model_id, "revision": revision}
        self._session.events.send({"type": "map", **common})
        self._session.events.send({"type": "nodes", **common, "nodes": facts["nodes"]})

    def _belief(self, step: dict[str, Any]) -> dict[str, Any]:
        best = step["best"]
        folder = self._services.models.folder(self._session.record.model_id)
        nodes = read_json(folder / TOPOLOGY_FILE)["nodes"]
        names = {node["id"]: node["label"] for node in nodes}
        return {
            "type": "belief",
            "t": step["t"],
            "current_room": best,
            "label": names.get(best),
            "probability": step["probabilities"].get(best, 0.0),
            "probabilities": step["probabilities"],
            "unknown": step["unknown"],
            "entropy": step["entropy"],
            "pose": step["pose"],
        }

    def _tell_how_far_behind(self, asked: float | None) -> None:
        """Says when the map is late, and once more when it no longer is."""
        late = 0.0 if asked is None else time.monotonic() - asked
        if late > BEHIND_S or self._was_behind:
            told = round(late, 2) if late > BEHIND_S else 0.0
            self._session.events.send({"type": "behind", "seconds": told})
        self._was_behind = late > BEHIND_S
