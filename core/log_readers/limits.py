"""How much a log may ask for. A log comes from strangers: everything it can make grow is bounded."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ReadLimits:
    """Bounds on a log; beyond them it is refused (HTTP 413), never read half.

    Attributes:
        max_bytes: of all files of a log together, unpacked. 46 hours of 12 sonars at 4 Hz.
        max_ratio: unpacked bytes for one packed byte; drives have 3-10.
        ratio_counts_from: smaller logs may pack better.
        max_line_bytes: of one line.
        max_lines: of one file.
        max_readings: scans times sonars; 64 MB as an array, copied a few times while reading.
        max_sonars: in a ring.
        max_coordinate_m: of a pose, from the origin of the odometry frame.
        max_heading_rad: of a pose that is not wrapped.
        max_time_s: from the clock's zero; epoch milliseconds taken for seconds still pass.
        max_mount_m: of a sonar from the robot's centre, and of the robot's radius.
        max_sonar_range_m: a sonar in air does not see farther.
        max_yaml_bytes: of a log.yaml or a ring file; 256 sonars need 25 kB.
        max_archive_entries: files in a zip.
        max_archive_directory_bytes: of the zip's table of contents, which is read into memory.
        max_name_length: of the name of a log.
    """

    max_bytes: int = 256 * 2**20
    max_ratio: int = 100
    ratio_counts_from: int = 16 * 2**20
    max_line_bytes: int = 2**20
    max_lines: int = 1_000_000
    max_readings: int = 8_000_000
    max_sonars: int = 256
    max_coordinate_m: float = 10_000.0
    max_heading_rad: float = 1e6
    max_time_s: float = 1e13
    max_mount_m: float = 5.0
    max_sonar_range_m: float = 100.0
    max_yaml_bytes: int = 128 * 2**10
    max_archive_entries: int = 1000
    max_archive_directory_bytes: int = 2**20
    max_name_length: int = 200


DEFAULT_LIMITS = ReadLimits()
