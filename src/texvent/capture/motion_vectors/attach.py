"""Frames with the motion vectors, depth and ids that their renderer gave."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.capture.image_folder import INNER_FOLDERS
from texvent.capture.motion_vectors.fields import ROLE_KIND, open_fields, written_by
from texvent.capture.motion_vectors.frames import MotionFrames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.video import FrameStream

OWN_FOLDER = "motion"
"""Folder of passes beside the folder of frames, as the script for Blender makes it."""

TRUTH_MARK = "truth.json"
"""In every folder that `--truth` makes."""
TRUTH_PARTS = {
    "motion": "flow/forward_npz",
    "motion_back": "flow/backward_npz",
    "depth": "depth",
    "instances": "instance",
}
"""Option → part of such a folder."""


def attach_motion(
    stream: FrameStream, config: CaptureConfig, given: Mapping[str, Any] | None = None
) -> FrameStream:
    """The stream with the fields of files and of memory in `Frame.motion`.

    Args:
        stream: frames as they come, not cut or fitted yet.
        config: its options motion, motion_back, depth, instances, motion_convention, depth_scale
            and check_motion.
        given: the same by name, as arrays or paths; they replace those of `config`.

    Returns:
        `stream` itself where nothing is named.

    Raises:
        InputError: there is no such file, its size or number does not fit the frames, the stream
            is live, or another convention fits the frames clearly better.
        FileFormatError: a file is damaged.
        ConfigError: the convention is unknown.
    """
    sources = {role: getattr(config, role) for role in ROLE_KIND}
    sources.update({role: one for role, one in (given or {}).items() if one is not None})
    sources = {role: one for role, one in sources.items() if one is not None}
    if not sources:
        return stream
    if stream.is_live:
        raise InputError("motion vectors need frames that can be read twice, not a live stream")
    sources = _of_truth(sources)
    stacks = {role: open_fields(one, role) for role, one in sources.items()}
    motion = MotionFrames(stream, stacks, config)
    if config.check_motion:
        motion.check()
    return motion


def _of_truth(sources: Mapping[str, Any]) -> dict[str, Any]:
    """The sources, where `motion` is a folder of `--truth`, by the parts that it holds."""
    folder = sources.get("motion")
    try:
        is_truth = isinstance(folder, str | Path) and (Path(folder) / TRUTH_MARK).is_file()
    except (OSError, ValueError):  # no path
        is_truth = False
    if folder is None or not is_truth:
        return dict(sources)
    held = {role: Path(folder) / part for role, part in TRUTH_PARTS.items()}
    if not held["motion"].is_dir():
        raise InputError(f"{folder} holds truth, but no flow; make it with --truth flow,flow-back")
    return {role: part for role, part in held.items() if part.is_dir()} | {
        role: one for role, one in sources.items() if role != "motion"
    }


def find_motion_sidecar(source: Any) -> Path | None:
    """Motion passes beside or inside a folder of frames, or None.

    They are OpenEXR files in a folder `motion` beside its folder of images, or its own OpenEXR
    files: their channels have names, so nothing is guessed.
    """
    if not isinstance(source, str | Path):
        return None
    try:
        folder = Path(source).expanduser()
        if not folder.is_dir():
            return None
        has_images = any((folder / name).is_dir() for name in INNER_FOLDERS)
        if has_images and any((folder / OWN_FOLDER).glob("*.exr")):
            return folder / OWN_FOLDER
        images = sorted(folder.glob("*.exr"))
    except (OSError, ValueError, RuntimeError):  # no path, or the home of an unknown user
        return None
    if not images:
        return None
    return folder if written_by(images[0]) else None
