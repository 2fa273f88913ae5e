"""What lies in the folder of a log."""

NATIVE_FILE = "log.jsonl.gz"
"""The drive in the native format, as the program understood it."""
REPORT_FILE = "report.json"
ORIGINAL_FOLDER = "original"
"""The upload as it came, under its own name."""
