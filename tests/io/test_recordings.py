"""Real recordings of iniVation cameras: read as others read them, converted, and read back.

Run with `pytest -m network`; the archives are fetched into the data folder, once.
"""

import numpy as np
import pytest

from texvent.data.pull import pull
from texvent.io.files import load

pytestmark = pytest.mark.network
# Name, file, sensor, events, ON events.
RECORDINGS = [
    ("davis346", "", (346, 260), 78_830, 41_257),
    ("dvxplorer", "test.aedat4", (320, 240), 111_954, 55_023),
    ("dvxplorer", "data_sample.aedat4", (320, 240), 323_963, 167_949),
]
recordings = pytest.mark.parametrize(("name", "file", "size", "count", "on"), RECORDINGS)


@recordings
def test_aedat_reads_the_recording_as_we_do(name, file, size, count, on):
    aedat = pytest.importorskip("aedat", reason="the reader `aedat` is not installed")
    path = pull(name) / file if file else pull(name)
    ours = load(path)
    assert (tuple(ours.size), len(ours), int(ours.p.sum())) == (size, count, on)
    packets = aedat.Decoder(str(path))
    theirs = np.concatenate([packet["events"] for packet in packets if "events" in packet])
    for mine, other in (("x", "x"), ("y", "y"), ("t", "t"), ("p", "on")):
        np.testing.assert_array_equal(getattr(ours, mine), theirs[other].astype(np.int64))
