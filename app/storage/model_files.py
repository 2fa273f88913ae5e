"""The files of models: `models/ID/NNNNNN/` is a model folder as CONTRACT has it, one per revision.

The highest revision is the model. A new one appears by a rename, so that a reader sees the model
before an edit or after it, never in between. `models/ID/source/` holds an imported map.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from app.storage.data_folder import DataFolder, size_on_disk
from app.storage.model_facts import TOPOLOGY_FILE
from core.errors import InputError

if TYPE_CHECKING:
    from core.topology import Model

Edit = Callable[[Path], None]
"""Changes the files of `EDITED_FILES` in a model folder."""
EDITED_FILES = frozenset({TOPOLOGY_FILE, "rooms.png", "history.jsonl"})
"""What an edit may write; all other files of a revision are shared with the one before."""
SOURCE_FOLDER = "source"


class ModelFiles:
    """Revisions on disk. Whoever writes must hold the store's lock; reading needs none."""

    def __init__(self, folder: DataFolder) -> None:
        self._folder = folder

    def revisions(self, model_id: str) -> list[Path]:
        """The model folders, oldest first; more than one only for a moment."""
        place = self._place(model_id)
        return sorted(place.glob("[0-9]*")) if place.is_dir() else []

    def size(self, model_id: str) -> int:
        """Bytes on disk."""
        return size_on_disk(self._place(model_id))

    def known(self) -> set[str]:
        """The ids of all models that have files."""
        return {place.name for place in self._folder.models.iterdir()}

    def load(self, model_id: str) -> Model | None:
        """The model itself, read again when an edit comes in between; None if it is not made."""
        from core.topology.model_folder import read_model

        while revisions := self.revisions(model_id):
            try:
                return read_model(revisions[-1])
            except (InputError, OSError):
                if self.revisions(model_id)[-1:] == revisions[-1:]:
                    raise
        return None

    def add_source(self, model_id: str, prepared: Path) -> Path:
        """Keeps the files that an imported model is made from; returns their folder."""
        source = self._place(model_id) / SOURCE_FOLDER
        self._folder.publish(prepared, source)
        return source

    def switch(self, model_id: str, prepared: Path) -> None:
        """Makes a finished folder the newest revision and removes the older ones."""
        revisions = self.revisions(model_id)
        number = int(revisions[-1].name) + 1 if revisions else 1
        self._folder.publish(prepared, self._place(model_id) / f"{number:06d}")
        for old in revisions:
            self._folder.discard(old)

    def edit(self, model_id: str, edit: Edit) -> None:
        """Makes a revision that differs from the newest by an edit; all or nothing."""
        with self._folder.temporary() as temp:
            prepared = temp / "model"
            _share(self.revisions(model_id)[-1], prepared)
            edit(prepared)
            self.switch(model_id, prepared)

    def remove(self, model_id: str) -> None:
        """Removes all files of a model."""
        self._folder.discard(self._place(model_id))

    def remove_old_revisions(self, model_id: str) -> None:
        """Removes what a crash between two steps of `switch` has left."""
        for old in self.revisions(model_id)[:-1]:
            self._folder.discard(old)

    def _place(self, model_id: str) -> Path:
        return self._folder.models / model_id


def _share(present: Path, prepared: Path) -> None:
    """A copy of a revision in which the files that an edit leaves alone take no space."""
    prepared.mkdir()
    for source in present.iterdir():
        copy = shutil.copyfile if source.name in EDITED_FILES else _link
        copy(source, prepared / source.name)


def _link(source: Path, target: Path) -> None:
    try:
        os.link(source, target)
    except OSError:
        shutil.copyfile(source, target)
