"""A robot's end of a live session: sends scans, remembers what is confirmed, reconnects."""

from __future__ import annotations

import json
import time
import urllib.error
import urllib.request
from collections.abc import Iterable
from typing import Any
from urllib.parse import urlsplit

from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.sync.client import ClientConnection, connect

from core.errors import EchoRoomsError, InputError

PATIENCE_S = 30.0
"""Seconds for which a server that does not answer is tried again."""
RETRY_S = 0.25
ANSWER_S = 10.0
TOGETHER = 200
"""Scans in one message when they are late."""
REFUSED = (4404, 4409)
"""Close codes of sessions that are not there or have ended."""


class StreamError(EchoRoomsError):
    """The server could not be reached any more, or does not take the scans."""


class RobotClient:
    """One live session on a server."""

    def __init__(self, url: str, header: dict[str, Any], mode: str, model_id: str | None) -> None:
        """Begins a session; a token stands in the URL: `http://:TOKEN@robots.example:8000`.

        Raises:
            InputError: the URL is none, or the server refuses the session.
            StreamError: the server cannot be reached.
        """
        parts = urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise InputError(f"{url!r} is no URL of a server, such as http://127.0.0.1:8000")
        token = parts.password or parts.username
        self._headers = {"Authorization": f"Bearer {token}"} if token else {}
        place = parts.netloc.rpartition("@")[2]
        self._url = f"{parts.scheme}://{place}{parts.path}".rstrip("/")
        body = {"mode": mode, "header": header, "model_id": model_id}
        self.session = self._request("POST", "/api/live", body)
        self.ack: float | None = None
        self.stored = 0
        self._socket: ClientConnection | None = None

    def send(self, records: Iterable[dict[str, Any]]) -> None:
        """Sends scans and waits until they are safe; goes on after the last confirmed one.

        Raises:
            StreamError: the server is gone for too long, or refuses a scan.
        """
        waiting = list(records)
        deadline = time.monotonic() + PATIENCE_S
        while waiting:
            try:
                answer = self._exchange(waiting[:TOGETHER])
            except (OSError, WebSocketException, TimeoutError) as error:
                self._give_up_after(deadline, error)
                continue
            if "error" in answer:
                raise StreamError(f"the server refuses a scan: {answer['error']}")
            self.ack, self.stored = answer["ack"], answer["stored"]
            waiting = waiting[TOGETHER:]
            deadline = time.monotonic() + PATIENCE_S

    def finish(self) -> dict[str, Any]:
        """Ends the session: it becomes a log."""
        self._drop()
        return self._request("DELETE", f"/api/live/{self.session['id']}")

    def standing(self) -> dict[str, Any]:
        """The session as the server has it now."""
        return self._request("GET", f"/api/live/{self.session['id']}")

    def model_status(self) -> str:
        """How far the server is with the session's model."""
        model = self._request("GET", f"/api/models/{self.session['model_id']}")
        return str(model["status"])

    def _exchange(self, records: list[dict[str, Any]]) -> dict[str, Any]:
        if self._socket is None:
            path = f"{self._url}/api/live/{self.session['id']}/scans"
            address = "ws" + path.removeprefix("http")
            self._socket = connect(address, proxy=None, additional_headers=self._headers)
        self._socket.send(json.dumps(records))
        answer: dict[str, Any] = json.loads(self._socket.recv(timeout=ANSWER_S))
        return answer

    def _give_up_after(self, deadline: float, error: Exception) -> None:
        self._drop()
        if isinstance(error, ConnectionClosed) and error.rcvd and error.rcvd.code in REFUSED:
            raise StreamError(f"the server refuses the scans: {error.rcvd.reason}") from error
        if time.monotonic() > deadline:
            raise StreamError(f"the server at {self._url} does not answer ({error})") from error
        time.sleep(RETRY_S)

    def _drop(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    def _request(self, method: str, path: str, body: Any = None) -> dict[str, Any]:
        data = None if body is None else json.dumps(body).encode()
        headers = {"Content-Type": "application/json"} | self._headers
        request = urllib.request.Request(self._url + path, data, headers, method=method)
        try:
            with urllib.request.urlopen(request, timeout=ANSWER_S) as response:
                answer: dict[str, Any] = json.load(response)
        except urllib.error.HTTPError as error:
            raise InputError(f"the server refuses: {_detail(error)}") from error
        except (OSError, ValueError) as error:
            reason = getattr(error, "reason", error)
            raise StreamError(f"the server at {self._url} does not answer ({reason})") from error
        return answer


def _detail(error: urllib.error.HTTPError) -> str:
    try:
        return str(json.load(error)["detail"])
    except (ValueError, KeyError, TypeError):
        return f"{error.code} {error.reason}"
