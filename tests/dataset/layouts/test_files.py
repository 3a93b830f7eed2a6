"""Files of the layouts, read by the rules of their readers with NumPy and h5py alone."""

from pathlib import Path

import cv2
import h5py
import numpy as np
import pytest
import yaml
from tests.dataset.conftest import assert_same
from tests.dataset.layouts.crossing import INSTANTS, SIZE, crossing, crossing_boxes, crossing_events
from tests.dataset.layouts.readers import READERS

from texvent.dataset.export import LAYOUTS
from texvent.dataset.layouts.rvt import REPRESENTATION
from texvent.errors import InputError, OutputError
from texvent.events import EventStream
from texvent.view.drawing.event_image import frame_image


@pytest.mark.parametrize("name", [name for name, one in LAYOUTS.items() if one.has_boxes])
def test_a_sample_of_a_later_clock_is_the_same_sample_later(tmp_path: Path, name: str) -> None:
    later, layout = 3_000_000, LAYOUTS[name]
    boxes, events = crossing_boxes(), crossing_events()
    boxes["t"] += later
    moved = EventStream.from_columns(events.x, events.y, events.t + later, events.p, size=SIZE)
    facts = {"start_us": later, "stop_us": later + 240_000, "instants_us": INSTANTS + later}
    found = []
    for folder, sample in (
        (tmp_path / "first", crossing()),
        (tmp_path / "later", crossing(boxes=boxes, read_events=lambda: moved, **facts)),
    ):
        place = layout.place.format(split="train", folder="train", key="abc")
        (folder / place).parent.mkdir(parents=True)
        assert layout.write(sample, folder / place)
        layout.finish(folder, [sample], ("car", "man"))
        ((_, read),) = READERS[name](folder)
        found.append(read)
    first, second = found
    if first.events is not None:
        assert_same({**second.events, "t": second.events["t"].astype(np.int64) - later}, events)
    if first.boxes is not None:
        assert [(t + later, *box) for t, *box in first.boxes] == [tuple(b) for b in second.boxes]
    if first.pictures is not None:
        one, other = ([(*ends, lit.tolist()) for *ends, lit in read.pictures] for read in found)
        assert [(start + later, stop + later, lit) for start, stop, lit in one] == other


