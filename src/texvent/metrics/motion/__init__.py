"""Metrics of motion: contrast maximisation, flow-warp sharpness, structure."""
