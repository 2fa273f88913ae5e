"""A home of two rooms, a server that shows it, and a client that speaks viser's protocol."""

from __future__ import annotations

import asyncio
import contextlib
import json
import socket
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import httpx2
import msgspec
import numpy as np
import pytest
import uvicorn
import viser
import zstandard
from fastapi import FastAPI
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from app.errors import install_error_handlers
from app.events import ModelEvents
from app.security import BrowserGuard
from app.settings import Settings
from app.viewer import attach
from app.viewer.hub import Hub, HubConfig
from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import GridGeometry
from core.sensing import Trajectory
from core.topology import Edge, Model, Node, Room, TopologicalMap

PATIENCE = 10.0


@pytest.fixture(scope="session")
def two_rooms() -> Model:
    """Rooms of 2 m x 2 m, west and east of a wall with a door of 0.6 m; 5 cm; corner at (-1, 2)."""
    geometry = GridGeometry(0.05, (-1.0, 2.0, 0.0), (44, 84))
    free = np.zeros(geometry.shape, bool)
    free[2:42, 2:42] = free[2:42, 42:82] = True
    free[:, 41:43] = False
    free[16:28, 41:43] = True
    occupied = ~free
    occupied[4:6, 4:6] = True
    free &= ~occupied
    regions = np.zeros(geometry.shape, np.int64)
    regions[:, :42][free[:, :42]] = 1
    regions[:, 42:][free[:, 42:]] = 2
    nodes = (
        Node("west", 1, None, 4.0, (0.1, 3.1), 0.0),
        Node("east", 2, "study", 4.0, (2.1, 3.1), 0.0),
    )
    rooms = (Room("r1", 1, None, ("west",)), Room("r2", 2, "study", ("east",)))
    topology = TopologicalMap(nodes, (Edge("e1", "west", "east", (1.1, 3.1), 0.6),), rooms)
    poses = np.column_stack((np.linspace(0, 2, 41), np.full(41, 3.1), np.zeros(41)))
    return Model(
        OccupancyGrid.of(geometry, free, occupied),
        regions,
        regions.copy(),
        topology,
        Trajectory.at(np.arange(41.0), poses),
        {},
    )


def labelled(model: Model, node_id: str, label: str | None) -> Model:
    """The model with another label."""
    topology = model.topology
    nodes = tuple(
        replace(node, label=label) if node.id == node_id else node for node in topology.nodes
    )
    return replace(model, topology=replace(topology, nodes=nodes))


@dataclass
class ViewServer:
    """A running server with the 3D view and nothing else; `models` is its store."""

    port: int
    app: FastAPI
    loop: asyncio.AbstractEventLoop
    models: dict[str, Model] = field(default_factory=dict)

    @property
    def hub(self) -> Hub:
        """The hub of open views."""
        hub: Hub = self.app.state.viewer
        return hub

    @property
    def events(self) -> ModelEvents:
        """Where changes are told."""
        events: ModelEvents = self.app.state.events
        return events

    def rename(self, model_id: str, node_id: str, label: str | None) -> None:
        """What the API does when somebody names a node."""
        self.models[model_id] = labelled(self.models[model_id], node_id, label)
        self.events.model_changed(model_id)

    def call(self, function: Callable[..., Any], *args: Any) -> Any:
        """Runs a function on the server's event loop."""

        async def run() -> Any:
            return function(*args)

        return asyncio.run_coroutine_threadsafe(run(), self.loop).result(PATIENCE)

    @property
    def http(self) -> httpx2.Client:
        """A client of its pages and its API."""
        return httpx2.Client(base_url=f"http://127.0.0.1:{self.port}", timeout=PATIENCE)

    def url(self, path: str) -> str:
        """The WebSocket URL of a path."""
        return f"ws://127.0.0.1:{self.port}{path}"

    @contextlib.contextmanager
    def view(self, model_id: str, token: str | None = None) -> Iterator[ViserClient]:
        """A browser's 3D view, connected and with its camera sent."""
        path = f"/view/{model_id}/tab/{token}" if token else f"/view/{model_id}"
        protocol = Subprotocol(f"viser-v{viser.__version__}")
        with connect(
            self.url(path), subprotocols=[protocol], max_size=None, compression=None
        ) as socket_:
            client = ViserClient(socket_)
            client.send_camera()
            yield client

    @contextlib.contextmanager
    def page(self, model_id: str, token: str) -> Iterator[PageChannel]:
        """A page's event channel."""
        with connect(self.url(f"/view/{model_id}/events?tab={token}")) as socket_:
            yield PageChannel(socket_)


class PageChannel:
    """The page's end of the event channel."""

    def __init__(self, connection: ClientConnection) -> None:
        self.connection = connection

    def send(self, **message: Any) -> None:
        """Sends a message."""
        self.connection.send(json.dumps(message))

    def wait_for(self, kind: str) -> dict[str, Any]:
        """The next message of a type; others are skipped."""
        end = time.monotonic() + PATIENCE
        while True:
            message = json.loads(self.connection.recv(max(end - time.monotonic(), 0.01)))
            if message["type"] == kind:
                return dict(message)


