"""The worker process: takes one task after another as JSON lines, answers with progress and a result.

Started by the server as `python -m app.jobs.worker`. A request is
`{"task", "arguments", "memory_bytes"}`; the answers are `{"progress", "what"}` lines and at the end
one `{"result"}` or `{"error", "kind", "line"}` line. When its input ends, the server is gone and the
process leaves at once, whatever it is doing.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import logging
import os
import queue
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, TextIO

from app.jobs.tasks import Task, load_task
from core.errors import EchoRoomsError, LogError, TooLargeError, UsageError

PROGRESS_INTERVAL_S = 0.1
IDLE_BEFORE_IMPORTS_S = 1.0
"""A worker that is kept warm leaves the processor to the server while that starts."""
NICENESS = 5
"""Below the server, so that pages stay quick while every core models."""
HEAVY_MODULES = (
    "app.jobs.tasks.read_log",
    "scipy.ndimage",
    "scipy.sparse.linalg",
    "skimage.measure",
    "numba",
    "app.jobs.tasks.model_log",
    "app.jobs.tasks.model_map",
)
"""Imported by a worker that is kept warm, one after another while it has nothing else to do."""
logger = logging.getLogger(__name__)


def main() -> None:
    """Serves jobs' tasks."""
    serve(load_task, list(HEAVY_MODULES) if "--warm" in sys.argv else [])


def serve(load: Callable[[str], Task], ahead: list[str]) -> None:
    """Serves tasks until the input ends.

    Args:
        load: the function of a task's name.
        ahead: modules to import while there is nothing else to do.
    """
    logging.basicConfig(format="%(levelname)s worker: %(message)s")
    with contextlib.suppress(AttributeError, OSError):
        os.nice(NICENESS)
    answers = _claim_stdout()
    requests: queue.Queue[dict[str, Any]] = queue.Queue()
    threading.Thread(target=_read_requests, args=(requests,), daemon=True).start()
    patience = IDLE_BEFORE_IMPORTS_S
    while True:
        try:
            request = requests.get(timeout=patience if ahead else None)
        except queue.Empty:
            patience = 0.0
            _import_ahead(ahead.pop(0))
        else:
            _serve(request, load, answers)


def _claim_stdout() -> TextIO:
    """The pipe to the server; whatever a library prints goes to standard error from now on."""
    pipe = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8", newline="\n")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    return pipe


def _read_requests(requests: queue.Queue[dict[str, Any]]) -> None:
    for line in sys.stdin:
        requests.put(json.loads(line))
    os._exit(0)


def _import_ahead(name: str) -> None:
    try:
        importlib.import_module(name)
    except ImportError:
        logger.exception("cannot import %s", name)


def _serve(request: dict[str, Any], load: Callable[[str], Task], answers: TextIO) -> None:
    def send(answer: dict[str, Any]) -> None:
        answers.write(json.dumps(answer) + "\n")
        answers.flush()

    try:
        task = load(request["task"])
        _limit_memory(request["memory_bytes"])
        send({"result": task(request["arguments"], _Reporter(send))})
    except EchoRoomsError as error:
        send({"error": str(error), "kind": _kind(error), "line": getattr(error, "line", None)})
    except MemoryError:
        megabytes = request["memory_bytes"] >> 20
        send({"error": f"needs more than the {megabytes} MB of memory allowed", "kind": "memory"})
    except Exception:
        logger.exception("task %s failed", request["task"])
        send({"error": "failed for a reason that only the server's log tells", "kind": "bug"})


class _Reporter:
    """A progress that sends at most one line every `PROGRESS_INTERVAL_S`."""

    def __init__(self, send: Any) -> None:
        self._send = send
        self._next = 0.0

    def __call__(self, share: float, what: str) -> None:
        now = time.monotonic()
        if now >= self._next:
            self._next = now + PROGRESS_INTERVAL_S
            self._send({"progress": round(min(max(share, 0.0), 1.0), 4), "what": what})


def _kind(error: EchoRoomsError) -> str:
    kinds = ((TooLargeError, "too_large"), (LogError, "log"), (UsageError, "usage"))
    return next((kind for type_, kind in kinds if isinstance(error, type_)), "input")


def _limit_memory(budget_bytes: int) -> None:
    """Lets the process take `budget_bytes` more address space than now (where the system can)."""
    statm = Path("/proc/self/statm")
    if not statm.exists():
        return
    import resource

    mapped = int(statm.read_text().split()[0]) * resource.getpagesize()
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    wanted = mapped + budget_bytes
    resource.setrlimit(
        resource.RLIMIT_AS,
        (wanted if hard == resource.RLIM_INFINITY else min(wanted, hard), hard),
    )


if __name__ == "__main__":
    main()
