"""The topological map and the model that holds it."""

from core.topology.model import Model
from core.topology.topological_map import Edge, Node, Room, TopologicalMap

__all__ = ["Edge", "Model", "Node", "Room", "TopologicalMap"]
