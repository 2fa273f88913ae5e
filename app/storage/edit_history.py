"""Which revision of a model is the present one, and which ones undo and redo lead to.

`models/ID/revisions.json` is the truth: it is replaced in one step, so that an edit, an undo and a
redo each happen whole or not at all. The history is a line: an edit after an undo drops what was
undone, and beyond the limit the oldest edits cannot be undone any more.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from pydantic import TypeAdapter

HISTORY_FILE = "revisions.json"
MOST_STEPS = 50
"""Edits that can be undone."""


@dataclass(frozen=True)
class Step:
    """An edit: the folder of the model on its other side, and what was done, in words."""

    folder: int
    what: str


@dataclass(frozen=True)
class EditHistory:
    """The line of revisions.

    Attributes:
        revision: grows with every change, undo and redo too.
        folder: number of the folder that is the model.
        past: the edits that lead here, the latest last.
        future: the edits that were undone, the next to be redone last.
    """

    revision: int
    folder: int
    past: tuple[Step, ...] = ()
    future: tuple[Step, ...] = ()

    @classmethod
    def begin(cls, before: EditHistory | None) -> EditHistory:
        """The history of a model that was just made; nothing leads back from it."""
        revision = 1 if before is None else before.revision + 1
        return cls(revision, revision)

    @property
    def folders(self) -> set[int]:
        """The numbers of all folders that are needed."""
        return {self.folder, *(step.folder for step in (*self.past, *self.future))}

    def edited(self, what: str) -> EditHistory:
        """After an edit, whose folder has the number of the new revision."""
        past = (*self.past, Step(self.folder, what))[-MOST_STEPS:]
        return EditHistory(self.revision + 1, self.revision + 1, past)

    def undone(self) -> EditHistory:
        """After taking back the last edit, of which there must be one."""
        *past, last = self.past
        future = (*self.future, Step(self.folder, last.what))
        return replace(
            self, revision=self.revision + 1, folder=last.folder, past=tuple(past), future=future
        )

    def redone(self) -> EditHistory:
        """After doing again the edit that was undone last, of which there must be one."""
        *future, last = self.future
        past = (*self.past, Step(self.folder, last.what))
        return replace(
            self, revision=self.revision + 1, folder=last.folder, past=past, future=tuple(future)
        )


HISTORY_JSON: TypeAdapter[EditHistory] = TypeAdapter(EditHistory)
