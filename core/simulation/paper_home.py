"""A home like the paper's (Sect. 5): 11.4 m x 8.7 m, three rooms with doors, a kitchen, and a living
room with a sofa and a table in its middle. The plan itself is our own; the paper prints no measures."""

from __future__ import annotations

from core.simulation.floor_plan import Box, Opening, Room
from core.simulation.furniture import numbered, piece
from core.simulation.home import Home, make_doors

ROOMS = (
    Room("bedroom", "bedroom", (Box(0.0, 5.1, 3.7, 8.7),)),
    Room("study", "study", (Box(0.0, 0.0, 3.7, 3.6),)),
    Room("hall", "corridor", (Box(0.0, 3.6, 3.7, 5.1),)),
    Room("living room", "living room", (Box(3.7, 0.0, 7.9, 8.7), Box(7.9, 3.6, 11.4, 5.3))),
    Room("child's room", "bedroom", (Box(7.9, 5.3, 11.4, 8.7),)),
    Room("kitchen", "kitchen", (Box(7.9, 0.0, 11.4, 3.6),)),
)
OPENINGS = (
    Opening(("bedroom", "hall"), 0.85, 0.8),
    Opening(("study", "hall"), 0.85, 0.6),
    Opening(("hall", "living room"), 1.1, 0.5),
    Opening(("child's room", "living room"), 0.85, 0.12),
    Opening(("kitchen", "living room"), 1.3, 0.3),
)
FURNITURE = (
    # bedroom
    ("bed", Box(1.35, 6.65, 2.95, 8.6)),
    ("night stand", Box(0.95, 8.2, 1.35, 8.6)),
    ("wardrobe", Box(0.1, 5.15, 0.7, 7.15)),
    # study
    ("desk", Box(0.7, 0.1, 2.1, 0.8)),
    ("chair", Box(1.2, 0.95, 1.65, 1.4)),
    ("bookshelf", Box(0.1, 1.5, 0.45, 3.1)),
    ("chest", Box(3.2, 0.9, 3.65, 2.1)),
    # hall
    ("shoe rack", Box(0.1, 4.72, 1.2, 5.05)),
    # living room: sofa and table in its middle
    ("sofa", Box(4.9, 4.7, 6.8, 5.55)),
    ("coffee table", Box(5.3, 6.2, 6.4, 6.8)),
    ("armchair", Box(4.0, 6.5, 4.7, 7.2)),
    ("tv bench", Box(5.0, 8.2, 6.7, 8.6)),
    ("plant", Box(7.4, 8.15, 7.8, 8.55)),
    ("dining table", Box(5.1, 1.9, 6.5, 2.8)),
    ("chair", Box(5.55, 2.95, 6.0, 3.4)),
    ("sideboard", Box(3.75, 0.5, 4.2, 2.3)),
    ("chest", Box(10.8, 3.75, 11.3, 5.15)),
    # child's room
    ("bed", Box(10.4, 6.6, 11.3, 8.6)),
    ("wardrobe", Box(8.0, 8.0, 9.4, 8.6)),
    ("desk", Box(10.65, 5.4, 11.3, 6.6)),
    # kitchen
    ("counter", Box(8.6, 0.1, 11.3, 0.7)),
    ("counter", Box(10.7, 0.7, 11.3, 2.5)),
    ("fridge", Box(7.95, 0.1, 8.6, 0.75)),
)


def paper_home() -> Home:
    """The home of the paper's experiments."""
    furniture = numbered([piece(kind, box) for kind, box in FURNITURE])
    return Home("paper", ROOMS, make_doors(ROOMS, OPENINGS), furniture)