class ViserClient:
    """The browser's end of viser's protocol: collects messages, sends cameras and clicks."""

    def __init__(self, connection: ClientConnection) -> None:
        self.connection = connection
        self.seen: list[dict[str, Any]] = []
        self._unpack = zstandard.ZstdDecompressor()

    def wait_for(self, wanted: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """The first message, seen or to come, that is wanted."""
        checked = 0
        end = time.monotonic() + PATIENCE
        while True:
            for message in self.seen[checked:]:
                if wanted(message):
                    return message
            checked = len(self.seen)
            self._receive(max(end - time.monotonic(), 0.01))

    def drain(self, seconds: float = 0.3) -> list[dict[str, Any]]:
        """Everything that arrives until nothing has for a while; only what is new."""
        start = len(self.seen)
        with contextlib.suppress(TimeoutError):
            while True:
                self._receive(seconds)
        return self.seen[start:]

    def send_camera(
        self,
        position: tuple[float, float, float] = (0.0, 0.0, 10.0),
        look_at: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        """Where the camera stands; the first makes viser count a connection as a client."""
        self._send(
            type="ViewerCameraMessage",
            wxyz=(1.0, 0.0, 0.0, 0.0),
            position=position,
            image_height=600,
            image_width=800,
            fov=1.0,
            near=0.01,
            far=1000.0,
            look_at=look_at,
            up_direction=(0.0, 0.0, 1.0),
        )

    def click(self, x: float, y: float) -> None:
        """A click on the floor at a world point, seen from straight above."""
        self._send(
            type="ScenePointerMessage",
            event_type="click",
            ray_origin=(x, y, 20.0),
            ray_direction=(0.0, 0.0, -1.0),
            screen_pos=((0.5, 0.5),),
            modifier=None,
        )

    def _send(self, **message: Any) -> None:
        self.connection.send(msgspec.msgpack.encode(message))

    def _receive(self, timeout: float) -> None:
        frame = self.connection.recv(timeout)
        assert isinstance(frame, bytes)
        unpacked, packed = (int.from_bytes(frame[i : i + 8], "little") for i in (0, 8))
        raw = self._unpack.decompress(frame[16 : 16 + packed], max_output_size=unpacked)
        self.seen += msgspec.msgpack.decode(raw)["messages"]


def label(text: str) -> Callable[[dict[str, Any]], bool]:
    """Wants the message that puts a label with this text into the scene or changes one to it."""

    def wanted(message: dict[str, Any]) -> bool:
        props = message.get("props") or message.get("updates") or {}
        return isinstance(props, dict) and props.get("text") == text

    return wanted


@pytest.fixture
def serve_views(
    two_rooms: Model, serve_app: Callable[[FastAPI], ViewServer]
) -> Callable[..., ViewServer]:
    """Starts servers that show the two rooms as model "m1"; they end with the test."""

    def start(config: HubConfig | None = None) -> ViewServer:
        models = {"m1": two_rooms}
        settings = Settings()
        app = FastAPI()
        app.state.events = ModelEvents()
        install_error_handlers(app)
        attach(app, models.get, app.state.events, settings, config)
        app.add_middleware(BrowserGuard, settings=settings)
        return replace(serve_app(app), models=models)

    return start


@pytest.fixture
def serve_app() -> Iterator[Callable[[FastAPI], ViewServer]]:
    """Serves apps on ports of their own until the test ends."""
    running: list[tuple[uvicorn.Server, threading.Thread]] = []

    def start(app: FastAPI) -> ViewServer:
        listener = socket.create_server(("127.0.0.1", 0))
        server = uvicorn.Server(
            uvicorn.Config(
                app, log_level="warning", ws_per_message_deflate=False, ws_max_size=64 << 20
            )
        )
        loops: list[asyncio.AbstractEventLoop] = []

        async def serve() -> None:
            loops.append(asyncio.get_running_loop())
            await server.serve([listener])

        thread = threading.Thread(target=lambda: asyncio.run(serve()), daemon=True)
        thread.start()
        running.append((server, thread))
        while not server.started:
            time.sleep(0.01)
        return ViewServer(listener.getsockname()[1], app, loops[0])

    yield start
    for server, thread in running:
        server.should_exit = True
        thread.join(PATIENCE)
        assert not thread.is_alive()


@pytest.fixture
def server(serve_views: Callable[..., ViewServer]) -> ViewServer:
    """A server that shows the two rooms as model "m1"."""
    return serve_views()


@pytest.fixture
def shows_label() -> Callable[[str], Callable[[dict[str, Any]], bool]]:
    """`label`, for test modules, which cannot import this file."""
    return label
