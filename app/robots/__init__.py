"""Simulated robots for people who have none: each drives in a process of its own and feeds the live API."""
