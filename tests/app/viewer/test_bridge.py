"""The bridge, over a real port, without a browser."""

from __future__ import annotations

import time

import pytest
import viser
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Subprotocol

PROTOCOL = Subprotocol(f"viser-v{viser.__version__}")


def test_the_scene_comes_over_the_servers_own_port(server, shows_label):
    with server.view("m1") as client:
        assert client.connection.subprotocol == PROTOCOL
        client.wait_for(shows_label("study"))
        client.wait_for(shows_label("Region 1"))
        client.wait_for(lambda m: m.get("name") == "/walls/top")


def test_viser_refuses_another_version_of_its_client_with_1002(server):
    other = Subprotocol("viser-v0.0.1")
    with connect(server.url("/view/m1"), subprotocols=[other]) as socket:
        with pytest.raises(ConnectionClosed) as closed:
            socket.recv(5)
        assert closed.value.rcvd.code == 1002


def test_a_page_of_another_origin_gets_no_view(server):
    with pytest.raises(InvalidStatus) as refused:
        connect(server.url("/view/m1"), subprotocols=[PROTOCOL], origin="http://evil.example")
    assert refused.value.response.status_code == 403


def test_an_unknown_model_gets_no_view(server):
    with pytest.raises(InvalidStatus) as refused:
        connect(server.url("/view/nothing"), subprotocols=[PROTOCOL])
    assert refused.value.response.status_code == 403


def test_a_message_that_no_browser_sends_ends_the_connection(server):
    with server.view("m1") as client:
        client.drain()
        client.connection.send(b"\0" * ((1 << 20) + 1))
        with pytest.raises(ConnectionClosed) as closed:
            client.drain(5)
        assert closed.value.rcvd.code == 1009


def test_viser_itself_sends_nothing_to_a_connection_that_is_not_the_bridges(server):
    with server.view("m1"):
        port = server.hub.opened("m1").server.get_port()
        with connect(f"ws://127.0.0.1:{port}/?key=guess", subprotocols=[PROTOCOL]) as stranger:
            with pytest.raises(ConnectionClosed) as closed:
                stranger.recv(5)
            assert closed.value.rcvd.code == 1008


def test_a_browser_that_goes_is_no_longer_a_client(server):
    with server.view("m1") as client:
        client.wait_for(lambda m: m.get("name") == "/lights/sun")
        viser_server = server.hub.opened("m1").server
        assert len(viser_server.get_clients()) == 1
    end = time.monotonic() + 5
    while viser_server.get_clients() and time.monotonic() < end:
        time.sleep(0.01)
    assert not viser_server.get_clients()
