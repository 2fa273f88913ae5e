"""Live sessions: a robot sends scans, programs and pages hear what becomes of them."""

from __future__ import annotations

import asyncio
import contextlib
import json
from datetime import datetime
from http import HTTPStatus
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Body, Depends, Response, WebSocket, WebSocketDisconnect
from pydantic import BaseModel, Field
from starlette.requests import HTTPConnection

from app.api.schemas import Accepted, moment
from app.api.schemas import Body as ClosedBody
from app.errors import Problem
from app.live.hub import LiveHub
from app.live.session import MODEL_ID, Acknowledgement, LiveRecord, LiveStatus
from core.errors import InputError

router = APIRouter(prefix="/live", tags=["live"])
NO_SUCH_SESSION, ENDED, TOO_BIG = 4404, 4409, 1009
LARGEST_MESSAGE = 1 << 23
"""Bytes of one WebSocket message."""


def get_live(connection: HTTPConnection) -> LiveHub:
    """The live sessions of the app that got the request."""
    live: LiveHub = connection.app.state.live
    return live


LiveDep = Annotated[LiveHub, Depends(get_live)]


class LiveBody(ClosedBody):
    """A session to be begun."""

    mode: Literal["mapping", "localization"] = "mapping"
    header: dict[str, Any] = Field(description="the first line of a native log")
    model_id: str | None = Field(None, pattern=MODEL_ID, description="where to localize")


class LiveDetail(BaseModel):
    """A session as it is now."""

    id: str
    mode: str
    name: str
    status: LiveStatus
    log_id: str = Field(description="there is such a log once the session has ended")
    model_id: str
    created: datetime
    stored: int = Field(description="scans that are safe")
    last_t: float | None = Field(description="time of the last of them: send later ones")

    @classmethod
    def of(cls, record: LiveRecord) -> LiveDetail:
        """What is told of a session."""
        return cls(**{**vars(record), "created": moment(record.created)})


class Ack(BaseModel):
    """Every scan up to `ack` is safe."""

    ack: float | None
    stored: int
    duplicates: int = Field(description="scans of this message that were late or known already")

    @classmethod
    def of(cls, acknowledgement: Acknowledgement) -> Ack:
        """What is answered to scans."""
        return cls(**vars(acknowledgement))


@router.post("", status_code=HTTPStatus.CREATED, summary="Begin a live session")
async def begin(body: LiveBody, live: LiveDep) -> LiveDetail:
    """Begins to record; a model grows with the drive, or the robot is looked for in one."""
    return LiveDetail.of(await live.create(body.mode, body.header, body.model_id))


@router.get("", summary="List live sessions")
async def list_sessions(live: LiveDep) -> list[LiveDetail]:
    """All sessions, the newest first; those that have ended too."""
    return [LiveDetail.of(record) for record in live.records()]


@router.get("/{session_id}", summary="One live session")
async def get_session(session_id: str, live: LiveDep) -> LiveDetail:
    """How far the session is; a robot that reconnects goes on after `last_t`."""
    return LiveDetail.of(live.record(session_id))


@router.delete("/{session_id}", status_code=HTTPStatus.ACCEPTED, summary="Finish a live session")
async def finish(session_id: str, live: LiveDep) -> LiveDetail:
    """Ends the session; it becomes an ordinary log with its model."""
    return LiveDetail.of(await live.finish(session_id))


@router.get("/{session_id}/log", summary="Download what is recorded so far")
async def recorded(session_id: str, live: LiveDep) -> Response:
    """A native log of every scan that is safe by now."""
    content = await asyncio.to_thread(live.session(session_id).recording.so_far)
    disposition = {"content-disposition": f'attachment; filename="live-{session_id}.jsonl"'}
    return Response(content, media_type="application/jsonl", headers=disposition)


@router.post(
    "/{session_id}/models",
    status_code=HTTPStatus.ACCEPTED,
    summary="Save what is there so far as a log and a model",
)
async def save(session_id: str, live: LiveDep) -> Accepted:
    """The session goes on; names of its regions go along by overlap."""
    model, job = await live.save(session_id)
    return Accepted(id=model.id, job_id=job.id)


@router.post("/{session_id}/scans", summary="Send scans")
async def send_scans(
    session_id: str, scans: Annotated[list[dict[str, Any]], Body()], live: LiveDep
) -> Ack:
    """Answers once the scans are safely stored; late scans and duplicates are counted."""
    return Ack.of(await live.take(session_id, scans))


@router.websocket("/{session_id}/scans")
async def stream_scans(websocket: WebSocket, session_id: str, live: LiveDep) -> None:
    """Takes scan lines (or lists of them) and answers each message once it is safely stored."""
    await websocket.accept()
    with contextlib.suppress(WebSocketDisconnect):
        if not await _exists(websocket, live, session_id):
            return
        while (message := await websocket.receive())["type"] == "websocket.receive":
            content = message.get("text")
            content = message.get("bytes") or b"" if content is None else content
            if len(content) > LARGEST_MESSAGE:
                await websocket.close(TOO_BIG, "the message is too big")
                return
            await websocket.send_json(await _answer(live, session_id, content))


@router.websocket("/{session_id}/events")
async def follow(websocket: WebSocket, session_id: str, live: LiveDep) -> None:
    """Typed JSON events, from now on: pose, map, nodes, belief, behind, ended."""
    await websocket.accept()
    with contextlib.suppress(WebSocketDisconnect):
        if not await _exists(websocket, live, session_id):
            return
        events = live.session(session_id).events
        listener = events.listen()
        leaving = asyncio.create_task(_until_left(websocket))
        try:
            while not leaving.done():
                taking = asyncio.create_task(listener.take())
                await asyncio.wait({leaving, taking}, return_when=asyncio.FIRST_COMPLETED)
                if not taking.done():
                    taking.cancel()
                    break
                event = taking.result()
                await websocket.send_json(event)
                if event["type"] == "ended":
                    await websocket.close()
                    break
        finally:
            events.leave(listener)
            leaving.cancel()


async def _until_left(websocket: WebSocket) -> None:
    while (await websocket.receive())["type"] != "websocket.disconnect":
        continue


async def _exists(websocket: WebSocket, live: LiveHub, session_id: str) -> bool:
    try:
        live.session(session_id)
    except Problem as error:
        code = ENDED if error.status_code == HTTPStatus.CONFLICT else NO_SUCH_SESSION
        await websocket.close(code, str(error.detail)[:120])
        return False
    return True


async def _answer(live: LiveHub, session_id: str, content: str | bytes) -> dict[str, Any]:
    """The acknowledgement of a message, or what is wrong with it."""
    try:
        return Ack.of(await live.take(session_id, _parsed(content))).model_dump()
    except InputError as error:
        return {"error": str(error)} | _standing(live, session_id)
    except Problem as error:
        return {"error": str(error.detail)} | _standing(live, session_id)
    except OSError as error:
        return {"error": f"not stored: {error.strerror}"} | _standing(live, session_id)


def _parsed(content: str | bytes) -> Any:
    try:
        return json.loads(content)
    except RecursionError:
        reason = "nested too deep"
    except ValueError as error:
        reason = str(error)[:100]
    raise InputError(f"not a line of JSON ({reason})")


def _standing(live: LiveHub, session_id: str) -> dict[str, Any]:
    record = live.record(session_id)
    return {"ack": record.last_t, "stored": record.stored}
