"""From an occupancy grid to regions."""
