"""The catalogue against the registry, and real recordings through the frame reader.

Run with `pytest -m network`; about 150 MB are fetched into the data folder, once.
"""

import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.data.catalogue import DATA_SETS
from texvent.data.pull import pull

pytestmark = pytest.mark.network


@pytest.mark.parametrize("name", DATA_SETS)
def test_every_data_set_can_be_pulled(name):
    assert pull(name).exists()


@pytest.mark.parametrize(
    ("name", "size", "frames", "last_us"),
    [
        ("slider_depth", (240, 180), 87, 3_333_822),
        ("bikes", (640, 272), 250, 9_960_000),
        ("carphone", (176, 144), 120, 3_970_633),
        ("bigbuckbunny", (1280, 720), 132, 5_240_000),
        ("mouse250", (396, 406), 994, 3_972_000),
        ("vtest", (768, 576), 795, 79_400_000),
        ("tree", (320, 240), 68, None),
    ],
)
def test_frames_of_real_recordings_are_read_to_the_last(name, size, frames, last_us):
    stream = open_frames(pull(name), CaptureConfig())
    times = [frame.t_us for frame in stream]
    assert (stream.size, len(times)) == (size, frames)
    assert times[0] == 0
    assert np.all(np.diff(times) > 0)
    assert last_us is None or times[-1] == last_us
