"""What a layout cannot hold is refused by its numbers, and what it just can is written."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tests.dataset.generation.small_sets import clips_recipe, make
from tests.dataset.layouts.crossing import crossing
from tests.dataset.stored.written_set import write_set
from tests.refusals import Call, Refusal, check_refusal

from texvent.dataset.export import LAYOUTS, export
from texvent.dataset.layouts.checks import check_layout
from texvent.dataset.layouts.driving import write_dsec_events
from texvent.dataset.stored.folder import StoredDataset
from texvent.errors import InputError
from texvent.events import EventStream


def check(layout: str, labels: int = 3, **changes: Any) -> Call:
    """Checks a set of that many classes, whose clips last 10 ms."""
    kind, names = replace(LAYOUTS[layout], **changes), tuple(f"c{one}" for one in range(labels))

    def call(folder: Path) -> None:
        dataset = StoredDataset.open(folder / "set")
        check_layout(replace(dataset, labels=names), kind, layout, "paper")

    return call


def pair(last_us: int) -> EventStream:
    return EventStream.from_columns([0, 1], [0, 1], [0, last_us], [1, 0], size=(256, 240))


def dsec(last_us: int) -> Call:
    return lambda folder: write_dsec_events(folder / "a.h5", pair(last_us), np.array([0, 1]))


def mnist(last_us: int) -> Call:
    sample = crossing(read_events=lambda: pair(last_us))
    return lambda folder: LAYOUTS["n-mnist"].write(sample, folder / "a/b/c/d.bin")


REFUSED: dict[str, Refusal] = {
    "short": (check("timelens", shortest_us=10_001), InputError,
              "timelens has windows of 10001 µs, and sample k012 lasts 10000 µs; make longer clips",
              check("timelens", shortest_us=10_000)),
    "digits": (check("n-mnist", 11), InputError, "n-mnist holds 10 classes, and random has 11;",
               check("n-mnist", 10)),
    "dsec": (dsec(2**32), InputError, "4294967296 µs do not fit into DSEC's times; make shorter",
             dsec(2**32 - 1)),
    "late": (mnist(2**23), InputError, "up to 256x240 and times below 8388608 µs; choose",
             mnist(2**23 - 1)),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_layout_cannot_hold_is_not_begun(name: str, tmp_path: Path) -> None:
    write_set(tmp_path / "set")
    (tmp_path / "a/b/c").mkdir(parents=True)
    check_refusal(REFUSED[name], tmp_path, tmp_path)


@pytest.mark.parametrize("stores", [False, True])
def test_frames_are_those_of_the_video_or_there_are_none(stores: bool, tmp_path: Path) -> None:
    recipe = clips_recipe(tmp_path, clips=1, variants={"esim": {}}, store_videos=stores)
    make(recipe, tmp_path / "set")
    dataset, clip = StoredDataset.open(tmp_path / "set"), tmp_path / "clips" / "0.npy"
    frames = np.load(clip)
    export(dataset, "timelens", tmp_path / "out")
    images = sorted((tmp_path / "out").rglob("images/*.png"))
    read = [cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) for path in images]
    np.testing.assert_array_equal(read, frames)
    np.save(clip, frames[::-1])
    with pytest.raises(InputError, match=r"0\.npy is not the video that the events of \w+ are of"):
        export(dataset, "timelens", tmp_path / "other")
    clip.unlink()
    with pytest.raises(InputError, match=r"made again: its video .*clips/0\.npy is not there$"):
        export(dataset, "timelens", tmp_path / "none")
    assert not list(tmp_path.glob("*/**/.texvent-*"))


@pytest.mark.parametrize("stores", [False, True])
@pytest.mark.parametrize(
    ("state", "is_right"),
    [("own", True), ("gone", False), (None, True), ({"seen": ""}, False), ({"seen": "x"}, False)],
)
def test_frames_are_taken_of_a_video_whose_state_was_stored(
    stores: bool, state: Any, is_right: bool, tmp_path: Path
) -> None:
    recipe = clips_recipe(tmp_path, clips=1, variants={"esim": {}}, store_videos=stores)
    make(recipe, tmp_path / "set")
    (path,) = sorted((tmp_path / "set/esim").glob("*.json"))
    record = json.loads(path.read_text())
    (name,) = record["inputs"]
    if state == "gone":
        record["inputs"] = {}
    elif state != "own":
        record["inputs"][name] = state
    path.write_text(json.dumps(record))
    dataset = StoredDataset.open(tmp_path / "set")
    if is_right:
        export(dataset, "timelens", tmp_path / "out")
        assert [*(tmp_path / "out").rglob("images/*.png")]
    else:
        with pytest.raises(InputError, match="is not the video that the events of"):
            export(dataset, "timelens", tmp_path / "out")
