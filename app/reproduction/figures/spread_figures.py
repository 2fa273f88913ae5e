"""Figures over many homes: methods compared, reliability."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go

from app.reproduction.figures.colours import METHODS
from app.reproduction.figures.layers import LAYOUT
from app.reproduction.many_homes import HomeFigures
from core.evaluation.localization import reliability

LEGEND = LAYOUT | {"showlegend": True, "legend": {"orientation": "h", "y": 1.15}}


def accuracy_figure(homes: tuple[HomeFigures, ...]) -> go.Figure:
    """Right node on all steps of every home, by method and kind of drive."""
    keys = list(homes[0].drives) if homes else []
    figure = go.Figure(
        [
            go.Box(
                y=[round(home.groups[key]["accuracy"], 4) for home in homes],
                name=key,
                boxpoints="all",
                jitter=0.3,
                text=[home.name for home in homes],
                marker_color=METHODS.get(key.rpartition(", ")[2]),
            )
            for key in keys
        ]
    )
    figure.update_yaxes(range=[-0.02, 1.02], title="right node, all steps")
    return figure.update_layout(height=380, **LAYOUT)


def reliability_figure(homes: tuple[HomeFigures, ...]) -> go.Figure:
    """Reliability diagram: how often a method is right when it tells a probability."""
    line = {"color": "#999", "dash": "dash"}
    figure = go.Figure([go.Scatter(x=[0, 1], y=[0, 1], mode="lines", line=line, name="calibrated")])
    methods = {key.rpartition(", ")[2] for home in homes for key in home.drives}
    for method in [m for m in METHODS if m in methods]:
        steps = [
            step
            for home in homes
            for key, drive in home.drives.items()
            if key.rpartition(", ")[2] == method
            for step in drive
        ]
        told = np.array([step.probability for step in steps])
        rows = reliability(told, np.array([step.right for step in steps], float))
        rows = rows[rows[:, 2] > 0]
        figure.add_trace(
            go.Scatter(
                x=rows[:, 0].round(4).tolist(),
                y=rows[:, 1].round(4).tolist(),
                mode="lines+markers",
                name=method,
                text=[f"{int(n)} steps" for n in rows[:, 2]],
                line={"color": METHODS[method]},
            )
        )
    figure.update_xaxes(range=[-0.02, 1.02], title="probability told")
    figure.update_yaxes(range=[-0.02, 1.02], title="share right")
    return figure.update_layout(height=420, **LEGEND)
