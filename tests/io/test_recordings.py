"""Real recordings of iniVation and Prophesee cameras: read as others read them.

Run with `pytest -m network`; the archives are fetched into the data folder, once.
"""

from pathlib import Path

import numpy as np
import pytest

from texvent.data.pull import pull
from texvent.errors import InputError
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


FIRST_TIME_HIGH_US = 0xAAE << 12
"""First word of evt3.raw."""
SHIFT_US = FIRST_TIME_HIGH_US - 4096
"""What the maker's software subtracts from EVT3 times: the value before the first TIME_HIGH."""


def test_the_same_recording_in_evt3_and_dat_is_equal_event_by_event() -> None:
    raw, dat = load(pull("evk4") / "evt3.raw"), load(pull("evk4") / "gen4.dat")
    assert len(raw) == len(dat) == 1_218_618
    assert tuple(raw.size) == tuple(dat.size) == (1280, 720)
    for name in "xyp":
        np.testing.assert_array_equal(getattr(raw, name), getattr(dat, name))
    np.testing.assert_array_equal(raw.t, dat.t + SHIFT_US)
    assert raw.metadata["header"]["plugin_name"] == "hal_plugin_imx636_evk4"


def test_an_old_evt2_recording_without_size_is_read() -> None:
    with pytest.raises(InputError, match="does not store the sensor size"):
        load(pull("gen3"))
    events = load(pull("gen3"), size=(640, 480))
    assert len(events) == 521_252
    assert int(events.t[-1] - events.t[0]) == 95_871


def test_evt3_and_eventcv_read_the_recording_as_we_do(tmp_path: Path) -> None:
    evt3 = pytest.importorskip("evt3", reason="evt3 has no wheel for this machine")
    eventcv = pytest.importorskip("eventcv", reason="eventcv has no wheel for this machine")
    path = pull("evk4") / "evt3.raw"
    ours = load(path)
    theirs = evt3.decode_file(str(path))
    table = eventcv.load(str(path)).numpy()
    for index, name in enumerate("xytp"):
        np.testing.assert_array_equal(np.asarray(getattr(theirs, name)), getattr(ours, name))
        np.testing.assert_array_equal(table[:, index], getattr(ours, name))
