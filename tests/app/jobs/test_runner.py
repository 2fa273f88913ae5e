"""The queue of jobs, with work that needs no processes."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

import pytest

from app.errors import NotFound
from app.jobs.runner import STOPPED, ActiveJob, JobRunner, JobView
from app.storage.database import Database
from app.storage.job_store import JobStore
from app.storage.records import JobRecord, Status
from core.errors import InputError


class Waiting:
    """Work that waits until it is let go, and notes how it ended."""

    def __init__(self, error: Exception | None = None, commits: bool = False) -> None:
        self.go = asyncio.Event()
        self.started = asyncio.Event()
        self.noted: list[tuple[Status, str | None]] = []
        self._error = error
        self._commits = commits

    async def run(self, job: ActiveJob) -> None:
        self.started.set()
        job.report(0.5, "half of it")
        if self._commits:
            with job.commit():
                await self.go.wait()
        await self.go.wait()
        if self._error:
            raise self._error

    def ended(self, status: Status, error: str | None) -> None:
        self.noted.append((status, error))


class Queue:
    """A runner on an index of its own."""

    def __init__(self, folder: Path, max_jobs: int) -> None:
        self.database = Database(folder / "index.sqlite")
        self.store = JobStore(self.database)
        self.runner = JobRunner(self.store, max_jobs)

    def add(self, work: Waiting) -> str:
        job = self.store.add("test", "subject")
        self.runner.submit(job, work)
        return job.id

    async def end_of(self, job_id: str) -> JobRecord:
        async for view in self.runner.watch(job_id, 10):
            assert view is not None
        return self.store.get(job_id)


@pytest.fixture
def with_queue(tmp_path: Path) -> Callable[..., Any]:
    """Runs a coroutine function with a queue."""

    def run(use: Callable[[Queue], Coroutine[Any, Any, Any]], max_jobs: int = 1) -> Any:
        async def main() -> Any:
            queue = Queue(tmp_path, max_jobs)
            try:
                async with asyncio.timeout(20):
                    return await use(queue)
            finally:
                await queue.runner.close()
                queue.database.close()

        return asyncio.run(main())

    return run


def test_jobs_run_in_the_order_of_their_coming_and_no_more_than_allowed(with_queue: Any) -> None:
    async def use(queue: Queue) -> None:
        works = [Waiting() for _ in range(3)]
        jobs = [queue.add(work) for work in works]
        await works[1].started.wait()
        assert works[0].started.is_set()
        assert not works[2].started.is_set()
        assert queue.runner.counts() == (2, 1)
        works[0].go.set()
        await works[2].started.wait()
        works[1].go.set()
        works[2].go.set()
        assert [(await queue.end_of(job)).status for job in jobs] == [Status.DONE] * 3
        assert queue.runner.counts() == (0, 0)

    with_queue(use, max_jobs=2)


def test_an_error_of_the_input_is_told_and_a_bug_is_not(with_queue: Any) -> None:
    async def use(queue: Queue) -> list[JobRecord]:
        ends = []
        for error in (InputError("the log is empty"), KeyError("inner workings")):
            work = Waiting(error)
            work.go.set()
            job = queue.add(work)
            ends.append(await queue.end_of(job))
            assert work.noted == [(ends[-1].status, ends[-1].error)]
        return ends

    expected, bug = with_queue(use)
    assert (expected.status, expected.error) == (Status.FAILED, "the log is empty")
    assert bug.status is Status.FAILED
    assert "inner workings" not in str(bug.error)


def test_a_job_is_cancelled_whether_it_waits_runs_or_has_not_begun(with_queue: Any) -> None:
    async def use(queue: Queue) -> None:
        running, waiting, fresh = Waiting(), Waiting(), Waiting()
        first, second = queue.add(running), queue.add(waiting)
        await running.started.wait()
        third = queue.add(fresh)
        for job, work in ((third, fresh), (second, waiting), (first, running)):
            view = await queue.runner.cancel(job)
            assert view.record.status is Status.CANCELLED
            assert work.noted == [(Status.CANCELLED, None)]
            assert queue.store.get(job).status is Status.CANCELLED
        assert not waiting.started.is_set()

    with_queue(use)


def test_cancelling_comes_too_late_once_the_result_takes_its_place(with_queue: Any) -> None:
    async def use(queue: Queue) -> Status:
        work = Waiting(commits=True)
        job = queue.add(work)
        await work.started.wait()
        cancelling = asyncio.create_task(queue.runner.cancel(job))
        await asyncio.sleep(0.05)
        assert not cancelling.done()
        work.go.set()
        return (await cancelling).record.status

    assert with_queue(use) is Status.DONE


def test_closing_fails_what_is_left_with_the_reason(with_queue: Any) -> None:
    async def use(queue: Queue) -> list[JobRecord]:
        running, waiting = Waiting(), Waiting()
        jobs = [queue.add(running), queue.add(waiting)]
        await running.started.wait()
        await queue.runner.close()
        return [queue.store.get(job) for job in jobs]

    for job in with_queue(use):
        assert (job.status, job.error) == (Status.FAILED, STOPPED)


def test_a_slow_watcher_still_hears_of_the_end(with_queue: Any) -> None:
    async def use(queue: Queue) -> list[JobView | None]:
        work = Waiting()
        job = queue.add(work)
        heard: list[JobView | None] = []
        async for view in queue.runner.watch(job, heartbeat_s=10):
            heard.append(view)
            if len(heard) == 1:  # everything else happens while the first news is on its way
                work.go.set()
                while not work.noted or queue.runner.counts() != (0, 0):
                    await asyncio.sleep(0.01)
        return heard

    first, *_, last = with_queue(use)
    assert first is not last
    assert last.record.status is Status.DONE
    assert last.progress == 1.0


def test_a_watcher_hears_a_heartbeat_in_silence(with_queue: Any) -> None:
    async def use(queue: Queue) -> bool:
        work = Waiting()
        job = queue.add(work)
        async for view in queue.runner.watch(job, heartbeat_s=0.01):
            if view is None:
                return True
        return False

    assert with_queue(use)


def test_an_unknown_job_is_not_found(with_queue: Any) -> None:
    async def use(queue: Queue) -> None:
        with pytest.raises(NotFound):
            queue.runner.view("nothing")
        with pytest.raises(NotFound):
            await queue.runner.cancel("nothing")

    with_queue(use)


def test_starting_never_revives_a_job_that_has_ended(tmp_path: Path) -> None:
    database = Database(tmp_path / "index.sqlite")
    store = JobStore(database)
    job = store.add("test", "subject")
    store.end(job, Status.CANCELLED, None)
    store.start(job)
    assert store.get(job.id).status is Status.CANCELLED
    database.close()
