"""Frames in: video files, image folders, arrays, cameras and streams."""
