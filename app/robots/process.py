"""The process of one simulated robot: `python -m app.robots.process`.

The first line of standard input says `{"url", "order"}`, every further one is `{"number", "command"}`;
standard output carries `{"status": …}`, `{"answer": number, "error": null or text}` and, at the end,
`{"ended": why}`. The end of standard input ends the process.
"""

from __future__ import annotations

import json
import queue
import sys
import threading
import time
from typing import Any, TextIO

from app.live.robot_client import RobotClient
from app.robots.order import COMMAND, Hurry, Localize, RobotOrder
from app.robots.pilot import Pilot
from app.robots.uplink import Uplink
from app.robots.world import described
from core.errors import EchoRoomsError, InputError
from core.log_readers.native_line import FORMAT_NAME, VERSION
from core.log_readers.ring_file import table_of
from core.sensing.ring import RING_PRESETS

TELL_S = 0.25
"""Seconds between two reports."""
RESTS_AFTER_S = 10.0
"""A robot that has stood for so many simulated seconds senses no more until it is told to move: the
map gains nothing from it."""
MOST_WAITING = 2400
"""With so many scans that the server has not confirmed, the robot stands and waits (10 min at 4 Hz)."""
POLL_S = 0.5
MODEL_PATIENCE_S = 900.0
Message = dict[str, Any]


class Station:
    """Runs a pilot in time, sends its scans, and does what comes in."""

    def __init__(self, url: str, order: RobotOrder, say: TextIO) -> None:
        """Begins the robot's session.

        Raises:
            InputError: the robot does not fit, or the server refuses the session.
            StreamError: the server cannot be reached.
        """
        self._url = url
        self._order = order
        self._say_to = say
        self._saying = threading.Lock()
        self._pilot = Pilot(order)
        self._header = _header(order)
        mode = "mapping" if order.model_id is None else "localization"
        self._uplink = Uplink(RobotClient(url, self._header, mode, order.model_id))
        self._mode = mode
        self._speed = order.speed
        self._changing: threading.Thread | None = None
        self._trouble: str | None = None
        self._told = 0.0
        self._told_world: dict[str, Any] | None = None

    def run(self, told: queue.Queue[Message | None]) -> None:
        """Drives until standard input or the session ends."""
        period = self._pilot.period_s
        due = time.monotonic()
        while (self._uplink.trouble or self._trouble) is None:
            if not self._listen(told, due):
                return
            if self._sensing:
                self._uplink.put(self._pilot.step())
            self._report()
            due = max(due + period / self._speed, time.monotonic() - period)
        self._say({"ended": self._trouble or self._uplink.trouble})

    @property
    def _sensing(self) -> bool:
        return (
            self._changing is None
            and self._pilot.standing_s < RESTS_AFTER_S
            and self._uplink.waiting < MOST_WAITING
        )

    def _listen(self, told: queue.Queue[Message | None], until: float) -> bool:
        """Takes commands until a time; False when there will be no more."""
        while True:
            try:
                message = told.get(timeout=max(0.0, until - time.monotonic()))
            except queue.Empty:
                return True
            if message is None:
                return False
            self._answer(message)

    def _answer(self, message: Message) -> None:
        error = None
        try:
            self._obey(COMMAND.validate_python(message["command"]))
        except InputError as refused:
            error = str(refused)
        self._report(now=True)
        self._say({"answer": message["number"], "error": error})

    def _obey(self, command: Any) -> None:
        if isinstance(command, Hurry):
            self._speed = command.speed
        elif self._changing is not None:
            raise InputError("the robot waits for its model: try again in a moment")
        elif isinstance(command, Localize):
            if self._mode == "localization":
                raise InputError("the robot localizes already")
            self._changing = threading.Thread(target=self._change_over, daemon=True)
            self._changing.start()
        else:
            self._pilot.obey(command)

    def _change_over(self) -> None:
        """Finishes mapping and begins to localize in what came of it. In a thread of its own."""
        try:
            self._uplink.close()
            mapped = self._uplink.client
            mapped.finish()
            _wait_for_model(mapped)
            model_id = mapped.session["model_id"]
            client = RobotClient(self._url, self._header, "localization", model_id)
        except EchoRoomsError as error:
            self._trouble = str(error)
            return
        self._uplink = Uplink(client)
        self._mode = "localization"
        self._pilot.localizes()
        self._changing = None

    def _report(self, now: bool = False) -> None:
        if not now and time.monotonic() - self._told < TELL_S:
            return
        self._told = time.monotonic()
        pilot, client = self._pilot, self._uplink.client
        status: dict[str, Any] = {
            "session_id": client.session["id"],
            "model_id": client.session["model_id"],
            "mode": self._mode,
            "task": "waiting" if self._changing is not None else pilot.task.value,
            "speed": self._speed,
            "t": round(pilot.robot.t, 2),
            "distance_m": round(pilot.distance_m, 2),
            "toured": pilot.toured,
            "blocked": pilot.robot.blocked,
            "stored": client.stored,
            "waiting": self._uplink.waiting,
        }
        world = described(pilot.home)
        if world != self._told_world:
            self._told_world = world
            status |= world
        self._say({"status": status})

    def _say(self, message: Message) -> None:
        with self._saying:
            self._say_to.write(json.dumps(message) + "\n")
            self._say_to.flush()


def main() -> None:
    """Makes the robot and drives it."""
    first = json.loads(sys.stdin.readline())
    try:
        station = Station(first["url"], RobotOrder.model_validate(first["order"]), sys.stdout)
    except EchoRoomsError as error:
        sys.stdout.write(json.dumps({"ended": str(error)}) + "\n")
        return
    told: queue.Queue[Message | None] = queue.Queue()
    threading.Thread(target=_read, args=(told,), daemon=True).start()
    station.run(told)


def _read(told: queue.Queue[Message | None]) -> None:
    for line in sys.stdin:
        told.put(json.loads(line))
    told.put(None)


def _header(order: RobotOrder) -> dict[str, Any]:
    name = f"simulated {order.home} home, live {order.seed}"
    table = table_of(RING_PRESETS[order.ring])
    return {"format": FORMAT_NAME, "version": VERSION, "name": name, "simulated": True, **table}


def _wait_for_model(client: RobotClient) -> None:
    """Returns when the model of a finished mapping session is made.

    Raises:
        InputError: it could not be made.
    """
    deadline = time.monotonic() + MODEL_PATIENCE_S
    while client.standing()["status"] != "ended" or (
        (status := client.model_status()) in ("queued", "running")
    ):
        if time.monotonic() > deadline:
            raise InputError("the model of the mapping drive is not made in time")
        time.sleep(POLL_S)
    if status != "done":
        raise InputError("no model came of the mapping drive: drive further before localizing")


if __name__ == "__main__":
    main()
