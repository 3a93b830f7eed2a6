"""A still image and the options of a camera → frames."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.brightness import check_intensity
from texvent.capture.camera_path.motion import CameraPath, Pan, Saccades, Shake
from texvent.capture.camera_path.photo_frames import PhotoFrames
from texvent.capture.image_folder import coding_facts, count_images, read_image
from texvent.capture.intensity_scale import caller_pixels, scale_to_levels
from texvent.capture.linear_light import (
    FULL_SCALE,
    GAMMA,
    find_coding,
    linear_facts,
    to_light,
)
from texvent.capture.scale_check import check_image_scale
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, InputError, shown
from texvent.frames import MICROSECONDS, Frame
from texvent.options.arrays import is_array_like
from texvent.runtime.files.file_names import IMAGE_EXTENSIONS, usable_path
from texvent.sensor import SensorSize

FPS = Fraction(60)
"""Frames per second, unless asked for: what lies between is exact as well."""
PRESETS = ("saccade", "shake", "pan")
OF_CAMERA = ("camera_amplitude", "duration")
"""Options that only a camera path has."""
OF_VIDEOS = (
    *("timestamps", "start", "stop", "fit"),
    *("motion", "motion_back", "depth", "depth_scale", "instances"),
)
"""Options that a camera path does not have."""


def is_still(path: Path) -> bool:
    """Whether a path is, by its name, a still image."""
    return path.suffix.lower() in IMAGE_EXTENSIONS and path.is_file()


def open_photo(
    source: Any,
    config: CaptureConfig,
    *,
    size: SensorSize | None,
    seed: int,
) -> PhotoFrames:
    """Frames of a camera that moves over an image.

    Args:
        source: path of an image, or an array [H, W] or [H, W, 3] (RGB).
        config: with `camera`.
        size: of the sensor; None: that of the image.
        seed: of the shake.

    Raises:
        InputError: the source is no image.
        FileFormatError: a file is damaged.
        ConfigError: an option does not go with the others, or no path has that name.
    """
    path = _path(config, seed)
    levels, facts = _levels(source, config)
    fps = FPS if config.fps is None else Fraction(config.fps)
    seconds = path.seconds if config.duration is None else config.duration
    intervals = max(1, math.ceil(Fraction(round(seconds * MICROSECONDS), MICROSECONDS) * fps))
    return PhotoFrames(levels, path, fps, intervals, size, facts)


def check_camera_options(config: CaptureConfig, arrays: Mapping[str, Any]) -> None:
    """Refuse options of videos beside `camera`, and those of a camera path without it.

    Args:
        config: options.
        arrays: times and motion in memory, by name.

    Raises:
        ConfigError: there is such an option.
    """
    default = CaptureConfig()
    for name in OF_CAMERA if config.camera is None else OF_VIDEOS:
        if getattr(config, name) == getattr(default, name):
            continue
        if config.camera is None:
            hint = "; `stop` ends a video" if name == "duration" else ""
            reason = f"is for a camera that moves over a still image (`camera`){hint}"
        else:
            hint = "; `duration` says how long it lasts" if name in ("start", "stop") else ""
            reason = f"is for videos, and `camera` makes one of an image{hint}"
        raise ConfigError(f"{name} {reason}; leave {name} out")
    given = next((name for name, one in arrays.items() if one is not None), None)
    if config.camera is not None and given is not None:
        raise ConfigError(
            f"{given} is for videos, and `camera` makes one of an image; leave it out"
        )


def _path(config: CaptureConfig, seed: int) -> CameraPath:
    """The path of that name."""
    camera, amplitude = config.camera, config.camera_amplitude
    if camera == "saccade":
        return Saccades(amplitude)
    if camera == "shake":
        return Shake(amplitude, seed)
    if camera == "pan":
        return Pan(amplitude, config.duration or Pan.seconds)
    raise ConfigError(f"unknown camera {shown(camera)}; {suggest(camera, PRESETS)}")


def _levels(source: Any, config: CaptureConfig) -> tuple[NDArray[np.float32], dict[str, Any]]:
    """Luma of the image, [H, W], and where it comes from."""
    if isinstance(source, str | Path):
        path = usable_path(usable_path(str(source).removeprefix("file://")).expanduser())
        if not path.exists():
            raise InputError(f"no such image: {path}")
        if not is_still(path):
            raise InputError(
                f"{path} is no still image (.png, .jpg, .exr, ...), and `camera` moves a camera "
                "over one; leave `camera` out for a video, or name images one by one or in "
                "texvent batch FOLDER"
            )
        if count_images(path) > 1:
            raise InputError(f"{path} holds several images; leave camera out, or save one of them")
        pixels, where, kind = read_image(path, config.white_level), str(path), "still image"
        coded = coding_facts([path])
    elif is_array_like(source) or hasattr(source, "getbands"):
        pixels, where, kind = caller_pixels(source, "the image of camera"), "the image", "array"
        coded = {}
    else:
        raise InputError(
            f"camera moves a camera over one still image, not over {type(source).__name__}; give "
            "its path or an array [H, W] or [H, W, 3], or leave camera out"
        )
    facts: dict[str, Any] = {"source": where if kind != "array" else "array", "kind": kind}
    facts |= {"pixel_type": str(pixels.dtype), **coded}
    coding, white_level = find_coding(facts, config)
    if coding != GAMMA:
        pixels = to_light(pixels, coding, facts.get(FULL_SCALE), white_level)
        facts |= linear_facts(coding)
    check_intensity(pixels, where)
    if coding == GAMMA and white_level is not None:
        pixels = scale_to_levels(pixels, white_level)
    elif coding == GAMMA:
        check_image_scale(pixels, where)
    return np.asarray(Frame(pixels, 0).luma, dtype=np.float32), facts
