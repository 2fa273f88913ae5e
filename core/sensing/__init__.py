"""What the robot senses: sonar ring, scans, odometry, and the log that holds them."""

from core.sensing.ring import RING_PRESETS, Sonar, SonarRing
from core.sensing.robot_log import RobotLog, Scan
from core.sensing.trajectory import Trajectory

__all__ = ["RING_PRESETS", "RobotLog", "Scan", "Sonar", "SonarRing", "Trajectory"]
