from pathlib import Path

import numpy as np
import pytest

from texvent.errors import FileFormatError
from texvent.events import EventStream
from texvent.io.files import load, open_events, save
from texvent.sensor import SensorSize


def test_plain_numpy_finds_the_columns(tmp_path: Path) -> None:
    events = EventStream.from_columns([1, 2], [3, 4], [5, 6], [1, 0], size=SensorSize(9, 8))
    with np.load(save(tmp_path / "events.npz", events), allow_pickle=False) as archive:
        assert {name: archive[name].tolist() for name in "xytp"} == {
            "x": [1, 2],
            "y": [3, 4],
            "t": [5, 6],
            "p": [1, 0],
        }
        assert (int(archive["width"]), int(archive["height"])) == (9, 8)
        assert float(archive["timestamp_scale_ms"]) == 0.001


def test_a_single_array_is_not_an_archive(tmp_path: Path) -> None:
    path = tmp_path / "events.npz"
    with path.open("wb") as file:
        np.save(file, np.zeros(3))
    with pytest.raises(FileFormatError, match="single NumPy array"):
        load(path, size=(4, 4))


def test_random_bytes_are_no_archive_and_nobody_advises_to_unpickle_them(tmp_path: Path) -> None:
    path = tmp_path / "random.npz"
    path.write_bytes(bytes(range(7, 200)))
    with pytest.raises(FileFormatError, match="is not a NumPy archive") as caught:
        open_events(path)
    assert "pickle" not in str(caught.value)


def test_older_files_of_n_imagenet_have_longer_names_of_fields(tmp_path: Path) -> None:
    fields = [("x_pos", "<u2"), ("y_pos", "<u2"), ("timestamp", "<i8"), ("polarity", "?")]
    rows = [(3, 4, 10, True), (639, 479, 20, False)]
    np.savez(tmp_path / "old.npz", event_data=np.array(rows, dtype=fields))
    events = load(tmp_path / "old.npz", size=SensorSize(640, 480))
    assert events.x.tolist() == [3, 639]
    assert events.y.tolist() == [4, 479]
    assert events.t.tolist() == [10, 20]
    assert events.p.tolist() == [1, 0]
