"""Section 5 of the paper, run on simulated homes: figures and figures of merit."""
