"""Memory does not grow with the clip: frames, packets and what is being written are let go of."""

import subprocess
import sys

import pytest

FRAMES = 800
ALLOWED = 1.05
"""Peak of twice the clip over peak of the clip. One clip's frames alone would add a quarter."""

SCRIPT = """
import resource, sys
from fractions import Fraction
import numpy as np
from texvent.io.files import save
from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.video import Frame, frame_time_us

class Long:
    size, fps, is_live, metadata = SensorSize(256, 192), Fraction(25), False, {}
    def __init__(self, count):
        self.frame_count = count
    def __iter__(self):
        rng = np.random.default_rng(0)
        pictures = rng.integers(90, 130, (16, 192, 256), np.uint8)
        for index in range(self.frame_count):
            yield Frame(pictures[index % 16].copy(), frame_time_us(index, self.fps))

path, count, interpolate = sys.argv[1], int(sys.argv[2]), sys.argv[3]
settings = resolve("simulate", {"interpolate": interpolate, "fixed_count": 1})
save(path, video_to_events(Long(count), settings).packets)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def peak(path, count, interpolate):
    """Highest resident memory of a process that simulates so many frames into a file."""
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(path), str(count), interpolate],
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    )
    return int(done.stdout)


@pytest.mark.parametrize(("extension", "interpolate"), [(".h5", "none"), (".raw", "blend")])
def test_twice_the_clip_takes_no_more_memory(tmp_path, extension, interpolate):
    once = peak(tmp_path / f"once{extension}", FRAMES, interpolate)
    twice = peak(tmp_path / f"twice{extension}", 2 * FRAMES, interpolate)
    assert (tmp_path / f"twice{extension}").stat().st_size > 1_000_000
    assert twice <= ALLOWED * once


TRUTH_SCRIPT = """
import resource, sys
from fractions import Fraction
from pathlib import Path
import numpy as np
from texvent.pipeline import video_to_events
from texvent.run.files import RunFiles, write_run
from texvent.settings.resolution import resolve
from texvent.sensor import SensorSize
from texvent.video import Frame, Motion, frame_time_us

class Long:
    size, fps, is_live, metadata = SensorSize(256, 192), Fraction(25), False, {}
    def __init__(self, count):
        self.frame_count = count
    def __iter__(self):
        rng = np.random.default_rng(0)
        images = rng.integers(90, 130, (16, 192, 256), np.uint8)
        ids = np.ones((192, 256), np.int32)
        for index in range(self.frame_count):
            flow, depth = np.full((192, 256, 2), 0.0, np.float32), np.ones((192, 256), np.float32)
            motion = Motion(flow, depth=depth, instance=ids)
            yield Frame(images[index % 16], frame_time_us(index, self.fps), motion=motion)

path, count = Path(sys.argv[1]), int(sys.argv[2])
settings = resolve("simulate", {"interpolate": "none"})
truth = ("flow", "depth", "ids", "boxes", "events")
run = video_to_events(Long(count), settings)
write_run(run, RunFiles([path], truth=truth), on_step=lambda frame, packet: None)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


@pytest.mark.nightly
def test_truth_of_twice_the_clip_takes_no_more_memory(tmp_path):
    peaks = []
    for count in (100, 200):
        words = [str(tmp_path / f"{count}.h5"), str(count)]
        done = subprocess.run(
            [sys.executable, "-c", TRUTH_SCRIPT, *words],
            capture_output=True,
            text=True,
            check=True,
            timeout=300,
        )
        peaks.append(int(done.stdout))
    assert peaks[1] <= ALLOWED * peaks[0]
