"""Speed of texvent: kernels, whole runs, other programs, start-up.

    python -m texvent_lab.measure.speed [--quick] [--json FILE]

docs/speed.md describes the figures.
"""
