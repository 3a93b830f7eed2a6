"""A small recording of frames and events that several tests of the benchmark share."""

import cv2
import numpy as np
import pytest

from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.video import Video
from texvent_lab.bench.oracle.scenes import ValueNoise

SIZE = SensorSize(64, 48)
FRAMES, STEP_US = 28, 40_000


def pan(t_us):
    y, x = np.arange(SIZE.height, dtype=float), np.arange(SIZE.width, dtype=float)
    return 20 + 200 * ValueNoise(3).sample(x - 150e-6 * t_us, y)


@pytest.fixture(scope="session")
def pan_folder(tmp_path_factory):
    """A recording in the layout of the Event-Camera Dataset: a pan, seen 500 times a second."""
    folder = tmp_path_factory.mktemp("pan")
    (folder / "images").mkdir()
    fine = np.arange(0, FRAMES * STEP_US, 2_000)
    dense = Video(np.stack([pan(t_us) for t_us in fine]).astype(np.float32), fine.tolist())
    options = {"simulator": "esim", "interpolate": "none", "contrast_threshold": 0.25}
    events = video_to_events(dense, resolve("simulate", options)).packets.collect()
    rows = zip(events.t, events.x, events.y, events.p, strict=True)
    lines = (f"{t / 1e6:.6f} {x} {y} {p}" for t, x, y, p in rows)
    (folder / "events.txt").write_text("\n".join(lines) + "\n")
    listing = []
    for number in range(FRAMES):
        name = f"images/frame_{number:08d}.png"
        cv2.imwrite(str(folder / name), np.rint(pan(number * STEP_US)).astype(np.uint8))
        # Stamped 5 ms early, as a camera that names the start of its exposure.
        listing.append(f"{number * STEP_US / 1e6 - 0.005:.6f} {name}")
    (folder / "images.txt").write_text("\n".join(listing[1:]) + "\n")
    return folder
