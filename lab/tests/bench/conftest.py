"""A small recording of frames and events that several tests of the benchmark share."""

import numpy as np
import pytest

from texvent.frames import Video
from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent_lab.bench.oracle.scenes import ValueNoise
from texvent_lab.frame_recordings import FrameRecording

from .reconstruction.synthetic_network import write_recording

SIZE = SensorSize(64, 48)
FRAMES, STEP_US = 28, 40_000


def pan(t_us):
    y, x = np.arange(SIZE.height, dtype=float), np.arange(SIZE.width, dtype=float)
    return 20 + 200 * ValueNoise(3).sample(x - 150e-6 * t_us, y)


@pytest.fixture(scope="session")
def pan_folder(tmp_path_factory):
    """A recording in the layout of the Event-Camera Dataset: a pan, seen 500 times a second."""
    fine = np.arange(0, FRAMES * STEP_US, 2_000)
    dense = Video(np.stack([pan(t_us) for t_us in fine]).astype(np.float32), fine.tolist())
    options = {"simulator": "esim", "interpolate": "none", "contrast_threshold": 0.25}
    events = video_to_events(dense, resolve("simulate", options)).packets
    times_us = range(STEP_US, FRAMES * STEP_US, STEP_US)
    # Stamped 5 ms early, as a camera that names the start of its exposure.
    frames = Video(np.stack([pan(t_us) for t_us in times_us]), [t_us - 5_000 for t_us in times_us])
    return write_recording(
        tmp_path_factory.mktemp("pan"), FrameRecording(name="pan", frames=frames, events=events)
    )
