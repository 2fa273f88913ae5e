"""Runs the server on a port of this machine."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import signal
import socket
import threading
from collections.abc import Callable, Iterator

import uvicorn
from fastapi import FastAPI

from app.access import Access
from app.main import create_app
from app.settings import Settings
from core.errors import InputError

WEBSOCKET_MAX_BYTES = 64 << 20
SHUTDOWN_S = 3
BACKLOG = 128
STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM)
OnReady = Callable[[str], None]
"""Called with the URL once the server answers."""


def run(settings: Settings, on_ready: OnReady | None = None, access: Access | None = None) -> None:
    """Serves until it is told to stop (Ctrl-C or SIGTERM).

    Raises:
        InputError: the port is taken, the address cannot be listened on, or the data folder cannot
            be used.
    """
    with _listen(settings) as listener:
        app = create_app(settings, access)
        app.state.address = _url(listener)
        asyncio.run(_serve(app, listener, on_ready or (lambda url: None)))


async def _serve(app: FastAPI, listener: socket.socket, on_ready: OnReady) -> None:
    config = uvicorn.Config(
        app,
        lifespan="off",
        ws_per_message_deflate=False,
        ws_max_size=WEBSOCKET_MAX_BYTES,
        timeout_graceful_shutdown=SHUTDOWN_S,
        log_level="warning",
        server_header=False,
    )
    # Entered here and not by uvicorn, which would print a traceback where one line is due.
    async with app.router.lifespan_context(app):
        await _Server(config, app, lambda: on_ready(_url(listener))).serve([listener])


class _Server(uvicorn.Server):
    """A server that says when it is ready, and ends event streams before it waits for them."""

    def __init__(
        self, config: uvicorn.Config, app: FastAPI, on_ready: Callable[[], object]
    ) -> None:
        super().__init__(config)
        self._app = app
        self._on_ready = on_ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self._on_ready()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        await self._app.state.services.runner.close()
        await super().shutdown(sockets)

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Ctrl-C and SIGTERM end the server in order, and nothing more: leaving is not a failure."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        earlier = {number: signal.signal(number, self.handle_exit) for number in STOP_SIGNALS}
        try:
            yield
        finally:
            for number, handler in earlier.items():
                signal.signal(number, handler)


def _listen(settings: Settings) -> socket.socket:
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listener = socket.socket(family)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((settings.host, settings.port))
        listener.listen(BACKLOG)
    except OSError as error:
        listener.close()
        if error.errno == errno.EADDRINUSE:
            raise InputError(
                f"port {settings.port} is taken by another program; stop it or give another one "
                "with --port"
            ) from error
        raise InputError(
            f"cannot listen on {settings.host}:{settings.port} ({error.strerror})"
        ) from error
    listener.setblocking(False)
    return listener


def _url(listener: socket.socket) -> str:
    host, port = listener.getsockname()[:2]
    if host in ("0.0.0.0", "::"):
        host = "127.0.0.1"
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"
