"""What to say about a file that is no robot log of a known format."""

from __future__ import annotations

import string

from core.log_readers.byte_source import LogSource

_SIGNATURES = (
    (b"\x89PNG", "a PNG image"),
    (b"\xff\xd8\xff", "a JPEG image"),
    (b"GIF8", "a GIF image"),
    (b"%PDF", "a PDF document"),
    (b"P5", "a PGM image"),
    (b"\x7fELF", "a program"),
    (b"Rar!", "a RAR archive; use zip"),
    (b"7z\xbc\xaf", "a 7-Zip archive; use zip"),
    (b"BZh", "a bzip2 archive; use gzip or zip"),
    (b"\xfd7zXZ", "an xz archive; use gzip or zip"),
    (b"\x28\xb5\x2f\xfd", "a zstd archive; use gzip or zip"),
    (b"#ROSBAG", "a ROS 1 bag, which cannot be read yet"),
    (b"\x89MCAP", "an MCAP file, which cannot be read yet"),
    (b"SQLite format 3", "an SQLite database (a ROS 2 bag?), which cannot be read yet"),
)
_TAR_MAGIC_AT = 257
_TEXT = frozenset(string.printable.encode())
_TEXT_SHARE = 0.95


def unknown(source: LogSource) -> str:
    """What a source of no known format seems to be, and what to do about it."""
    head = source.head
    if source.path.is_dir():
        return "the folder has no log.yaml that says what its files mean"
    for signature, what in _SIGNATURES:
        if head.startswith(signature):
            return f"is {what}, not a robot log"
    if head[_TAR_MAGIC_AT : _TAR_MAGIC_AT + 5] == b"ustar":
        return "is a tar archive, not a robot log; use zip"
    if sum(byte in _TEXT for byte in head) >= _TEXT_SHARE * len(head):
        return (
            "is text, but no native log (JSON Lines); put it into a folder or a zip with a log.yaml "
            "that says what its columns mean"
        )
    return "is not a robot log that this program knows"
