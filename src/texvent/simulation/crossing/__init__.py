"""Threshold crossings that several pixel models share: ramps and trigger levels."""
