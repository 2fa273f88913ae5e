"""From bytes to a robot log, one format a file."""

from core.log_readers.loaded_log import LoadedLog
from core.log_readers.log_report import LogReport
from core.log_readers.registry import read_log

__all__ = ["LoadedLog", "LogReport", "read_log"]
