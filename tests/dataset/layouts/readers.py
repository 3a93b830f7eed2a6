"""Every layout read by the rules of its readers, with NumPy, h5py, OpenCV and JSON alone."""

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import cv2
import h5py
import numpy as np
import yaml
from numpy.lib import recfunctions as structured

Box = tuple[float, ...]
"""t (µs), x, y, w, h (pixels), class from 0, track."""


@dataclass
class Read:
    """What a reader finds of one sample; None where its layout holds none."""

    split: str
    label: str | None = None
    events: dict[str, np.ndarray] | None = None
    boxes: list[Box] | None = None
    pictures: list[tuple[int, int, np.ndarray]] | None = None
    """First and last µs of a picture of events, and which pixels are lit, [H, W]."""


def read_hdf5(folder: Path) -> Iterator[tuple[str, Read]]:
    for path in folder.glob("*/*.h5"):
        with h5py.File(path) as file:
            events = {name: file["events"][name][()] for name in "xytp"}
            label = json.loads(file.attrs["texvent"])["label"]
        yield path.stem, Read(path.parent.name, label, events)


def read_n_imagenet(folder: Path) -> Iterator[tuple[str, Read]]:
    for split in ("train", "val"):
        for path in map(Path, (folder / f"{split}_list.txt").read_text().splitlines()):
            stored = np.load(path)["event_data"]
            assert stored.dtype.names == ("x", "y", "t", "p")
            yield path.stem, Read(split, path.parent.name, {name: stored[name] for name in "xytp"})


def read_n_caltech101(folder: Path) -> Iterator[tuple[str, Read]]:
    for listed in folder.glob("*.txt"):
        for place in listed.read_text().splitlines():
            raw = np.fromfile(folder / place, np.uint8).reshape(-1, 5).astype(np.int64)
            t = (raw[:, 2] & 127) << 16 | raw[:, 3] << 8 | raw[:, 4]
            events = {"x": raw[:, 0], "y": raw[:, 1], "t": t, "p": raw[:, 2] >> 7}
            assert place.startswith("Caltech101/")
            yield Path(place).stem, Read(listed.stem, Path(place).parent.name, events)


def read_n_mnist(folder: Path) -> Iterator[tuple[str, Read]]:
    """As tonic reads both folders; and the same events as SpikingJelly reads them."""
    for name, path, number in _numbered(folder, "NMNIST/T*/*/*.bin", -2):
        raw = np.fromfile(path, np.uint8).reshape(-1, 5).astype(np.int64)
        t = (raw[:, 2] & 127) << 16 | raw[:, 3] << 8 | raw[:, 4]
        events = {"x": raw[:, 0], "y": raw[:, 1], "t": t, "p": raw[:, 2] >> 7}
        split = path.parts[-3].lower()
        _same_in_events_np(folder / "events_np" / split / str(number) / f"{path.stem}.npz", events)
        yield path.stem, Read(split, name, events)


def read_dvs_gesture(folder: Path) -> Iterator[tuple[str, Read]]:
    """As tonic reads folders of users; and the same events as SpikingJelly reads them."""
    for name, path, number in _numbered(folder, "DVSGesture/ibmGesture*/*/*.npy", -1):
        user, key = path.parent.name.split("_", 1)
        assert int(user[4:]) == 0
        rows = np.load(path)
        rows[:, 3] *= 1000
        kind = np.dtype([("x", np.int16), ("y", np.int16), ("p", bool), ("t", np.int64)])
        events = structured.unstructured_to_structured(rows, kind)
        split = path.parts[-3].removeprefix("ibmGesture").lower()
        _same_in_events_np(folder / "events_np" / split / str(number) / f"{key}.npz", events)
        yield key, Read(split, name, events)


def _numbered(folder: Path, pattern: str, place: int) -> Iterator[tuple[str, Path, int]]:
    """Label, path and number of the class, which is a part of the path."""
    numbers = json.loads((folder / "texvent-export.json").read_text())["class_numbers"]
    for path in folder.glob(pattern):
        number = int(Path(path.parts[place]).stem)
        yield next(name for name, one in numbers.items() if one == number), path, number


def _same_in_events_np(path: Path, events: Any) -> None:
    stored = np.load(path)
    for name in "txyp":
        np.testing.assert_array_equal(stored[name], events[name])


def read_prophesee(folder: Path) -> Iterator[tuple[str, Read]]:
    """Bits as in Prophesee's toolbox: x in 14, y in 14, p in 4."""
    for path in folder.glob("*/*_td.dat"):
        with path.open("rb") as file:
            while file.peek(2)[:2] == b"% ":
                file.readline()
            assert file.read(2)[1] == 8
            t, word = np.frombuffer(file.read(), "<u4").reshape(-1, 2).T
        events = {"x": word & 16383, "y": word >> 14 & 16383, "t": t, "p": word >> 28}
        key = path.name.removesuffix("_td.dat")
        boxes = np.load(path.with_name(f"{key}_bbox.npy"))
        yield key, Read(path.parent.name, events=events, boxes=_rows(boxes))


