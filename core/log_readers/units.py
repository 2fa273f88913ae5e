"""Units that logs are written in, as factors to SI."""

from __future__ import annotations

import math

LENGTH_UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001}
TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
ANGLE_UNITS = {"rad": 1.0, "deg": math.radians(1), "0.1deg": math.radians(0.1)}
