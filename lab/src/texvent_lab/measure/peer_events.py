"""Events of other projects' simulators for the benchmarks, by their own programs.

    texvent bench fidelity --write-frames frames
    python -m texvent_lab.measure.peer_events eventcv frames eventcv-events
    texvent bench fidelity --events eventcv=eventcv-events

Each program runs in an environment that has it (the extra `./lab[peers]`; v2e from a
clone of its repository, `--path CLONE`), as its authors' defaults have it but for the contrast
threshold, and v2e's noise with `--noise-hz`: there is a folder of event files per threshold.
Programs get the frames alone; v2e's network for interpolation, whose weights are not in its
repository, is left out.
"""

from __future__ import annotations

import argparse
import importlib
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.image_folder import ImageFolder
from texvent.errors import InputError, TexventError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame
from texvent.io.atomic import atomic_folder
from texvent.io.input_checks import existing_folder
from texvent.sensor import SensorSize

Columns = tuple[NDArray[Any], NDArray[Any], NDArray[Any], NDArray[Any]]
"""x, y, px; t, µs; p, above 0 for ON."""
Simulate = Callable[[list[Frame], float], Columns]
"""8-bit grey frames and contrast threshold → events."""
LOWEST, RATIO, COUNT = 0.05, 1.2, 12
"""Thresholds: the lowest, each next over the one before, their number."""


def _load_eventcv() -> Simulate:
    eventcv: Any = importlib.import_module("eventcv")

    def simulate(frames: list[Frame], threshold: float) -> Columns:
        pixels = np.stack([frame.pixels for frame in frames])
        times_us = np.array([frame.t_us for frame in frames])
        even_us = np.linspace(0, times_us[-1] - times_us[0], len(frames))
        found = eventcv.simulate(
            pixels, fps=MICROSECONDS / even_us[1], pos_thres=threshold, neg_thres=threshold
        )
        x, y, t, p = np.asarray(found.numpy()).T
        # It knows a rate alone; frames of a camera may come unevenly.
        return x, y, np.interp(t, even_us, times_us), p

    return simulate


def _load_evlib() -> Simulate:
    evlib: Any = importlib.import_module("evlib.simulation")

    def simulate(frames: list[Frame], threshold: float) -> Columns:
        config = evlib.ESIMConfig(
            positive_threshold=threshold, negative_threshold=threshold, device="cpu"
        )
        core = evlib.ESIMSimulator(config)
        parts = [core.process_frame(one.pixels, one.t_us / MICROSECONDS) for one in frames]
        x, y, t, p = (np.concatenate(column) for column in zip(*parts, strict=True))
        return x, y, t * MICROSECONDS, p

    return simulate


NOISY = {"sigma_thres": 0.05, "cutoff_hz": 30.0, "leak_rate_hz": 0.1}
"""Values that v2e's own preset `noisy` sets beside thresholds and its rate of noise."""


def load_v2e(noise_hz: float | None = None) -> Simulate:
    """v2e's pixel model.

    Args:
        noise_hz: events per pixel and second of shot noise, with its preset `noisy`; None: its
            defaults, without shot noise.

    Raises:
        ImportError: it is not installed.
    """
    emulator: Any = importlib.import_module("v2ecore.emulator")
    options = {} if noise_hz is None else {**NOISY, "shot_noise_rate_hz": noise_hz}

    def simulate(frames: list[Frame], threshold: float) -> Columns:
        core = emulator.EventEmulator(
            pos_thres=threshold, neg_thres=threshold, seed=1, device="cpu", **options
        )
        made = [core.generate_events(one.pixels, one.t_us / MICROSECONDS) for one in frames]
        rows = np.concatenate([np.empty((0, 4)), *(part for part in made if part is not None)])
        t, x, y, p = rows.T[:4]
        return x, y, t * MICROSECONDS, p

    return simulate


PROGRAMS: Mapping[str, Callable[[], Simulate]] = {
    "eventcv": _load_eventcv, "evlib": _load_evlib, "v2e": load_v2e
}  # fmt: skip
"""Name → loader, which raises ImportError where the program is not installed."""