def read_rvt(folder: Path) -> Iterator[tuple[str, Read]]:
    """Windows of 50 ms, both of whose ends count."""
    for path in folder.glob("*/*/event_representations_v2/*/event_representations.h5"):
        ends = np.load(path.with_name("timestamps_us.npy")).tolist()
        with h5py.File(path) as file:
            lit = file["data"][()].any(axis=1)
        pictures = [(end - 50_000, end, one) for end, one in zip(ends, lit, strict=True)]
        sample = path.parents[2]
        yield sample.name, Read(sample.parent.name, pictures=pictures)


def read_dsec_det(folder: Path) -> Iterator[tuple[str, Read]]:
    listed = yaml.safe_load((folder / "train_val_test_split.yaml").read_text())
    for split, keys in listed.items():
        for key in keys:
            sample = folder / ("test" if split == "test" else "train") / key
            times = np.loadtxt(sample / "images/timestamps.txt", np.int64)
            assert len(list((sample / "images/left/distorted").glob("*.png"))) == len(times)
            with h5py.File(sample / "events/left/events.h5") as file:
                index, offset = file["ms_to_idx"][()], int(file["t_offset"][()])
                events = {name: file["events"][name][()] for name in "xytp"}
            kinds = [events[name].dtype.str for name in "xytp"]
            assert (kinds, index.dtype.str) == (["<u2", "<u2", "<u4", "|u1"], "<u8")
            for millisecond, first in enumerate(index):
                assert first == np.count_nonzero(events["t"] < 1000 * millisecond)
            assert 1000 * (len(index) - 1) > times[-1] - offset
            events["t"] = events["t"].astype(np.int64) + offset
            tracks = np.load(sample / "object_detections/left/tracks.npy")
            yield key, Read(split, events=events, boxes=_rows(tracks))


def read_coco(folder: Path) -> Iterator[tuple[str, Read]]:
    """As pycocotools do: boxes by the ids of their images, classes by those of the categories."""
    for path in folder.glob("*/annotations.json"):
        found: dict[str, Read] = {}
        facts = json.loads(path.read_text())
        images = {one["id"]: one for one in facts["images"]}
        assert len(images) == len(facts["images"])
        assert len({one["id"] for one in facts["annotations"]}) == len(facts["annotations"])
        classes = [one["id"] for one in facts["categories"]]
        for one in images.values():
            picture = cv2.imread(str(path.parent / one["file_name"]))
            assert picture.shape == (one["height"], one["width"], 3)
            lit = (picture != 255).any(axis=2)  # of a palette on white
            read = found.setdefault(
                one["file_name"].split("/")[0], Read(path.parent.name, boxes=[], pictures=[])
            )
            read.pictures.append((one["t_us"] - 50_000, one["t_us"] - 1, lit))
        for one in facts["annotations"]:
            image = images[one["image_id"]]
            x, y, w, h = one["bbox"]
            assert one["area"] == w * h
            assert one["iscrowd"] == 0
            number = classes.index(one["category_id"])
            box = (image["t_us"], x, y, w, h, number, one["track_id"])
            found[image["file_name"].split("/")[0]].boxes.append(box)
        yield from found.items()


def read_timelens(folder: Path) -> Iterator[tuple[str, Read]]:
    """The events of file n lie between frames n − 1 and n."""
    for sample in folder.glob("*/*"):
        times = np.loadtxt(sample / "images/timestamp.txt").tolist()
        assert len(list((sample / "images").glob("*.png"))) == len(times)
        parts = [np.load(sample / f"events/{n:06d}.npz") for n in range(1, len(times))]
        for part, (start, stop) in zip(parts, pairwise(times), strict=True):
            assert ((part["t"] >= start) & (part["t"] < stop)).all()
        events = {name: np.concatenate([part[name] for part in parts]) for name in "xytp"}
        yield sample.name, Read(sample.parent.name, events=events)


def _rows(records: np.ndarray) -> list[Box]:
    columns = ("t", "x", "y", "w", "h", "class_id", "track_id")
    return [tuple(float(one[name]) for name in columns) for one in records]


READERS: dict[str, Callable[[Path], Iterator[tuple[str, Any]]]] = {
    "hdf5": read_hdf5,
    "n-imagenet": read_n_imagenet,
    "n-caltech101": read_n_caltech101,
    "n-mnist": read_n_mnist,
    "dvs-gesture": read_dvs_gesture,
    "gen1": read_prophesee,
    "1mpx": read_prophesee,
    "rvt": read_rvt,
    "dsec-det": read_dsec_det,
    "coco": read_coco,
    "timelens": read_timelens,
}
"""Layout → keys of samples and what is read of them."""
