"""Tokens: what a server that is reached from other machines asks for. One writes, one only reads.

Made at the first start beyond loopback and told once; the data folder keeps their hashes only. They
are random and long, so a plain hash is as good as a slow one.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import os
import secrets
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path

from core.errors import InputError

ACCESS_FILE = "access.json"
TOKEN_BYTES = 24


class Right(IntEnum):
    """What a token allows."""

    NOTHING = 0
    READ = 1
    WRITE = 2


@dataclass(frozen=True)
class Tokens:
    """Fresh tokens in plain text, to be told once."""

    write: str
    read: str


class Access:
    """Knows which token allows what, by their SHA-256 hashes (hexadecimal)."""

    def __init__(self, write: str, read: str) -> None:
        self._hashes = {Right.WRITE: write, Right.READ: read}
        self.inner_token = secrets.token_urlsafe(TOKEN_BYTES)
        """For the server's own simulated robots; of this start only."""
        self._inner = _hash(self.inner_token)

    def right_of(self, token: str | None) -> Right:
        """What a token allows; compared in constant time."""
        given = _hash(token or "")
        if hmac.compare_digest(given, self._inner):
            return Right.WRITE
        for right, known in self._hashes.items():
            if hmac.compare_digest(given, known):
                return right
        return Right.NOTHING


def open_access(data: Path) -> tuple[Access, Tokens | None]:
    """The access of a data folder, and the tokens if they are new.

    Raises:
        InputError: its file is damaged.
    """
    try:
        stored = json.loads((data / ACCESS_FILE).read_text(encoding="utf-8"))
        return Access(str(stored["write"]), str(stored["read"])), None
    except FileNotFoundError:
        tokens = renew_tokens(data)
        return Access(_hash(tokens.write), _hash(tokens.read)), tokens
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"{data / ACCESS_FILE} is damaged; make new tokens with `echorooms token`"
        ) from error


def renew_tokens(data: Path) -> Tokens:
    """New tokens; those before are worth nothing from the next start on."""
    tokens = Tokens(*(secrets.token_urlsafe(TOKEN_BYTES) for _ in range(2)))
    data.mkdir(parents=True, exist_ok=True)
    text = json.dumps({"write": _hash(tokens.write), "read": _hash(tokens.read)})
    temporary = data / f"{ACCESS_FILE}.new"
    temporary.unlink(missing_ok=True)
    descriptor = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    with os.fdopen(descriptor, "w", encoding="utf-8") as file:
        file.write(text)
    temporary.replace(data / ACCESS_FILE)
    return tokens


def _hash(token: str) -> str:
    return hashlib.sha256(token.encode("utf-8", "surrogatepass")).hexdigest()
