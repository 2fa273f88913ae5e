"""From bytes to a robot log, one format a file.

A reader (`native`, `delimited_text`, ...) makes a `DraftLog` of what is in the file; `acceptance` turns any
draft into a `RobotLog` and its report. What is refused and what is repaired:

- refused, with file and line: what is no log, a damaged or cut gzip or zip, a line that cannot be
  understood, a wrong number of ranges or columns, a pose or time that is missing, NaN or beyond 10 km, time
  that runs backwards or stands still, and everything beyond `ReadLimits`.
- left out, with a line in the report: a last line cut in the middle (no line end after it), single rows
  that come late or repeat a time, scans without a pose near their time.
- repaired, with a line in the report: clocks that wrap, are set or tick in whole seconds.
- taken as no echo: null, blank, NaN, infinite; zero, negative and beyond the sonar's range, with a line in
  the report.
- accepted: one scan, a robot that never moves; the report says that it will make no map.
"""

from core.log_readers.loaded_log import LoadedLog
from core.log_readers.log_report import LogReport
from core.log_readers.registry import read_log

__all__ = ["LoadedLog", "LogReport", "read_log"]
