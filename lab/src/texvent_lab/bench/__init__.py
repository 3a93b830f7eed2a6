"""Benchmarks of simulators: exact scenes, the self-test of the metrics."""