def test_rvt_holds_what_its_loader_asserts(tmp_path: Path) -> None:
    sample, out = crossing(), tmp_path / "abc"
    assert LAYOUTS["rvt"].write(sample, out)
    with np.load(out / "labels_v2/labels.npz") as stored:
        labels, starts = stored["labels"], stored["objframe_idx_2_label_idx"]
    place = out / "event_representations_v2" / REPRESENTATION
    ends, windows = (
        np.load(place / "timestamps_us.npy"),
        np.load(place / "objframe_idx_2_repr_idx.npy"),
    )
    assert ends.tolist() == [50_000, 100_000, 150_000, 200_000]
    assert ends[windows].tolist() == np.load(out / "labels_v2/timestamps_us.npy").tolist()
    assert (starts.dtype, windows.dtype) == (np.int64, np.int64)
    assert len(starts) == len(np.unique(labels["t"])) == len(windows) == 4
    assert (np.diff([*starts, len(labels)]) > 0).all()
    found = labels[["t", "x", "w", "class_id", "track_id"]].tolist()
    assert found[:2] == [(50_000, 1, 20, 0, 7), (100_000, 6, 20, 0, 7)]
    assert found[2:4] == [(150_000, 11, 20, 0, 7), (150_000, 40, 8, 1, 9)]
    # At the edge, the last pixels are the end; less than 5 px are no box.
    edge = crossing_boxes()
    edge["x"], edge["w"] = np.where(edge["track_id"] == 7, 50, 59), 40
    LAYOUTS["rvt"].write(crossing(boxes=edge), tmp_path / "edge")
    with np.load(tmp_path / "edge/labels_v2/labels.npz") as stored:
        assert set(stored["labels"][["x", "w", "track_id"]].tolist()) == {(50, 13, 7)}
    events = crossing_events()
    with h5py.File(place / "event_representations.h5") as file:
        assert file["data"].dtype == np.uint8
        assert file["data"].shape == (4, 20, *SIZE.shape)
        second = file["data"][1]
    # Both ends of a window count; bins are those of its first to its last event.
    counts = np.zeros((2, 10, *SIZE.shape), int)
    inside = (events.t >= 50_000) & (events.t <= 100_000)
    first, last = events.t[inside][[0, -1]].tolist()
    columns = (getattr(events, name)[inside].tolist() for name in "xytp")
    for x, y, t, p in zip(*columns, strict=True):
        counts[p, min(9, 10 * (t - first) // (last - first)), y, x] += 1
    assert counts.max() > 10
    np.testing.assert_array_equal(second, np.minimum(counts, 10).reshape(20, *SIZE.shape))


def test_rvt_leaves_out_what_has_no_box_and_leaves_nothing_half_written(tmp_path: Path) -> None:
    nothing = crossing_boxes()[:0]
    assert not LAYOUTS["rvt"].write(crossing(boxes=nothing), tmp_path / "a")
    with pytest.raises(OutputError, match="does not exist; create it"):
        LAYOUTS["rvt"].write(crossing(), tmp_path / "no" / "such")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("start_us", [0, 30_000])
@pytest.mark.parametrize("length_us", [49_999, 50_000, 99_999, 100_000, 100_001])
@pytest.mark.parametrize("name", ["rvt", "coco"])
def test_windows_are_all_that_fit(tmp_path: Path, name: str, length_us: int, start_us: int) -> None:
    boxes = crossing_boxes()[:3]
    boxes["t"] = instants = start_us + np.array([0, 49_999, length_us])
    times = {"start_us": start_us, "stop_us": start_us + length_us, "instants_us": instants}
    sample, place = crossing(boxes=boxes, **times), tmp_path / "train/abc"
    place.parent.mkdir()
    count = length_us // 50_000
    if name == "rvt" and not count:
        with pytest.raises(InputError, match="49999 µs of events are shorter than a window of 500"):
            LAYOUTS[name].write(sample, place)
        return
    LAYOUTS[name].write(sample, place)
    LAYOUTS[name].finish(tmp_path, [sample], ("car", "man"))
    pictures = [one for _, read in READERS[name](tmp_path) for one in read.pictures]
    ends = [start_us + 50_000 * number for number in range(1, count + 1)]
    expected = ends if name == "rvt" else [start_us + length_us - 1] * bool(count)
    assert [last for _, last, _ in pictures] == expected


@pytest.mark.parametrize("name", ["rvt", "coco"])
def test_a_picture_shows_the_events_up_to_its_last_microsecond(tmp_path: Path, name: str) -> None:
    """Each event is at a pixel of its own."""
    edges = [t_us + by for t_us in INSTANTS.tolist() for by in (-1, 0, 1)]
    x, y = np.arange(len(edges)) % SIZE.width, np.arange(len(edges)) // SIZE.width
    events = EventStream(x, y, edges, [1] * len(edges), SIZE)
    place = tmp_path / "train/abc"
    place.parent.mkdir()
    sample = crossing(read_events=lambda: events)
    LAYOUTS[name].write(sample, place)
    LAYOUTS[name].finish(tmp_path, [sample], ("car", "man"))
    ((_, read),) = READERS[name](tmp_path)
    assert read.pictures
    for first_us, last_us, lit in read.pictures:
        shown = (events.t >= first_us) & (events.t <= last_us)
        assert np.argwhere(lit)[:, ::-1].tolist() == np.stack([x, y], axis=1)[shown].tolist()


def test_dsec_det_begins_its_index_at_the_first_image_before_any_event(tmp_path: Path) -> None:
    sample = crossing()
    events = sample.read_events().between(3_000, 200_000)
    (tmp_path / "train").mkdir()
    LAYOUTS["dsec-det"].write(crossing(read_events=lambda: events), tmp_path / "train/abc")
    LAYOUTS["dsec-det"].finish(tmp_path, [sample], ())
    ((_, read),) = READERS["dsec-det"](tmp_path)
    assert_same(read.events, events)
    tracks = np.load(tmp_path / "train/abc/object_detections/left/tracks.npy")
    assert tracks.dtype.names == (*"txyhw", "class_id", "class_confidence", "track_id")
    np.testing.assert_array_equal(tracks["h"], sample.boxes["h"])


def test_dsec_det_names_the_sequences_of_splits_that_share_a_folder(tmp_path: Path) -> None:
    samples = [crossing(key=key, split=split) for key, split in (("a", "train"), ("b", "val"))]
    LAYOUTS["dsec-det"].finish(tmp_path, samples, ())
    found = yaml.safe_load((tmp_path / "train_val_test_split.yaml").read_text())
    assert found == {"train": ["a"], "val": ["b"]}


def test_timelens_has_the_frames_as_they_are(tmp_path: Path) -> None:
    sample = crossing()
    LAYOUTS["timelens"].write(sample, tmp_path / "abc")
    with sample.read_frames() as frames:
        for index, frame in enumerate(frames):
            picture = cv2.imread(str(tmp_path / f"abc/images/{index:06d}.png"))[..., ::-1]
            np.testing.assert_array_equal(picture, frame_image(frame))
