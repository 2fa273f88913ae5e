"""What happened to the models, told to whoever shows them."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from enum import Enum

logger = logging.getLogger(__name__)


class ModelEvent(Enum):
    """The kinds of events."""

    CHANGED = "changed"
    DELETED = "deleted"


Subscriber = Callable[[ModelEvent, str], None]
"""Called with the event and the model's id, in the thread that caused it; must return quickly."""


class ModelEvents:
    """Tells subscribers in this process that a model was changed or deleted. Thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._subscribers: list[Subscriber] = []

    def subscribe(self, subscriber: Subscriber) -> Callable[[], None]:
        """Adds a subscriber; the returned function removes it."""
        with self._lock:
            self._subscribers.append(subscriber)

        def unsubscribe() -> None:
            with self._lock:
                if subscriber in self._subscribers:
                    self._subscribers.remove(subscriber)

        return unsubscribe

    def model_changed(self, model_id: str) -> None:
        """Says that a model is new, finished, or has other labels."""
        self._publish(ModelEvent.CHANGED, model_id)

    def model_deleted(self, model_id: str) -> None:
        """Says that a model is gone."""
        self._publish(ModelEvent.DELETED, model_id)

    def _publish(self, event: ModelEvent, model_id: str) -> None:
        with self._lock:
            subscribers = tuple(self._subscribers)
        for subscriber in subscribers:
            try:
                subscriber(event, model_id)
            except Exception:
                # One viewer that fails must not undo the edit that somebody just made.
                logger.exception("a subscriber failed on %s of model %s", event.value, model_id)
