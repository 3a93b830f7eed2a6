"""Detections on real events against boxes labelled by hand."""
