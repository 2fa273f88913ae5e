"""The private parts of viser that the project relies on, and what it must never do."""

from __future__ import annotations

import inspect
from importlib import metadata, resources

import pytest
import viser
from packaging.specifiers import SpecifierSet
from viser.infra import _infra

from app.viewer.viser_server import SUBPROTOCOL, PrivateViser


@pytest.fixture
def server():
    server = PrivateViser()
    yield server
    server.stop()


def test_the_installed_viser_is_within_the_pin():
    pin = next(r for r in metadata.requires("echorooms") if r.startswith("viser"))
    assert metadata.version("viser") in SpecifierSet(pin.removeprefix("viser"))
    assert f"viser-v{viser.__version__}" == SUBPROTOCOL


def test_viser_keeps_its_live_connections_where_the_tab_is_read_from(server):
    assert server._websock_server._live_connections == {}
    source = inspect.getsource(_infra.WebsockServer)
    assert "self._live_connections[client_id] = connection" in source
    # The connection must be known before the callbacks that look at its request run.
    assert source.index("_live_connections[client_id] =") < source.index("for cb in self._client_c")


def test_it_listens_on_loopback_and_on_a_port_of_its_own(server):
    other = PrivateViser()
    try:
        assert server.get_host() == "127.0.0.1"
        assert server.get_port() != 0
        assert server.get_port() != other.get_port()
    finally:
        other.stop()


def test_no_tunnel_to_the_outside_is_ever_opened(server):
    assert server.request_share_url() is None
    assert server._share_tunnel is None
    # What a client can ask for calls the method that is overridden here.
    assert "self.request_share_url" in inspect.getsource(viser.ViserServer.__init__)


def test_it_says_nothing_on_the_terminal(capfd):
    PrivateViser().stop()
    out, err = capfd.readouterr()
    assert (out, err) == ("", "")


def test_the_url_of_a_tab_carries_a_secret_of_this_server(server):
    other = PrivateViser()
    try:
        key = server.url_for("tab").split("key=")[1].split("&")[0]
        assert len(key) >= 32
        assert key not in other.url_for("tab")
    finally:
        other.stop()


def test_the_shader_that_draws_the_labels_is_the_one_that_the_page_rounds():
    labels = resources.files("viser") / "client/src/label/LabelRenderer.tsx"
    source = labels.read_text("utf-8")
    script = (resources.files("app.viewer") / "page/view.js").read_text("utf-8")
    for piece in (
        "gl_FragColor = vec4(1.0, 1.0, 1.0, 0.85 * vAlpha);",
        "vec2 local = (aRect.xy + corner * aRect.zw) * scale;",
        "varying vec2 vUv;",
    ):
        assert piece in source
        assert piece in script
