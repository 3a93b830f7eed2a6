"""Layouts of a recorded rig."""
