"""The process that maps, models and localizes live sessions: `python -m app.live.worker`.

It speaks the lines of `app.jobs.worker` and keeps, between two requests, the state of every session
that is its. What it has not seen yet it reads from the session's recording, so that a new process
takes over from a lost one by reading the recording from its start.
"""

from __future__ import annotations

from app.jobs.tasks import Arguments, Result, Task
from app.jobs.worker import serve
from app.live.session_work import SessionWork, begin
from core.errors import InputError
from core.progress import Progress


class LiveWork:
    """The sessions of one process."""

    def __init__(self) -> None:
        self._sessions: dict[str, SessionWork] = {}

    def task(self, name: str) -> Task:
        """The function of a task: `advance`, `model` or `forget`."""
        return {"advance": self.advance, "model": self.model, "forget": self.forget}[name]

    def advance(self, arguments: Arguments, _: Progress) -> Result:
        """Takes in what is recorded: see `SessionWork.advance`."""
        key = arguments["session"]
        if key not in self._sessions:
            self._sessions[key] = begin(arguments)
        return self._sessions[key].advance(arguments["size"])

    def model(self, arguments: Arguments, _: Progress) -> Result:
        """Writes a model: see `SessionWork.model`.

        Raises:
            InputError: this process does not know the session (yet).
        """
        if arguments["session"] not in self._sessions:
            raise InputError("nothing of the session is taken in yet")
        return self._sessions[arguments["session"]].model(arguments["out"])

    def forget(self, arguments: Arguments, _: Progress) -> Result:
        """The session has ended."""
        self._sessions.pop(arguments["session"], None)
        return {}


if __name__ == "__main__":
    serve(LiveWork().task, [])
