"""HDF5 of event_utils: what its own reader asks for, with frames and without."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.files import load
from texvent.io.hdf5.event_utils import save_with_frames
from texvent.sensor import SensorSize

EVENTS = EventStream.from_columns(
    [3, 4, 5], [1, 2, 0], [70, 80, 2_000_000], [1, 0, 1], size=SensorSize(9, 3)
)


def test_events_and_frames_are_in_one_file(tmp_path: Path) -> None:
    path = tmp_path / "e.h5"
    colour = np.zeros((3, 9, 3), np.uint8)
    colour[..., 0] = 200
    images = [(75, np.full((3, 9), 7, np.uint8)), (80, colour)]
    assert save_with_frames(path, EventPackets([EVENTS], EVENTS.size), images) == 2
    with h5py.File(path) as file:
        assert file["events/ts"][()].tolist() == [70e-6, 80e-6, 2.0]
        assert file["events/ps"].dtype == bool
        facts = {
            name: file.attrs[name] for name in ("num_events", "num_pos", "num_neg", "num_imgs")
        }
        assert facts == {"num_events": 3, "num_pos": 2, "num_neg": 1, "num_imgs": 2}
        assert file.attrs["sensor_resolution"].tolist() == [3, 9]
        assert (file.attrs["t0"], file.attrs["tk"]) == (70e-6, 2.0)
        first, second = file["images/image000000000"], file["images/image000000001"]
        assert (first.attrs["timestamp"], first.attrs["event_idx"]) == (75e-6, 1)
        assert second.attrs["event_idx"] == 1, "an event at the time of the frame comes after it"
        assert second[0, 0].tolist() == [0, 0, 200], "BGR"
    assert load(path).equals(EVENTS)


def test_a_frame_of_another_sensor_leaves_no_file(tmp_path: Path) -> None:
    images = [(75, np.zeros((4, 9), np.uint8))]
    with pytest.raises(InputError, match="frame 0 is 9x4, the events are 9x3"):
        save_with_frames(tmp_path / "e.h5", EventPackets([EVENTS], EVENTS.size), images)
    assert not list(tmp_path.iterdir())
