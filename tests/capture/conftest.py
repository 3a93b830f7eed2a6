"""Small clips, written with PyAV, for the tests of this folder."""

import os
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest
from av.video.reformatter import ColorRange

WIDTH, HEIGHT = 64, 48


class ClipWriter:
    """Writes arrays into video files of any codec, pixel format and timing."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def write(
        self,
        name: str,
        frames: Sequence[np.ndarray],
        *,
        codec: str = "libx264",
        stored: str = "yuv420p",
        given: str = "rgb24",
        times_ms: Sequence[int] | None = None,
        rate: int | Fraction = 25,
        ticks: int | Fraction = 1000,
        first: int = 0,
        is_limited: bool = False,
        rotation: int = 0,
        container: dict[str, str] | None = None,
        options: dict[str, str] | None = None,
    ) -> Path:
        path = self.folder / name
        with av.open(str(path), "w", options=container or {}) as clip:
            stream = clip.add_stream(codec, rate=rate, options=options or {})
            stream.height, stream.width = frames[0].shape[:2]
            stream.pix_fmt = stored
            stream.codec_context.time_base = 1 / Fraction(ticks)
            if is_limited:
                stream.codec_context.color_range = ColorRange.MPEG
            if rotation:
                stream.set_display_rotation(rotation)
            for index, pixels in enumerate(frames):
                frame = av.VideoFrame.from_ndarray(pixels, format=given)
                frame.pts = times_ms[index] if times_ms else ticks // rate * (index + first)
                frame.time_base = 1 / Fraction(ticks)
                clip.mux(stream.encode(frame))
            clip.mux(stream.encode(None))
        if codec == "libsvtav1" and hasattr(os, "sched_setscheduler"):
            # Run by root it gives its caller the highest real-time priority, which every process
            # that starts later has too: a browser of such a priority starves the machine.
            os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
        return path


@pytest.fixture
def clips(tmp_path: Path) -> ClipWriter:
    return ClipWriter(tmp_path)


@pytest.fixture(scope="session")
def noisy_frames() -> list[np.ndarray]:
    """30 frames that compress badly, so that cutting the file cuts frames."""
    rng = np.random.default_rng(1)
    return [rng.integers(0, 256, (HEIGHT, WIDTH, 3), dtype=np.uint8) for _ in range(30)]
