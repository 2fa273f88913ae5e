"""How many robots one server takes at once: `python tests/benchmarks/live_load.py [--robots 30]`.

Starts `echorooms serve` and lets simulated robots stream at 4 Hz, each with twelve sonars and a
model that grows every 2.5 m. Prints the percentiles of the time from sending a scan until it is
acknowledged (safe on the disk) and until it is taken in (mapped, its state published), what was
acknowledged and is not in the recordings, and the processor time of the server. `--search` doubles
and halves the number until the largest one is found that is taken in within a second at p99.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import httpx2
import numpy as np
import psutil
from websockets.asyncio.client import connect

from core.log_readers.native import header_of
from core.log_readers.native_line import scan_record
from core.sensing import RobotLog
from core.simulation import simulate

RATE_HZ = 4.0
HOMES = 6
P99_LIMIT_S = 1.0
WARM_UP_ROBOTS, WARM_UP_S = 4, 15.0
"""Robots that drive before anything is measured, so that every worker has loaded its libraries."""
SERVER = "from app.cli import main; main()"


async def robot(url: str, log: RobotLog, seconds: float, delay: float) -> dict[str, Any]:
    """Streams one drive in real time; what it measured."""
    await asyncio.sleep(delay)
    lines = [scan_record(scan) for scan in log.without_truth()][: int(seconds * RATE_HZ)]
    sent: dict[float, float] = {}
    acked: list[float] = []
    taken: dict[float, float] = {}
    async with httpx2.AsyncClient(base_url=url, timeout=60) as client:
        body = {"mode": "mapping", "header": header_of(log)}
        session = (await client.post("/api/live", json=body)).json()["id"]
    base = f"{url.replace('http', 'ws', 1)}/api/live/{session}"
    async with connect(f"{base}/scans") as scans, connect(f"{base}/events") as events:
        hearing = asyncio.create_task(_hear(events, sent, taken))
        start = time.monotonic()
        for i, line in enumerate(lines):
            await asyncio.sleep(max(0.0, start + i / RATE_HZ - time.monotonic()))
            sent[line["t"]] = time.monotonic()
            await scans.send(json.dumps(line))
            answer = json.loads(await scans.recv())
            assert answer.get("ack") == line["t"], answer
            acked.append(time.monotonic() - sent[line["t"]])
        for _ in range(200):
            if len(taken) == len(sent):
                break
            await asyncio.sleep(0.1)
        hearing.cancel()
    return {"id": session, "acked": acked, "taken": list(taken.values()), "sent": len(sent)}


async def _hear(events: Any, sent: dict[float, float], taken: dict[float, float]) -> None:
    async for text in events:
        event = json.loads(text)
        if event["type"] == "taken_in":
            for t in [t for t in sent if t <= event["t"] and t not in taken]:
                taken[t] = time.monotonic() - sent[t]


async def load(url: str, logs: list[RobotLog], robots: int, seconds: float) -> list[dict[str, Any]]:
    """All robots at once; their starts are spread over a period of the scans."""
    return await asyncio.gather(
        *(robot(url, logs[i % len(logs)], seconds, i / robots / RATE_HZ) for i in range(robots))
    )


def measured(logs: list[RobotLog], robots: int, seconds: float) -> tuple[str, bool]:
    """A row of the table, and whether so many robots are taken in in time."""
    with tempfile.TemporaryDirectory() as data:
        command = [sys.executable, "-c", SERVER, "serve", "--port", "0", "--data", data]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=os.environ) as server:
            try:
                assert server.stdout is not None
                url = next(w for w in server.stdout.readline().split() if w.startswith("http"))
                asyncio.run(load(url.rstrip("/"), logs, WARM_UP_ROBOTS, WARM_UP_S))
                before = _cpu_seconds(server.pid)
                found = asyncio.run(load(url.rstrip("/"), logs, robots, seconds))
                cpu = _cpu_seconds(server.pid) - before
                lost = sum(max(0, len(r["acked"]) - _recorded(Path(data), r["id"])) for r in found)
            finally:
                server.terminate()
    acked = np.concatenate([r["acked"] for r in found])
    taken = np.concatenate([r["taken"] for r in found])
    missing = sum(r["sent"] for r in found) - len(taken)
    p99 = float(np.percentile(taken, 99)) if len(taken) else np.inf
    return (
        f"{robots:3d} robots {seconds:.0f} s: acknowledged p50 {np.median(acked) * 1e3:.0f} p99 "
        f"{np.percentile(acked, 99) * 1e3:.0f} ms; taken in p50 {np.median(taken) * 1e3:.0f} p99 "
        f"{p99 * 1e3:.0f} ms, not at the end {missing}; lost {lost}; server "
        f"{cpu / seconds:.2f} processors",
        p99 < P99_LIMIT_S and missing == 0 and lost == 0,
    )


def _cpu_seconds(pid: int) -> float:
    """Processor seconds of the server and its workers."""
    process = psutil.Process(pid)
    times = [p.cpu_times() for p in (process, *process.children(recursive=True))]
    return sum(t.user + t.system for t in times)


def _recorded(data: Path, session: str) -> int:
    return len((data / "live" / session / "log.jsonl").read_text().splitlines()) - 1


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--robots", type=int, default=30)
    parser.add_argument("--seconds", type=float, default=180.0)
    parser.add_argument("--search", action="store_true")
    options = parser.parse_args()
    logs = [simulate("paper", seed=seed) for seed in range(HOMES)]
    row, holds = measured(logs, options.robots, options.seconds)
    print(row, flush=True)
    if not options.search:
        return
    low, high = (options.robots, 2 * options.robots) if holds else (0, options.robots)
    while high - low > max(1, low // 10):
        middle = (low + high) // 2
        row, holds = measured(logs, middle, options.seconds)
        print(row, flush=True)
        low, high = (middle, high) if holds else (low, middle)
    print(f"the largest number that holds: {low}")


if __name__ == "__main__":
    main()
