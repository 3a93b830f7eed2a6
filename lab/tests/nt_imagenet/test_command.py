"""`texvent nt-imagenet` with captions made elsewhere: to events of our own, and back."""

import csv
import json
from pathlib import Path
from typing import Any

import pytest

from texvent.cli.app import main
from texvent_lab.alignment.recordings import ids_of_clips, list_samples
from texvent_lab.commands import nt_imagenet
from texvent_lab.nt_imagenet.files import read_captioned

from .tiny_data import WNIDS, stream_id, write_images, write_n_imagenet

CAPTIONS = {
    1: "a red car drives left",
    2: "a tench rests on a table",
    3: "a blue bus drives right",
    4: "a red car drives left",
}
"""The last is that of another image of the same class: they must stay apart."""


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    counts = {WNIDS[0]: {1: 3_000, 2: 3_100, 4: 3_400}, WNIDS[1]: {3: 3_300, 5: 3_500}}
    write_n_imagenet(folder / "N_Imagenet", counts)
    lines = [json.dumps({"id": stream_id(n), "caption": one}) for n, one in CAPTIONS.items()]
    (folder / "elsewhere.jsonl").write_text("\n".join([*lines, '{"id": "other", "caption": "x"}']))
    return folder


def nt(data: Path, out: Path, *more: str) -> int:
    words = ["--n-imagenet", str(data / "N_Imagenet"), "--class-count", "2", "-q"]
    words += ["--captions", str(data / "elsewhere.jsonl")]
    return main(["nt-imagenet", *words, "-o", str(out), *more])


@pytest.fixture(scope="module")
def built(data: Path) -> Path:
    # Image 5 has no caption, which is said and costs nothing else.
    assert nt(data, data / "nt") == 1
    return data / "nt"


def report(folder: Path) -> Any:
    return json.loads((folder / "report.json").read_text())


def test_what_is_written_holds_ids_captions_and_counts_alone(built):
    assert {path.name for path in built.iterdir()} == {
        "captions.jsonl",
        "streams.csv",
        "report.json",
        "specification.toml",
    }
    captioned = read_captioned(built / "captions.jsonl")
    assert {one.id: one.caption for one in captioned} == {
        stream_id(number): caption for number, caption in CAPTIONS.items()
    }
    assert len({one.seed for one in captioned}) == 4
    with (built / "streams.csv").open() as file:
        streams = list(csv.DictReader(file))
    assert [int(one["events"]) for one in streams] == [3_000, 3_100, 3_400, 3_300, 3_500]
    assert Path(streams[0]["stream"]) == Path(WNIDS[0], f"{stream_id(1)}.npz")


def test_the_report_counts_problems_and_leaves_nothing_out(built):
    found = report(built)
    assert found["streams"]["incomplete_classes"] == {WNIDS[0]: 3, WNIDS[1]: 2}
    captions = found["captions"]
    assert list(captions["missing"]) == [stream_id(5)]
    assert len(captions["problems"]["length"]) == 4
    assert captions["duplicates"] == [[stream_id(1), stream_id(4)]]
    assert found["left_out"] == []
    assert found["streams"]["image_level"] is None
    assert found["streams"]["median_speed_px_s"] is None  # noise has no edges


def test_the_rows_of_table_10_are_printed_with_the_light_of_the_images(data, tmp_path, capsys):
    for wnid, numbers in ((WNIDS[0], (1, 2, 4)), (WNIDS[1], (3, 5))):
        write_images(tmp_path / "val", numbers, wnid)
    assert nt(data, tmp_path / "nt", "--imagenet", str(tmp_path / "val")) == 1
    said = capsys.readouterr().out
    assert "events per stream: 3,000 to 3,500, median 3,300" in said
    assert "words per caption: 5 to 6, median 5" in said
    assert "streams per class: 2 to 3, median 2" in said
    levels = report(tmp_path / "nt")["streams"]["image_level"]
    assert levels["least"] == pytest.approx(19.5, abs=2)
    assert levels["most"] == pytest.approx(99.5, abs=4)


def test_captions_that_fail_a_check_are_left_out_and_the_others_stay(data, tmp_path):
    assert nt(data, tmp_path / "nt", "--leave-out", "duplicate") == 1
    assert {one.id for one in read_captioned(tmp_path / "nt" / "captions.jsonl")} == {
        stream_id(number) for number in (1, 2, 3)
    }
    assert report(tmp_path / "nt")["left_out"] == [stream_id(4)]


def test_a_model_is_asked_for_the_captions_that_are_missing_alone(data, tmp_path, monkeypatch):
    asked = {}

    def make(images, model, kept, **options):
        asked.update(images)
        return dict.fromkeys(images, "a shark swims"), {}

    monkeypatch.setattr(nt_imagenet, "make_captions", make)
    for wnid, numbers in ((WNIDS[0], (1, 2, 4)), (WNIDS[1], (3, 5))):
        write_images(tmp_path / "val", numbers, wnid)
    words = ("--imagenet", str(tmp_path / "val"), "--model", "any")
    assert nt(data, tmp_path / "nt", *words) == 0
    assert asked.keys() == {stream_id(5)}
    found = {one.id: one.caption for one in read_captioned(tmp_path / "nt" / "captions.jsonl")}
    assert found == {stream_id(n): text for n, text in {**CAPTIONS, 5: "a shark swims"}.items()}


def test_the_same_command_twice_gives_the_same_files_and_keeps_the_specification(
    data, tmp_path, capsys
):
    out = tmp_path / "nt"
    nt(data, out)
    before = {path: path.read_bytes() for path in out.iterdir()}
    said = capsys.readouterr().out
    nt(data, out)
    kept = "specification.toml was there already and is kept\n"
    assert capsys.readouterr().out == said + kept
    assert {path: path.read_bytes() for path in out.iterdir()} == before
    (out / "specification.toml").write_text("mine")
    nt(data, out)
    assert (out / "specification.toml").read_text() == "mine"


@pytest.mark.long
def test_the_captions_become_events_whose_clips_are_known_by_their_ids(built, tmp_path):
    specification = built / "specification.toml"
    small = specification.read_text().replace('"640x480" ', '"32x24"\nduration = 0.1')
    quick = built / "quick.toml"
    small = small.replace("[variants.texvent]", "[variants.texvent]\nseeds = 2")
    quick.write_text(f"repeats = 2\nfilters = {{min_events = 0}}\n{small}")
    events = tmp_path / "events"
    assert main(["dataset", "make", str(quick), "-o", str(events), "--workers", "1", "-q"]) == 0
    quick.unlink()
    captioned = read_captioned(built / "captions.jsonl")
    (samples,) = list_samples(events, ids=ids_of_clips(events, captioned)).values()
    assert len(samples) == 4 * 2 * 2
    assert {(one.id, one.text) for one in samples} == {
        (stream_id(number), caption) for number, caption in CAPTIONS.items()
    }
