"""From bytes to a robot log, one format a file."""
