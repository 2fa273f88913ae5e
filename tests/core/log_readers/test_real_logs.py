"""The real corridor log and the logs of an independent simulator."""

from __future__ import annotations

import shutil
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from core.log_readers import LoadedLog, read_log

pytestmark = pytest.mark.data
DESCRIPTION = Path(__file__).with_name("corridor_test1.yaml")


@pytest.fixture(scope="module")
def corridor_folder(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The corridor log with its description beside it."""
    folder = tmp_path_factory.mktemp("corridor")
    shutil.copy(DESCRIPTION, folder / "log.yaml")
    for file in (data_dir / "logs" / "corridor_test1").glob("*.txt"):
        (folder / file.name).symlink_to(file)
    return folder


@pytest.fixture(scope="module")
def corridor(corridor_folder: Path) -> LoadedLog:
    return read_log(corridor_folder)


def test_the_corridor_log_is_what_its_readme_says(corridor: LoadedLog) -> None:
    report = corridor.report
    assert (report.scans, report.sonars) == (413, 8)
    assert report.duration_s == pytest.approx(92.8, abs=0.1)
    assert report.distance_m == pytest.approx(25, abs=0.1)
    assert report.rate_hz == pytest.approx(4.65, abs=0.05)
    assert report.good_for_map
    assert report.skipped == report.clock == ()
    assert report.gap_count == report.jump_count == 0


def test_odometry_ends_where_the_readme_says(corridor: LoadedLog) -> None:
    log = corridor.log
    assert log.truth is not None
    off = log.odometry[-1] - log.truth[-1]
    assert np.hypot(*off[:2]) == pytest.approx(0.83, abs=0.02)
    assert abs(np.degrees(off[2])) % 360 == pytest.approx(3, abs=0.5)
    assert np.abs(np.diff(np.unwrap(log.odometry[:, 2]))).max() < 0.2


def test_sonars_that_fire_in_turn_are_found(corridor: LoadedLog) -> None:
    ranges, fresh = corridor.log.ranges, corridor.log.fresh
    echo = np.isfinite(ranges[1:])
    repeats = ((ranges[1:] == ranges[:-1]) & echo).sum() / echo.sum()
    assert repeats == pytest.approx(0.5, abs=0.1)
    assert corridor.report.latched == pytest.approx(0.46, abs=0.03)
    assert fresh[1:][ranges[1:] != ranges[:-1]][echo[ranges[1:] != ranges[:-1]]].all()


def test_no_echo_shares_of_the_corridor(corridor: LoadedLog) -> None:
    share = np.array(corridor.report.no_echo_per_sonar)
    assert share == pytest.approx([0.14, 0.30, 0.25, 0.43, 0.80, 0.30, 0.30, 0.05], abs=0.01)


def test_the_description_itself_may_be_given(corridor_folder: Path, corridor: LoadedLog) -> None:
    assert read_log(corridor_folder / "log.yaml").report == corridor.report


def test_no_value_of_the_simulated_homes_is_taken_for_a_repeat(data_dir: Path) -> None:
    for path in sorted((data_dir / "homes" / "logs").glob("*.jsonl.gz")):
        report = read_log(path).report
        assert report.latched == 0, path.name
        assert report.good_for_map, path.name
        assert len(report.verdict) == 1, path.name


def test_thirty_thousand_readings_load_in_a_third_of_a_second(data_dir: Path) -> None:
    path = data_dir / "homes" / "logs" / "home24_map.jsonl.gz"
    read_log(path)
    start = time.process_time()
    log = read_log(path).log
    assert time.process_time() - start < 0.3
    assert log.ranges.size > 31_000


@pytest.mark.slow
def test_memory_is_a_few_times_the_size_of_the_file_at_most(data_dir: Path, tmp_path: Path) -> None:
    import gzip
    import subprocess

    packed = data_dir / "homes" / "logs" / "home24_map.jsonl.gz"
    header, *scans = gzip.decompress(packed.read_bytes()).splitlines(keepends=True)
    path = tmp_path / "long.jsonl"
    with path.open("wb") as file:
        file.write(header)
        for i in range(65):
            for j, scan in enumerate(scans):
                t = (i * len(scans) + j) * 0.25
                file.write(b'{"t":%.2f%s' % (t, scan[scan.index(b",") :]))
    status = Path("/proc/self/status")
    if not status.is_file():
        pytest.skip("the peak memory of a process is read from /proc, which this system lacks")
    program = (
        "import sys; from pathlib import Path; from core.log_readers import read_log; "
        "read_log(Path(sys.argv[1])); "
        "print(Path('/proc/self/status').read_text().split('VmHWM:')[1].split()[0])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, str(path)], capture_output=True, text=True, check=True
    )
    assert path.stat().st_size > 22e6
    assert int(done.stdout) < 200_000  # kB
