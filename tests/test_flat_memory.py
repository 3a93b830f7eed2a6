"""Memory does not grow with the clip: frames, packets and what is being written are let go of."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

FRAMES = 200
ALLOWED = 1.05
"""Peak of twice the clip over peak of the clip. One clip's frames alone would add an eighth."""
ALLOWED_KB = 8_000
"""Growth of a process in 8,000 frames of 64x64 px; kept as they are they would take 33 MB."""
RETURNED = {"MALLOC_ARENA_MAX": "1", "MALLOC_MMAP_THRESHOLD_": "65536"}
"""glibc gives freed arrays back at once; else it keeps up to 60 MB of them, as threads fall."""

SCRIPT = """
import resource, sys
from fractions import Fraction
import numpy as np
from texvent.io.files import save
from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.frames import Frame, frame_time_us

class Long:
    size, fps, is_live, metadata = SensorSize(256, 192), Fraction(25), False, {}
    def __init__(self, count):
        self.frame_count = count
    def __iter__(self):
        rng = np.random.default_rng(0)
        pictures = rng.integers(90, 130, (16, 192, 256), np.uint8)
        for index in range(self.frame_count):
            yield Frame(pictures[index % 16].copy(), frame_time_us(index, self.fps))

interpolate, *runs = sys.argv[1:]
settings = resolve("simulate", {"interpolate": interpolate, "fixed_count": 1})
for path, count in zip(runs[::2], runs[1::2]):
    save(path, video_to_events(Long(int(count)), settings).packets)
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def measured(words):
    return map(int, subprocess.check_output(words, text=True, env=os.environ | RETURNED).split())


@pytest.mark.long
@pytest.mark.parametrize(("extension", "interpolate"), [(".h5", "none"), (".raw", "blend")])
def test_twice_the_clip_takes_no_more_memory(tmp_path, extension, interpolate):
    paths = [str(tmp_path / f"{name}{extension}") for name in ("once", "twice")]
    runs = [paths[0], str(FRAMES), paths[1], str(2 * FRAMES)]
    words = [sys.executable, "-c", SCRIPT, interpolate, *runs]
    # The highest resident memory of the process until the end of each run.
    once, twice = measured(words)
    assert Path(paths[1]).stat().st_size > 250_000
    assert twice <= ALLOWED * once


STREAM = """
from itertools import islice
import numpy as np
from texvent.training import Clip, EventStream

def resident_kb():
    status = open("/proc/self/status").read().splitlines()
    return int(next(line for line in status if line.startswith("VmRSS")).split()[1])

class Films:
    known_truth = ()
    def __len__(self):
        return 8
    def name(self, index):
        return f"film {index}"
    def read(self, index, truth, most_bytes):
        levels = np.random.default_rng(index).integers(90, 130, (60, 80, 100), np.uint8)
        return Clip(levels, np.arange(60) * 40_000)

# Of eight films of half a megabyte three are held in memory, and two on disk.
stream = EventStream(
    Films(), batch=4, frames=25, size=(64, 64), device="cpu", seed=1, memory=1_500_000,
    disk=1_000_000, outputs=("grids", "counts", "surfaces", "events"),
)
for number, batch in enumerate(islice(stream, 100)):
    if number in (20, 99):
        print(resident_kb())
"""


@pytest.mark.torch
@pytest.mark.long
def test_ten_thousand_frames_of_training_take_no_more_memory_than_two_thousand():
    pytest.importorskip("torch")
    words = [sys.executable, "-c", STREAM]
    begun, ended = measured(words)
    assert ended <= begun + ALLOWED_KB
