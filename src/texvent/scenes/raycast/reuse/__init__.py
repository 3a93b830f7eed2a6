"""Frames of which only the tiles are drawn that differ from an earlier frame."""
