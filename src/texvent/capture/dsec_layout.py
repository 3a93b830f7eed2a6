"""Where the files of a DSEC sequence lie, once its archives are unpacked into one folder.

events/left/events.h5          the left event camera, 640x480
events/left/rectify_map.h5     rectify_map f4 [480, 640, 2]: raw pixel → rectified (x, y)
images/left/rectified/*.png    the left frame camera, rectified, another resolution
images/timestamps.txt          µs, on the clock of the events
calibration/cam_to_cam.yaml    intrinsics camRect0, camRect1; extrinsics T_10, R_rect0, R_rect1
"""

from __future__ import annotations

from pathlib import Path

EVENTS = Path("events/left/events.h5")
RECTIFY_MAP = Path("events/left/rectify_map.h5")
PICTURES = Path("images/left/rectified")
TIMESTAMPS = Path("images/timestamps.txt")
CALIBRATION = Path("calibration/cam_to_cam.yaml")


def is_dsec(folder: Path) -> bool:
    """True for the folder of a DSEC sequence."""
    return (folder / PICTURES).is_dir() and (folder / EVENTS).is_file()
