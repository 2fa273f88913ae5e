"""Simulated homes, sonar physics and drives: robot logs with ground truth."""

from core.simulation.drive import DriveConfig, simulate
from core.simulation.home import Home
from core.simulation.home_truth import HomeTruth, truth_of
from core.simulation.homes import build_home, home_names
from core.simulation.robot import SimulatedRobot

__all__ = [
    "DriveConfig",
    "Home",
    "HomeTruth",
    "SimulatedRobot",
    "build_home",
    "home_names",
    "simulate",
    "truth_of",
]
