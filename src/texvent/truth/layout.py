"""What lies where in a folder of ground truth.

truth.json                    parts, conventions, classes, and what made the run
timestamps.txt                time of each frame, µs, on the clock of the events
flow/forward/000000.png       optical flow to the next frame, DSEC's 16-bit PNG
flow/forward_timestamps.txt   from and to, µs
flow/forward_npz/000000.npz   the same as float32, and what gets hidden
flow/backward...              optical flow to the frame before, likewise
depth/000000.npz              metres along the optical axis, inf for the sky
instance/000000.png           instance of each pixel, 16 bits; class/ its class
boxes/coco.json, bbox.npy     2-D boxes
camera.json, poses.txt, intrinsics.txt
events.npz                    instance and class of each event, row by row
overlay.mp4                   the truth drawn over the frames
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from texvent.io.atomic import check_output_folder

FACTS, TIMES = "truth.json", "timestamps.txt"
FORMAT = "texvent truth 1"
DIRECTIONS = {"flow": "forward", "flow-back": "backward"}
"""Part → how its files are named."""
_OWN = re.compile(
    r"truth\.json|timestamps\.txt|flow/(for|back)ward(_npz)?/\d+\.(png|npz)|"
    r"flow/(for|back)ward_timestamps\.txt|"
    r"depth/\d+\.npz|(instance|class)/\d+\.png|boxes/(coco\.json|bbox\.npy)|camera\.json|"
    r"poses\.txt|intrinsics\.txt|events\.npz|overlay\.mp4"
)


def check_truth_folder(path: Path, *, overwrite: bool) -> None:
    """Refuse a place that truth cannot be put at, before any work.

    Raises:
        OutputError: it exists already, holds other files, or cannot be written.
    """
    check_output_folder(path, overwrite=overwrite, is_own=is_own_file(path), is_nested=True)


def is_own_file(folder: Path) -> Callable[[Path], bool]:
    """Tells whether a file in the folder, or in the one that becomes it, is one of truth."""

    def is_own(path: Path) -> bool:
        return bool(_OWN.fullmatch(path.relative_to(folder.resolve()).as_posix()))

    return is_own


def truth_folder(events: Path) -> Path:
    """Where the truth of an event file lies.

    Example:
        >>> truth_folder(Path("runs/out.h5")).as_posix()
        'runs/out.truth'
    """
    return events.with_name(f"{events.with_suffix('').name}.truth")
