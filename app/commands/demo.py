"""`echorooms demo`: the dashboard with the sample logs."""

from __future__ import annotations

from app.commands.serve import DataOption, HostOption, PortOption, serve_with, settings_of


def demo(host: HostOption = None, port: PortOption = None, data: DataOption = None) -> None:
    """Serve the dashboard with the sample logs loaded and modelled; prints the URL."""
    serve_with(settings_of(host, port, data, demo=True))
