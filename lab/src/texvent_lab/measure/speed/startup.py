"""What a user waits for before anything happens: help, and the first events of a file."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent.sensor import SensorSize
from texvent_lab.measure.speed.scenes import embedded_heavy_clip, write_video
from texvent_lab.measure.speed.timing import Quartiles, rounded

CLIP_SIZE = SensorSize(640, 360)
CLIP_FPS = Fraction(25)
CLIP_FRAMES = 50
"""Two seconds."""
WATCHED_RUN = """
import os, sys, time
from texvent.cli.app import main
from texvent.io.hdf5.storage import Hdf5Writer
append = Hdf5Writer.append
def watched(self, packet):
    append(self, packet)
    if len(packet):
        os.write(1, str(time.time() - float(sys.argv[1])).encode())
        os._exit(0)
Hdf5Writer.append = watched
main(["simulate", *sys.argv[2:], "-q", "--events-only"])
"""
"""Prints the time since launch, s, at which the first events reach the file, and stops there."""


def measure_startup(*, quick: bool) -> dict[str, Any]:
    """Times from launch, s."""
    repeats = 3 if quick else 9
    report: dict[str, Any] = {
        f"{name}_cpu_s": Quartiles.of([_cpu_seconds(words) for _ in range(repeats)]).as_json()
        for name, words in {
            "help": ("--help",),
            "generate_help": ("generate", "--help"),
            "simulate_help": ("simulate", "--help"),
        }.items()
    }
    with tempfile.TemporaryDirectory() as folder:
        clip = Path(folder) / "two seconds.mp4"
        frames = embedded_heavy_clip(CLIP_SIZE, CLIP_FRAMES).pixels
        write_video(clip, list(frames), CLIP_FPS)
        warm = [_first_events(clip, folder) for _ in range(repeats + 1)][1:]
        report["first_events_s"] = Quartiles.of(warm).as_json()
        nothing_compiled = {"NUMBA_CACHE_DIR": f"{folder}/empty"}
        report["cold_first_events_s"] = rounded(_first_events(clip, folder, nothing_compiled))
    return report


def _cpu_seconds(words: Sequence[str]) -> float:
    """CPU time of one `texvent` command, user and system, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "texvent.cli.app", *words]
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _first_events(clip: Path, folder: str, environment: dict[str, str] | None = None) -> float:
    """Seconds from launch to the first events handed to the file."""
    command = [sys.executable, "-c", WATCHED_RUN, str(time.time()), str(clip)]
    done = subprocess.run(
        [*command, "-o", f"{folder}/out.h5", "--overwrite"],
        env={**os.environ, **(environment or {})},
        capture_output=True,
        text=True,
        check=True,
    )
    return float(done.stdout)
