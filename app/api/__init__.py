"""The HTTP API: one thin router per resource."""
