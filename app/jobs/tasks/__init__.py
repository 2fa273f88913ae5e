"""What a worker process can be asked to do, one task a file.

A task module has `run(arguments, progress) -> dict`: arguments and result are plain JSON values.
It runs in the worker only, so it may import what is heavy.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

from core.progress import Progress

Arguments = dict[str, Any]
Result = dict[str, Any]
Task = Callable[[Arguments, Progress], Result]

TASKS = {
    "read_log": "app.jobs.tasks.read_log",
    "model_log": "app.jobs.tasks.model_log",
    "check_map": "app.jobs.tasks.check_map",
    "model_map": "app.jobs.tasks.model_map",
    "localize": "app.jobs.tasks.localize",
}


def load_task(name: str) -> Task:
    """The function of a task."""
    task: Task = importlib.import_module(TASKS[name]).run
    return task
