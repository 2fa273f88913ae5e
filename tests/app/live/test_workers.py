"""Scans go before models when both want the same worker."""

from __future__ import annotations

import asyncio

from app.live.workers import Turns


def test_what_is_urgent_goes_first_and_the_rest_is_not_forgotten() -> None:
    order: list[str] = []

    async def work(turns: Turns, name: str, urgent: bool) -> None:
        async with turns.turn(urgent):
            order.append(name)
            await asyncio.sleep(0.02)

    async def run() -> None:
        turns = Turns()
        first = asyncio.create_task(work(turns, "scan 1", True))
        await asyncio.sleep(0.005)
        model = asyncio.create_task(work(turns, "model", False))
        await asyncio.sleep(0.005)
        scans = [asyncio.create_task(work(turns, f"scan {n}", True)) for n in (2, 3)]
        await asyncio.gather(first, model, *scans)

    asyncio.run(run())
    assert order == ["scan 1", "scan 2", "scan 3", "model"]


def test_a_turn_that_was_given_up_lets_others_go_on() -> None:
    async def run() -> bool:
        turns = Turns()
        async with turns.turn(True):
            waiting = [asyncio.create_task(_enter(turns, urgent)) for urgent in (True, False)]
            await asyncio.sleep(0.005)
            for task in waiting:
                task.cancel()
            await asyncio.gather(*waiting, return_exceptions=True)
        async with asyncio.timeout(1), turns.turn(False):
            return True

    async def _enter(turns: Turns, urgent: bool) -> None:
        async with turns.turn(urgent):
            raise AssertionError("it was given up")

    assert asyncio.run(run())
