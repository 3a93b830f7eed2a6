"""Frames in: video files, image folders, arrays, cameras and streams.

`open.open_frames` opens any of them. One file per kind of source makes its frames and their times;
`prepare` then does to every source the same: cut to start and stop, scale to 0..255, fit to the
sensor, check.
"""
