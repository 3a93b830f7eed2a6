"""Metrics for streams of different scenes."""
