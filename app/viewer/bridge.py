"""Carries a browser's WebSocket to viser's own server and back, so that one port serves everything."""

from __future__ import annotations

import asyncio
import logging

from fastapi import WebSocket
from starlette.websockets import WebSocketDisconnect, WebSocketState
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.typing import Subprotocol

from app.viewer.viser_server import SUBPROTOCOL

logger = logging.getLogger(__name__)

LARGEST_FROM_BROWSER = 1 << 20
"""Bytes; a browser only sends cameras and clicks."""
GOING_AWAY, TOO_BIG, TRY_LATER = 1001, 1009, 1013
_NOT_FOR_THE_WIRE = frozenset({1005, 1006, 1015})
"""Close codes that say how a connection ended and must not be sent."""


async def bridge(browser: WebSocket, url: str) -> None:
    """Pumps messages between `browser` (not yet accepted) and the viser server at `url` until one ends.

    The subprotocol `viser-v<version>` is passed on, since viser closes with 1002 without it.
    """
    offered = browser.scope.get("subprotocols", [])
    wanted = [Subprotocol(name) for name in offered if name.startswith("viser-v")]
    try:
        upstream = await connect(
            url,
            subprotocols=wanted or None,
            compression=None,
            max_size=None,
            ping_interval=None,
            proxy=None,
            close_timeout=1,
        )
    except (OSError, WebSocketException) as error:
        logger.warning("the 3D view cannot be reached: %s", error)
        await browser.close(TRY_LATER)
        return
    async with upstream:
        await browser.accept(subprotocol=upstream.subprotocol)
        code, reason = await _pump_both(browser, upstream)
    if browser.application_state is not WebSocketState.DISCONNECTED:
        await _close_quietly(browser, code, reason)


async def _pump_both(browser: WebSocket, upstream: ClientConnection) -> tuple[int, str]:
    """Runs both directions; returns how the first that ended wants the other side to be closed."""
    tasks = {
        asyncio.create_task(_from_browser(browser, upstream)),
        asyncio.create_task(_to_browser(browser, upstream)),
    }
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    for task in done:
        if not task.cancelled() and task.exception() is None:
            return task.result()
    return GOING_AWAY, ""


async def _from_browser(browser: WebSocket, upstream: ClientConnection) -> tuple[int, str]:
    while True:
        message = await browser.receive()
        if message["type"] == "websocket.disconnect":
            return GOING_AWAY, ""
        data = message.get("bytes") if message.get("bytes") is not None else message.get("text")
        if data is None:
            continue
        if len(data) > LARGEST_FROM_BROWSER:
            return TOO_BIG, "message too big"
        try:
            await upstream.send(data)
        except ConnectionClosed as closed:
            return _code_of(closed)


async def _to_browser(browser: WebSocket, upstream: ClientConnection) -> tuple[int, str]:
    try:
        async for message in upstream:
            if isinstance(message, bytes):
                await browser.send_bytes(message)
            else:
                await browser.send_text(message)
    except ConnectionClosed as closed:
        return _code_of(closed)
    return upstream.close_code or GOING_AWAY, upstream.close_reason or ""


def _code_of(closed: ConnectionClosed) -> tuple[int, str]:
    received = closed.rcvd
    if received is None or received.code in _NOT_FOR_THE_WIRE:
        return GOING_AWAY, ""
    return received.code, received.reason


async def _close_quietly(browser: WebSocket, code: int, reason: str) -> None:
    try:
        await browser.close(GOING_AWAY if code in _NOT_FOR_THE_WIRE else code, reason)
    except (RuntimeError, WebSocketDisconnect):
        logger.debug("the browser had already gone")


__all__ = ["SUBPROTOCOL", "bridge"]
