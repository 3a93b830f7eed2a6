"""Boxes that come with a video: files of labels read, checked, and fitted to the events."""
