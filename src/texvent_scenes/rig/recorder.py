"""Record a rig into a folder, which appears complete."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from texvent.config import warn_of_idle
from texvent.generation.subjects import Subject
from texvent.io.atomic import atomic_folder, check_output_folder
from texvent.options.values import option_names, with_options
from texvent.runtime.progress import Progress
from texvent.runtime.progress_option import ProgressOption, open_progress
from texvent.settings.resolution import Settings, resolve
from texvent_scenes.rig.config import RigConfig
from texvent_scenes.rig.layouts import bag, dsec, hdf5
from texvent_scenes.rig.layouts.parts import FACTS, Tally, write_facts
from texvent_scenes.rig.recording import prepare_recording

LAYOUTS = {"hdf5": hdf5, "dsec": dsec, "rosbag1": bag, "mcap": bag}
"""Layouts by the name that option `layout` takes: modules with `check`, which refuses rigs that the
layout cannot hold before any work, and `write`, which fills an empty folder."""


def record(
    prompt: Subject,
    out: str | Path,
    *,
    overwrite: bool = False,
    config: str | Path | None = None,
    progress: ProgressOption = None,
    **options: Any,
) -> Path:
    """Events, frames and IMU samples of a rig in the scene that a prompt describes, or in a scene.

    Args:
        prompt: what to show, such as "a red car drives left past two trees, handheld camera"; or a
            `texvent_scenes.Scene`.
        out: folder to write.
        overwrite: whether a folder that a rig was recorded into may be replaced.
        config: a TOML or YAML file with options of the simulation.
        progress: as for `texvent.generate`.
        **options: those of `texvent rig --help`, such as `stereo=0.12`, `imu=1000`, `frames=30`,
            `exposure=0.005`, `layout="rosbag1"`, `simulator="esim"`, `duration=2.0`.

    Returns:
        The folder.

    Raises:
        ConfigError: an unknown option, a value out of range, or a rig that the layout cannot hold.
        InputError: the prompt is not understood, or a file cannot be read.
        OutputError: the folder exists already, or cannot be written.

    Example:
        >>> import texvent
        >>> folder = texvent.rig.record(
        ...     "a red ball bounces", "ball", stereo=0.12, sensor="32x24", duration=0.1
        ... )
        >>> [texvent.load(folder / f"cam{number}/events.h5").size for number in (0, 1)]
        [SensorSize(width=32, height=24), SensorSize(width=32, height=24)]
    """
    names = option_names(RigConfig)
    own = {name: value for name, value in options.items() if name in names and value is not None}
    rest = {name: value for name, value in options.items() if name not in names}
    rig_config = with_options(RigConfig(), own, where="options")
    warn_of_idle([rig_config], own)
    settings = resolve("generate", rest, config=config)
    with open_progress(progress) as shown:
        record_rig(prompt, settings, rig_config, Path(out), overwrite=overwrite, progress=shown)
    return Path(out)


def record_rig(
    prompt: Subject,
    settings: Settings,
    config: RigConfig,
    out: Path,
    *,
    overwrite: bool,
    progress: Progress,
) -> Tally:
    """As `record`, with everything resolved; returns what was written, counted."""
    layout = LAYOUTS[config.layout]
    is_own = _own_files(out)
    check_output_folder(out, overwrite=overwrite, is_own=is_own, is_nested=True)
    recording = prepare_recording(prompt, settings, config, progress=progress)
    layout.check(recording)
    tally = Tally()
    with atomic_folder(out, overwrite=overwrite, is_own=is_own, is_nested=True) as part:
        layout.write(recording, part, tally, progress)
        write_facts(recording, part, tally)
    return tally


def _own_files(out: Path) -> Callable[[Path], bool]:
    """Tells the files of a recording there from others, by its rig.json."""
    try:
        listed = json.loads((out / FACTS).read_text(encoding="utf-8"))["files"]
        own = {str(name) for name in listed}
    except (OSError, ValueError, KeyError, TypeError):
        own = set()
    root = out.resolve()

    def is_own(path: Path) -> bool:
        return str(path.relative_to(root)) in own if path.is_relative_to(root) else False

    return is_own
