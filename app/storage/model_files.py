"""The files of models: `models/ID/NNNNNN/` is a model folder as CONTRACT has it, one per revision.

`models/ID/revisions.json` says which of them is the model and which ones undo and redo lead to. It
is replaced in one step, so that a reader sees the model before a change or after it, never in
between. `models/ID/source/` holds an imported map.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from app.storage.data_folder import DataFolder, size_on_disk
from app.storage.edit_history import HISTORY_FILE, HISTORY_JSON, EditHistory
from app.storage.model_facts import TOPOLOGY_FILE, read_json
from core.errors import InputError

if TYPE_CHECKING:
    from core.topology import Model

Edit = Callable[[Path], str]
"""Changes the files of `EDITED_FILES` in a model folder and says in words what it did."""
EDITED_FILES = frozenset({TOPOLOGY_FILE, "regions.png", "rooms.png", "history.jsonl"})
"""What an edit may write; all other files of a revision are shared with the one before."""
SOURCE_FOLDER = "source"
NEXT_NUMBER = "next_number"


class ModelFiles:
    """Revisions on disk. Whoever writes must hold the store's lock; reading needs none."""

    def __init__(self, folder: DataFolder) -> None:
        self._folder = folder

    def history(self, model_id: str) -> EditHistory | None:
        """The revisions of a model; None when it is not made yet."""
        try:
            return HISTORY_JSON.validate_json((self._place(model_id) / HISTORY_FILE).read_bytes())
        except FileNotFoundError:
            return None

    def present(self, model_id: str) -> Path | None:
        """The model folder; None when the model is not made yet."""
        history = self.history(model_id)
        return None if history is None else self._revision(model_id, history.folder)

    def size(self, model_id: str) -> int:
        """Bytes on disk."""
        return size_on_disk(self._place(model_id))

    def known(self) -> set[str]:
        """The ids of all models that have files."""
        return {place.name for place in self._folder.models.iterdir()}

    def load(self, model_id: str) -> Model | None:
        """The model itself, read again when an edit comes in between; None if it is not made."""
        from core.topology.model_folder import read_model

        while present := self.present(model_id):
            try:
                return read_model(present)
            except (InputError, OSError):
                if self.present(model_id) == present:
                    raise
        return None

    def add_source(self, model_id: str, prepared: Path) -> Path:
        """Keeps the files that an imported model is made from; returns their folder."""
        source = self._place(model_id) / SOURCE_FOLDER
        self._folder.publish(prepared, source)
        return source

    def renew(self, model_id: str, prepared: Path) -> None:
        """Makes a finished folder the model; what was before cannot be brought back by undo."""
        self._add(model_id, prepared, EditHistory.begin(self.history(model_id)))

    def remake(self, model_id: str, prepared: Path, what: str) -> None:
        """Makes a finished folder the next revision; undo leads back to the one before.

        Args:
            what: was done, in words.
        """
        history = self.history(model_id)
        if history is None:
            self.renew(model_id, prepared)
            return
        _skip_numbers(prepared, [self._revision(model_id, step.folder) for step in history.future])
        self._add(model_id, prepared, history.edited(what))

    def edit(self, model_id: str, history: EditHistory, edit: Edit) -> None:
        """Makes a revision that differs from the present one by an edit; all or nothing."""
        with self._folder.temporary() as temp:
            prepared = temp / "model"
            _share(self._revision(model_id, history.folder), prepared)
            undone = [self._revision(model_id, step.folder) for step in history.future]
            _skip_numbers(prepared, undone)
            what = edit(prepared)
            self._add(model_id, prepared, history.edited(what))

    def turn(self, model_id: str, history: EditHistory) -> None:
        """Makes another one of the kept revisions the model."""
        place = self._place(model_id) / HISTORY_FILE
        self._folder.replace_file(place, HISTORY_JSON.dump_json(history))

    def remove(self, model_id: str) -> None:
        """Removes all files of a model."""
        self._folder.discard(self._place(model_id))

    def recover(self, model_id: str) -> None:
        """Tidies up after a crash; a model without a history begins one with its newest revision."""
        numbers = [int(path.name) for path in self._place(model_id).glob("[0-9]*")]
        if numbers and self.history(model_id) is None:
            self.turn(model_id, EditHistory(max(numbers), max(numbers)))
        self.remove_unused(model_id)

    def remove_unused(self, model_id: str) -> None:
        """Removes revisions to which nothing leads (any more)."""
        history = self.history(model_id)
        used = set() if history is None else history.folders
        for path in self._place(model_id).glob("[0-9]*"):
            if int(path.name) not in used:
                self._folder.discard(path)

    def _add(self, model_id: str, prepared: Path, history: EditHistory) -> None:
        place = self._revision(model_id, history.folder)
        self._folder.discard(place)  # left by a crash or a full disk before the history was written
        self._folder.publish(prepared, place)
        self.turn(model_id, history)
        self.remove_unused(model_id)

    def _revision(self, model_id: str, number: int) -> Path:
        return self._place(model_id) / f"{number:06d}"

    def _place(self, model_id: str) -> Path:
        return self._folder.models / model_id


def _skip_numbers(prepared: Path, undone: list[Path]) -> None:
    """Ids of edits that were undone are not given again: somebody may have seen them."""
    if not undone:
        return
    topology = read_json(prepared / TOPOLOGY_FILE)
    used = [read_json(folder / TOPOLOGY_FILE).get(NEXT_NUMBER, 1) for folder in undone]
    topology[NEXT_NUMBER] = max(topology.get(NEXT_NUMBER, 1), *used)
    text = json.dumps(topology, ensure_ascii=False)
    (prepared / TOPOLOGY_FILE).write_text(text, encoding="utf-8")


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
