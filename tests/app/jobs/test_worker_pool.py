"""Tasks in worker processes."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

import psutil
import pytest

from app.jobs.worker_pool import TASKS_PER_WORKER, WorkerPool
from app.jobs.worker_process import OutOfMemoryError, TaskLimits, TaskTimeoutError
from core.errors import LogError, TooLargeError

WorkerIds = Callable[[], set[int]]
PLENTY = TaskLimits(60, 1 << 30)


@pytest.fixture
def drive(tmp_path: Path, make_log: Callable[..., bytes]) -> Callable[..., dict[str, Any]]:
    """Arguments of a `read_log` task with a fresh upload."""

    def arguments(content: bytes | None = None, number: int = 0) -> dict[str, Any]:
        upload = tmp_path / f"drive{number}.jsonl"
        upload.write_bytes(make_log() if content is None else content)
        return {"upload": str(upload), "ring": None, "out": str(tmp_path / f"out{number}")}

    return arguments


def with_pool(use: Callable[[WorkerPool], Coroutine[Any, Any, Any]], warm: int = 1) -> Any:
    """What `use` returns, run with a pool that is closed afterwards."""

    async def main() -> Any:
        pool = WorkerPool(warm)
        try:
            return await use(pool)
        finally:
            await pool.close()

    return asyncio.run(main())


@pytest.fixture
def worker_ids() -> Callable[[], set[int]]:
    """Tells the processes that were started since the test began."""

    def children() -> set[int]:
        return {child.pid for child in psutil.Process().children()}

    before = children()
    return lambda: children() - before


def test_a_task_answers_with_its_result_and_tells_progress(
    worker_ids: WorkerIds, drive: Any, tmp_path: Path
) -> None:
    told: list[float] = []

    async def use(pool: WorkerPool) -> dict[str, Any]:
        return await pool.run("read_log", drive(), PLENTY, lambda share, what: told.append(share))

    assert with_pool(use)["scans"] == 80
    assert told
    assert gzip.decompress((tmp_path / "out0" / "log.jsonl.gz").read_bytes()).count(b"\n") == 81
    assert worker_ids() == set()


def test_a_worker_serves_again_after_a_good_task_and_after_bad_input(
    worker_ids: WorkerIds, drive: Any
) -> None:
    async def use(pool: WorkerPool) -> list[set[int]]:
        seen = []
        for number, content in enumerate((None, b"", None)):
            with contextlib.suppress(LogError):
                await pool.run("read_log", drive(content, number), PLENTY)
            seen.append(worker_ids())
        return seen

    first, second, third = with_pool(use)
    assert first == second == third
    assert len(first) == 1


def test_an_error_in_the_log_keeps_its_kind_and_line(
    worker_ids: WorkerIds, drive: Any, make_log: Any
) -> None:
    lines = make_log().splitlines(keepends=True)
    lines[4] = b"{}\n"

    async def use(pool: WorkerPool) -> None:
        await pool.run("read_log", drive(b"".join(lines)), PLENTY)

    with pytest.raises(LogError, match="line 5") as raised:
        with_pool(use)
    assert raised.value.line == 5


def test_a_task_without_enough_memory_says_so_and_its_worker_is_not_used_again(
    worker_ids: WorkerIds, drive: Any, make_log: Any
) -> None:
    async def use(pool: WorkerPool) -> tuple[set[int], set[int]]:
        await pool.run("read_log", drive(), PLENTY)
        before = worker_ids()
        with pytest.raises(OutOfMemoryError, match="1 MB"):
            await pool.run("read_log", drive(make_log(scans=20_000), 1), TaskLimits(60, 1 << 20))
        return before, worker_ids()

    before, after = with_pool(use)
    assert before.isdisjoint(after)


def test_a_task_that_takes_too_long_is_stopped(worker_ids: WorkerIds, drive: Any) -> None:
    async def use(pool: WorkerPool) -> None:
        await pool.run("read_log", drive(), TaskLimits(0.001, 1 << 30))

    with pytest.raises(TaskTimeoutError, match=r"0\.001 s"):
        with_pool(use, warm=0)
    assert worker_ids() == set()


def test_a_cancelled_task_takes_its_worker_along(
    worker_ids: WorkerIds, drive: Any, make_log: Any
) -> None:
    async def use(pool: WorkerPool) -> set[int]:
        task = asyncio.create_task(pool.run("read_log", drive(make_log(scans=20_000)), PLENTY))
        await asyncio.sleep(0.3)
        assert len(worker_ids()) == 1
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        return worker_ids()

    assert with_pool(use, warm=0) == set()


def test_a_worker_is_replaced_after_many_tasks(worker_ids: WorkerIds, drive: Any) -> None:
    async def use(pool: WorkerPool) -> tuple[set[int], set[int]]:
        await pool.warm_up()
        before = worker_ids()
        for number in range(TASKS_PER_WORKER):
            await pool.run("read_log", drive(None, number), PLENTY)
        return before, worker_ids()

    before, after = with_pool(use)
    assert before.isdisjoint(after)
    assert len(after) == 1


def test_a_worker_whose_server_is_gone_leaves(worker_ids: WorkerIds, drive: Any) -> None:
    async def use(pool: WorkerPool) -> psutil.Process:
        await pool.warm_up()
        (pid,) = worker_ids()
        return psutil.Process(pid)

    async def abandon() -> None:
        pool = WorkerPool(1)
        worker = await use(pool)
        pool._idle[0]._process._transport.get_pipe_transport(0).close()  # type: ignore[attr-defined]
        await asyncio.to_thread(worker.wait, 20)
        await pool.close()

    asyncio.run(abandon())


def test_too_many_sonars_are_too_large_not_merely_wrong(
    worker_ids: WorkerIds, drive: Any, make_log: Any
) -> None:
    import json

    header = json.loads(make_log().split(b"\n")[0])
    header["sonars"] *= 1000

    async def use(pool: WorkerPool) -> None:
        await pool.run("read_log", drive(json.dumps(header).encode() + b"\n"), PLENTY)

    with pytest.raises(TooLargeError):
        with_pool(use, warm=0)
