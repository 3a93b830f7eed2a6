"""Metrics of event streams: `compare`, and one file per family."""
