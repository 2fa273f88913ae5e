"""A small client of rosbridge: JSON messages over a WebSocket."""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Iterator, Mapping
from typing import Any

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from core.errors import InputError

logger = logging.getLogger(__name__)
LARGEST_MESSAGE = 4 << 20
RETRY_S = 2.0
QUIET_S = 60.0
"""A connection over which nothing comes for so long is made anew."""


def messages(url: str, types: Mapping[str, str]) -> Iterator[tuple[str, Any]]:
    """Topic and content of every message, for ever; a lost connection is made again.

    Args:
        url: of rosbridge, `ws://robot:9090`.
        types: message type by topic.

    Raises:
        InputError: there is no rosbridge when first looked for.
    """
    connected = False
    while True:
        try:
            with connect(url, max_size=LARGEST_MESSAGE, proxy=None) as socket:
                connected = True
                for topic, kind in types.items():
                    socket.send(json.dumps({"op": "subscribe", "topic": topic, "type": kind}))
                while True:
                    yield from _published(socket.recv(timeout=QUIET_S))
        except (OSError, WebSocketException, TimeoutError) as error:
            if not connected:
                raise InputError(f"no rosbridge at {url}: {error}") from error
            logger.warning("rosbridge at %s is lost (%s); trying again", url, error)
            time.sleep(RETRY_S)


def _published(text: str | bytes) -> Iterator[tuple[str, Any]]:
    """The message in a frame, if it is one."""
    try:
        frame = json.loads(text)
    except (ValueError, RecursionError) as error:
        logger.warning("rosbridge sent what is not JSON (%s)", str(error)[:100])
        return
    if isinstance(frame, dict) and frame.get("op") == "publish":
        yield str(frame.get("topic")), frame.get("msg")
    elif isinstance(frame, dict) and frame.get("level") == "error":
        logger.warning("rosbridge: %s", str(frame.get("msg"))[:200])
