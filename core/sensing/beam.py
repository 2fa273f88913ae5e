"""Sound pressure of a sonar beam (eq. 4)."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.special import j1

from core.geometry import FloatArray

EDGE_ARGUMENT = 2.2150
"""ka sin(theta) at which the directivity (2 J1(x)/x)^2 has fallen to a quarter (-6 dB).

A transducer's data sheet gives its beam angle at -6 dB, so this ties the unknown `ka` of eq. (4) to
the beam width of the ring."""


def wave_number_times_radius(beam_width: float) -> float:
    """`ka` of a piston whose full beam angle (rad, at -6 dB) is `beam_width`."""
    return EDGE_ARGUMENT / math.sin(min(beam_width, math.pi) / 2)


def directivity(theta: npt.ArrayLike, beam_width: float) -> FloatArray:
    """(2 J1(ka sin theta) / (ka sin theta))^2 of eq. (4); 1 on the axis.

    Args:
        theta: angles off the axis, radians.
        beam_width: full beam angle, radians.
    """
    x = np.asarray(wave_number_times_radius(beam_width) * np.sin(np.asarray(theta, float)))
    safe = np.where(np.abs(x) < 1e-9, 1.0, x)
    return np.asarray(np.where(np.abs(x) < 1e-9, 1.0, (2 * j1(safe) / safe) ** 2), float)


def sound_pressure(r: npt.ArrayLike, theta: npt.ArrayLike, beam_width: float) -> FloatArray:
    """P_S(r, theta) of eq. (4) with the constant factor beta f a^4 = 1.

    Args:
        r: distance from the transducer, metres (> 0).
        theta: angle off the axis, radians.
        beam_width: full beam angle, radians.
    """
    return np.asarray(directivity(theta, beam_width) / np.asarray(r, float) ** 2)
