"""Layouts that detectors and other networks are trained on: one file each."""
