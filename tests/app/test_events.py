"""News about models inside the process."""

from __future__ import annotations

from app.events import ModelEvent, ModelEvents


def test_every_subscriber_hears_every_event_until_it_leaves() -> None:
    events = ModelEvents()
    first: list[tuple[ModelEvent, str]] = []
    second: list[tuple[ModelEvent, str]] = []
    leave = events.subscribe(lambda event, model_id: first.append((event, model_id)))
    events.subscribe(lambda event, model_id: second.append((event, model_id)))
    events.model_changed("a")
    leave()
    leave()
    events.model_deleted("a")
    assert first == [(ModelEvent.CHANGED, "a")]
    assert second == [(ModelEvent.CHANGED, "a"), (ModelEvent.DELETED, "a")]


def test_a_subscriber_that_fails_does_not_stop_the_others() -> None:
    events = ModelEvents()
    heard: list[str] = []

    def fail(event: ModelEvent, model_id: str) -> None:
        raise RuntimeError("no screen")

    events.subscribe(fail)
    events.subscribe(lambda event, model_id: heard.append(model_id))
    events.model_changed("a")
    assert heard == ["a"]
