"""Figs. 17-21 and 24-26: templates, candidates, node probabilities, entropy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from app.reproduction.figures.colours import (
    PATH,
    REJECTED,
    TEMPLATE,
    TRUTH,
    UNKNOWN_PLACE,
    UPDATED,
    region_colour,
)
from app.reproduction.figures.layers import (
    LAYOUT,
    PANEL_HEIGHT,
    as_map,
    grid_layer,
    points_layer,
    robot_layer,
)
from app.reproduction.localized_drive import LocalizedDrive
from core.geometry import transform_points
from core.localization.localization_step import LocalizationStep
from core.topology import Model

COLUMNS, PAIR_HEIGHT = 3, 560
"""Steps side by side, and pixels of a map with its bars, in a figure of sampled steps."""
MAP_SHARE, BARS_SHARE, GAP = 0.66, 0.34, 0.3
"""Heights of a map and its bars, and of all gaps together, as shares."""


def template_figure(step: LocalizationStep) -> go.Figure:
    """Fig. 17: the template of a step in the robot's frame."""
    figure = go.Figure([points_layer(step.template), robot_layer(np.zeros(3), PATH)])
    as_map(figure)
    return figure.update_layout(height=PANEL_HEIGHT, **LAYOUT)


def candidates_figure(model: Model, step: LocalizationStep) -> go.Figure:
    """Fig. 18: the best place of every node for the template."""
    found = list(step.candidates.items())
    marks = go.Scatter(
        x=[round(float(c.pose[0]), 3) for _, c in found],
        y=[round(float(c.pose[1]), 3) for _, c in found],
        mode="markers+text",
        text=[f"{node} {c.score:.2f}" for node, c in found],
        textposition="top center",
        marker={"size": 10, "color": TEMPLATE},
        hoverinfo="text",
    )
    figure = go.Figure([grid_layer(model.grid), marks])
    as_map(figure)
    return figure.update_layout(height=PANEL_HEIGHT + 60, **LAYOUT)


def sampled_steps(steps: tuple[LocalizationStep, ...], count: int) -> tuple[LocalizationStep, ...]:
    """`count` steps spread over a drive, first and last among them."""
    if not steps:
        return ()
    index = np.unique(np.linspace(0, len(steps) - 1, count).round().astype(int))
    return tuple(steps[int(i)] for i in index)


def steps_figure(
    model: Model, drive: LocalizedDrive, steps: tuple[LocalizationStep, ...]
) -> go.Figure:
    """Figs. 19 and 24: template on the map at the most probable place; probability of every node."""
    pairs = (len(steps) + COLUMNS - 1) // COLUMNS
    figure = make_subplots(
        2 * pairs,
        COLUMNS,
        subplot_titles=_titles(steps, pairs),
        row_heights=[MAP_SHARE, BARS_SHARE] * pairs,
        vertical_spacing=GAP / (2 * pairs),
    )
    for i, step in enumerate(steps):
        row, col = 2 * (i // COLUMNS) + 1, i % COLUMNS + 1
        truth = drive.truth[int(np.abs(drive.log.t - step.t).argmin())]
        layers = [
            grid_layer(model.grid),
            points_layer(transform_points(step.pose, step.template), size=3),
            robot_layer(truth, TRUTH),
            robot_layer(step.pose, TEMPLATE),
        ]
        figure.add_traces(layers, rows=row, cols=col)
        as_map(figure, row, col)
        figure.add_trace(_probability_bars(model, step), row=row + 1, col=col)
        figure.update_yaxes(range=[0, 1], row=row + 1, col=col)
        figure.update_xaxes(tickfont_size=10, row=row + 1, col=col)
    return figure.update_layout(height=PAIR_HEIGHT * pairs, **LAYOUT)


def _titles(steps: tuple[LocalizationStep, ...], pairs: int) -> list[str]:
    """Titles of the maps; the bars below have none."""
    titles = [""] * (2 * pairs * COLUMNS)
    for i, step in enumerate(steps):
        said = f"step {step.step}" + ("" if step.updated else ", not updated")
        titles[2 * COLUMNS * (i // COLUMNS) + i % COLUMNS] = said
    return titles


def _probability_bars(model: Model, step: LocalizationStep) -> go.Bar:
    colours = {node.id: region_colour(node.region) for node in model.topology.nodes}
    names = [*step.probabilities, "unknown"]
    values = [*step.probabilities.values(), step.unknown]
    shown = [colours.get(name, UNKNOWN_PLACE) for name in names]
    return go.Bar(x=names, y=[round(v, 5) for v in values], marker_color=shown)


def max_probability_figure(drive: LocalizedDrive, method: str) -> go.Figure:
    """Fig. 20: the largest node probability at each step."""
    steps = drive.steps[method]
    values = [step.probabilities[step.best] for step in steps]
    return _over_steps(steps, values, "maximum node probability")


def true_probability_figure(drive: LocalizedDrive, method: str) -> go.Figure:
    """Fig. 25: the probability of the node that the robot is really in; gaps where it is in none."""
    steps = drive.steps[method]
    told = {outcome.t: outcome.true_probability for outcome in drive.judged[method]}
    return _over_steps(steps, [told.get(step.t) for step in steps], "probability of the true node")


def entropy_figure(drive: LocalizedDrive, method: str) -> go.Figure:
    """Figs. 21 and 26: entropy of the node probability, eq. (21)."""
    steps = drive.steps[method]
    return _over_steps(steps, [step.entropy for step in steps], "entropy, eq. (21)")


def _over_steps(
    steps: tuple[LocalizationStep, ...], values: Sequence[float | None], title: str
) -> go.Figure:
    """A value at each step; rejected steps in another colour."""
    shown = [None if v is None else round(v, 5) for v in values]
    bars = [
        go.Bar(
            x=[s.step for s in steps if s.updated is updated],
            y=[v for s, v in zip(steps, shown, strict=True) if s.updated is updated],
            name=name,
            marker_color=colour,
        )
        for updated, name, colour in ((True, "updated", UPDATED), (False, "not updated", REJECTED))
    ]
    layout = LAYOUT | {"showlegend": True, "legend": {"orientation": "h", "y": 1.15}}
    figure = go.Figure(bars).update_layout(
        barmode="overlay", xaxis_title="step", yaxis_title=title, height=330, **layout
    )
    figure.update_xaxes(dtick=1)
    return figure.update_yaxes(range=[0, 1.02])
