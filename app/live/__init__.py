"""Live sessions: a robot streams scans; they are kept before they are confirmed, and a model grows."""
