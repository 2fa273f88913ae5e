"""viser's own server, kept private: loopback only, silent, no tunnels, and only the bridge gets in.

Every private part of viser that the project touches is in this file; `tests/app/viewer` pins them.
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from urllib.parse import parse_qs, urlencode, urlsplit

import rich
import viser
from viser.infra import WebsockClientConnection

SUBPROTOCOL = f"viser-v{viser.__version__}"
"""What viser's web client offers; another version is refused by viser with close code 1002."""

_POLICY_VIOLATION = 1008


class PrivateViser(viser.ViserServer):
    """One viser server on an ephemeral loopback port.

    viser checks neither origin nor session, so any page of any site could talk to a port on
    loopback. Here a connection must carry a secret that only the bridge knows; everything else is
    closed before a byte of the scene is sent.
    """

    def __init__(self) -> None:
        self._key = secrets.token_urlsafe(24)
        with _silent():
            super().__init__(host="127.0.0.1", port=0, verbose=False)
        self._websock_server.on_client_connect(self._refuse_strangers)
        self.gui.configure_theme(control_layout="floating", show_logo=False)

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Never: any client could open a public tunnel otherwise."""
        return None

    def url_for(self, tab: str) -> str:
        """Where the bridge dials on behalf of a tab."""
        return f"ws://127.0.0.1:{self.get_port()}/?{urlencode({'key': self._key, 'tab': tab})}"

    def tab_of(self, client: viser.ClientHandle) -> str | None:
        """The tab that a client belongs to; None once it has gone."""
        return self._query(client.client_id).get("tab", [None])[0]

    def stop(self) -> None:
        """Closes every connection and ends the threads."""
        with _silent():
            super().stop()

    async def _refuse_strangers(self, connection: WebsockClientConnection) -> None:
        key = self._query(connection.client_id).get("key", [""])[0]
        if not hmac.compare_digest(key, self._key):
            live = self._websock_server._live_connections.get(connection.client_id)
            if live is not None:
                await live.close(_POLICY_VIOLATION)

    def _query(self, client_id: int) -> dict[str, list[str]]:
        live = self._websock_server._live_connections.get(client_id)
        if live is None or live.request is None:
            return {}
        return parse_qs(urlsplit(live.request.path).query)


@contextmanager
def _silent() -> Iterator[None]:
    """viser prints a panel at start and a line at the end whatever it is told."""
    console = rich.get_console()
    before = console.quiet
    console.quiet = True
    try:
        yield
    finally:
        console.quiet = before
