"""Long work in worker processes: queue, progress, cancel."""
