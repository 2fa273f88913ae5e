"""The model of a session grows: after every few metres a worker models what is recorded so far."""

from __future__ import annotations

import asyncio
import json
import logging
import time
from pathlib import Path
from typing import Any

from app.live.session import LiveSession
from app.services import Services
from core.errors import EchoRoomsError

logger = logging.getLogger(__name__)
STEP_M = 2.5
"""Metres of travel between two modelling or localization steps (paper, Sect. 4)."""
BEHIND_S = 0.5
"""A step that had to wait longer than this for a worker is reported."""


class Growth:
    """Models or localizes one session, one step at a time; skips steps when workers are busy."""

    def __init__(self, services: Services, session: LiveSession, slots: asyncio.Semaphore) -> None:
        self._services = services
        self._session = session
        self._slots = slots
        self._done_m = 0.0
        self._step: asyncio.Task[None] | None = None

    def look(self) -> None:
        """Begins a step if the robot has come far enough and none is running."""
        driven = self._session.recording.distance_m
        if driven - self._done_m >= STEP_M and (self._step is None or self._step.done()):
            self._done_m = driven
            self._step = asyncio.create_task(self._take_step())

    async def close(self) -> None:
        """Stops the step that is running."""
        if self._step is not None:
            self._step.cancel()
            await asyncio.wait([self._step])

    async def _take_step(self) -> None:
        session, asked = self._session, time.monotonic()
        try:
            async with self._slots:
                waited = time.monotonic() - asked
                if waited > BEHIND_S:
                    session.events.send({"type": "behind", "seconds": round(waited, 2)})
                if session.record.mode == "mapping":
                    await self._model()
                else:
                    await self._localize()
        except EchoRoomsError as error:
            logger.info("live session %s: step left out (%s)", session.record.id, error)
        except Exception:
            logger.exception("live session %s: step failed", session.record.id)

    async def _model(self) -> None:
        services, record, t = self._services, self._session.record, self._session.recording.last_t
        with services.folder.temporary() as temp:
            out = temp / "model"
            arguments = {
                "inputs": [str(self._session.recording.path)],
                "options": {},
                "out": str(out),
            }
            facts = await services.pool.run("model_log", arguments, services.job_limits)
            publish = services.models.publish
            await asyncio.to_thread(publish, record.model_id, out, [], facts, record.model_id)
        revision = (await asyncio.to_thread(services.models.get, record.model_id)).revision
        common = {"t": t, "model_id": record.model_id, "revision": revision}
        self._session.events.send({"type": "map", **common})
        self._session.events.send({"type": "nodes", **common, "nodes": facts["nodes"]})

    async def _localize(self) -> None:
        services, record = self._services, self._session.record
        with services.folder.temporary() as temp:
            out = temp / "steps.jsonl"
            model = await asyncio.to_thread(services.models.folder, record.model_id)
            arguments = {
                "model": str(model),
                "log": str(self._session.recording.path),
                "options": {},
                "out": str(out),
            }
            await services.pool.run("localize", arguments, services.job_limits)
            step = _last_step(out)
        if step is not None:
            self._session.events.send(_belief(step))


def _last_step(path: Path) -> dict[str, Any] | None:
    lines = path.read_text(encoding="utf-8").splitlines()
    step: dict[str, Any] | None = json.loads(lines[-1]) if lines else None
    return step


def _belief(step: dict[str, Any]) -> dict[str, Any]:
    best = step["best"]
    return {
        "type": "belief",
        "t": step["t"],
        "current_room": best,
        "probability": step["probabilities"].get(best, 0.0),
        "probabilities": step["probabilities"],
        "unknown": step["unknown"],
        "entropy": step["entropy"],
        "pose": step["pose"],
    }