def as_events(columns: Columns, size: SensorSize) -> EventStream:
    """The events in the order of their times, in whole µs."""
    x, y, t, p = columns
    t_us = np.rint(t).astype(np.int64)
    order = np.argsort(t_us, kind="stable")
    whole = (one[order].astype(np.int64) for one in (x, y, t_us, p > 0))
    return EventStream.from_columns(*whole, size=size)


def read_frames(clip: Path) -> list[Frame]:
    """The frames of a clip in 8-bit grey, as texvent's simulators see them.

    Raises:
        InputError: they cannot be read, or are fewer than two.
    """
    frames = [replace(one, pixels=np.rint(one.luma).astype(np.uint8)) for one in ImageFolder(clip)]
    if len(frames) < 2:
        raise InputError(f"{clip} has {len(frames)} frames; events need 2")
    return frames


def describe_program(name: str, clone: Path | None) -> dict[str, str]:
    """Name of a program, and its version or the commit of its clone, for its files.

    Raises:
        ImportError: it is not installed, or the folder is no clone.
    """
    if clone is None:
        return {"simulator": name, "version": metadata.version(name)}
    command = ["git", "-C", str(clone), "rev-parse", "HEAD"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ImportError(f"{clone} is no clone of its repository")
    return {"simulator": name, "version": done.stdout.strip()}


def write_events(
    simulate: Simulate, frames: Path, out: Path, *, program: Mapping[str, str], overwrite: bool
) -> None:
    """A folder per threshold with an event file per clip.

    Args:
        simulate: the program.
        frames: folder of `--write-frames`.
        out: folder to write.
        program: facts to store in every file, beside the threshold.
        overwrite: whether a folder of event files may be replaced.

    Raises:
        OutputError: it exists already, or holds other files.
        InputError: there are no frames, or they cannot be read.
    """
    clips = [one for one in sorted(existing_folder(frames).iterdir()) if one.is_dir()]
    if not clips:
        raise InputError(f"{frames} holds no folder of frames; give one of --write-frames")
    with atomic_folder(
        out, overwrite=overwrite, is_own=lambda one: one.suffix == ".h5", is_nested=True
    ) as part:
        for number in range(COUNT):
            threshold = round(LOWEST * RATIO**number, 4)
            (part / str(threshold)).mkdir()
            for clip in clips:
                given = read_frames(clip)
                events = as_events(simulate(given, threshold), given[0].size)
                events = events.with_metadata({**program, "contrast_threshold": threshold})
                events.save(part / str(threshold) / f"{clip.name}.h5")
            print(f"threshold {threshold}: {len(clips)} clips", file=sys.stderr)


def main() -> int:
    """Run a program; 2 where it is not installed or the folders will not do."""
    parser = argparse.ArgumentParser(prog="python -m texvent_lab.measure.peer_events")
    parser.add_argument("program", choices=list(PROGRAMS))
    parser.add_argument("frames", type=Path, help="folder of texvent bench ... --write-frames")
    parser.add_argument("out", type=Path, help="folder to write")
    parser.add_argument("--path", type=Path, help="clone of the program's repository")
    parser.add_argument(
        "--noise-hz", type=float, help="v2e with its preset noisy at this rate of shot noise"
    )
    parser.add_argument("--overwrite", action="store_true")
    chosen = parser.parse_args()
    if chosen.path is not None:
        sys.path.insert(0, str(chosen.path))
    noise_hz: float | None = chosen.noise_hz
    if noise_hz is not None and chosen.program != "v2e":
        parser.error("--noise-hz is for v2e; the others run as their defaults have it")
    try:
        simulate = PROGRAMS[chosen.program]() if noise_hz is None else load_v2e(noise_hz)
        program = describe_program(chosen.program, chosen.path)
        program |= {} if noise_hz is None else {"noise_hz": str(noise_hz)}
    except ImportError as error:
        print(f"error: {chosen.program} cannot be imported here: {error}", file=sys.stderr)
        return 2
    try:
        write_events(
            simulate, chosen.frames, chosen.out, program=program, overwrite=chosen.overwrite
        )
    except TexventError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
