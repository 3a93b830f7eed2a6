"""Memory does not grow with the clip, measured in a process of its own."""

import subprocess
import sys

import numpy as np

SCRIPT = """
import resource, sys
from fractions import Fraction
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
peak = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
stream = open_frames(sys.argv[1], CaptureConfig())
for index, frame in enumerate(stream):
    if index == 60:
        before = peak()
print(index + 1, frame.pixels.nbytes, peak() - before)
"""


def test_memory_does_not_grow_with_the_clip(clips):
    frames = [np.full((240, 320, 3), i % 250, np.uint8) for i in range(600)]
    path = clips.write("long.mkv", frames, codec="mpeg4")
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(path)], capture_output=True, check=True, timeout=300
    )
    count, frame_bytes, grown_kib = (int(word) for word in done.stdout.split())
    assert count == 600
    clip_kib = count * frame_bytes // 1024
    assert clip_kib > 130_000
    assert grown_kib < clip_kib // 10
