"""Simulated events beside recorded ones: which are compared, and what is said and kept."""

import json
from pathlib import Path

import numpy as np
import pytest

from texvent.cli.app import main
from texvent.events import EventStream
from texvent.metrics.stpp import Stpp
from texvent.sensor import SensorSize
from texvent_lab.alignment.pairs import OTHER, score_pairs
from texvent_lab.alignment.recordings import TextRecording
from texvent_lab.bench.uncertainty import Mean
from texvent_lab.commands.nt_imagenet import pairs_table

from ..nt_imagenet.tiny_data import WNIDS, stream_id, write_n_imagenet

SIZE = SensorSize(32, 24)


def events(seed: int, start: int = 0, count: int = 400, length: int = 50_000) -> EventStream:
    rng = np.random.default_rng(seed)
    t = start + np.sort(np.r_[0, length - 1, rng.integers(0, length, count - 2)])
    return EventStream(
        rng.integers(0, 32, count), rng.integers(0, 24, count), t, rng.integers(0, 2, count), SIZE
    )


def recording(id: str, *parts: EventStream) -> TextRecording:
    whole = EventStream.concat(parts)
    return TextRecording(id, f"text of {id}", lambda: whole, f"key of {id}")


def test_parts_as_long_as_the_stream_are_compared_on_its_clock_and_by_id():
    streams = [recording("a", events(1, 7_000)), recording("b", events(2))]
    # The stream itself, later, four times: whichever evenly spread parts are taken, they are it.
    repeated = [events(1, 50_000 * number) for number in range(4)]
    samples = {"same": [recording("a", *repeated)], "short": [recording("b", events(2, 90))]}
    one, two = score_pairs(samples, streams, [Stpp()])
    assert (one["id"], one["sample"], one["events"]) == ("a", "key of a", 1600)
    assert one["stpp"] == two["stpp"] == 1.0
    assert 0 < one["stpp" + OTHER] < 0.9
    (alone,) = score_pairs({"x": samples["same"]}, streams[:1], [Stpp()])
    assert "stpp" + OTHER not in alone
    nothing = recording("a", EventStream.empty(SIZE))
    (empty,) = score_pairs({"x": [nothing]}, streams, [Stpp()])
    assert empty["stpp"] == 0.0
    # Of four parts some are the stream itself and others not: the score is the mean of all.
    mixed = [recording("a", *repeated[:2], *(events(9, 50_000 * number) for number in (2, 3)))]
    (row,) = score_pairs({"x": mixed}, streams, [Stpp()])
    others = [score_pairs({"x": [recording("a", part)]}, streams, [Stpp()])[0]["stpp"]
              for part in (events(1), events(9))]  # fmt: skip
    assert min(others) + 0.05 < row["stpp"] < max(others) - 0.05


def test_each_sample_is_also_held_to_the_next_stream_of_all():
    parts = [events(seed) for seed in range(4)]
    streams = [recording(name, part) for name, part in zip("abcd", parts, strict=True)]
    samples = [recording(name, parts[(place + 1) % 4]) for place, name in enumerate("abcd")]
    rows = score_pairs({"x": samples[:2], "y": samples[2:]}, streams, [Stpp()])
    assert [row["stpp" + OTHER] for row in rows] == [1.0] * 4


def test_means_over_pairs_have_intervals():
    drift = [{"variant": "v", "stpp": 0.01 * n, f"stpp{OTHER}": 0.0} for n in range(20)]
    low, high = Mean.of([row["stpp"] for row in drift], is_in_sequence=False).interval
    assert f"| v | 20 | 0.0950 [{low:.4f}, {high:.4f}]" in pairs_table(drift, [Stpp()])
    rows = [{"variant": "v", "stpp": 0.1 * n, f"stpp{OTHER}": 0.0} for n in range(7)]
    text = pairs_table(rows, [Stpp()]).splitlines()[2]
    assert text.startswith("| v | 7 | 0.3000 [0.")
    assert text.endswith("| 0.0000 [0.0000, 0.0000] |")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two captions, and events of the first at the recorded streams' size."""
    folder = tmp_path_factory.mktemp("data")
    write_n_imagenet(folder / "N", {WNIDS[0]: {1: 3_000, 2: 3_000}})
    texts = ["a red car drives left", "a dog runs"]
    lines = [json.dumps({"id": stream_id(n), "caption": one}) for n, one in enumerate(texts, 1)]
    (folder / "c.jsonl").write_text("\n".join(lines))
    assert nt(folder, "--captions", str(folder / "c.jsonl"), "--class-count", "1") == 0
    first = (folder / "nt" / "captions.jsonl").read_text().split("\n")[0]
    (folder / "nt" / "one.jsonl").write_text(first)
    specification = (folder / "nt" / "specification.toml").read_text()
    specification = specification.replace("captions.jsonl", "one.jsonl")
    for name, size in (("whole", "640x480"), ("small", "32x24")):
        draft = f'"{size}"\nduration = 0.1\ninterpolate = "none"\nsamples = 1'
        own = specification.replace('"640x480" ', draft)
        (folder / "nt" / f"{name}.toml").write_text(f"filters = {{min_events = 0}}\n{own}")
        words = [str(folder / "nt" / f"{name}.toml"), "-o", str(folder / name), "--workers", "1"]
        assert main(["dataset", "make", *words, "-q"]) == 0
    return folder


def nt(folder: Path, *more: str) -> int:
    words = ["--n-imagenet", str(folder / "N"), "-o", str(folder / "nt"), "-q"]
    return main(["nt-imagenet", *words, *more])


@pytest.mark.long
def test_the_command_scores_a_data_set_and_keeps_every_pair(made, capsys):
    capsys.readouterr()
    assert nt(made, "--events", str(made / "whole")) == 0
    assert "| texvent | 1 |" in capsys.readouterr().out
    kept = json.loads((made / "nt" / "pairs.json").read_text())
    (row,) = kept["pairs"]
    assert row["id"] == stream_id(1)
    assert 0 <= row["stpp"] < 1
    assert kept["controls"] == {}


@pytest.mark.torch
def test_eqs_of_own_weights_is_printed_and_kept_with_its_controls(made, tmp_path, capsys):
    torch = pytest.importorskip("torch")
    from tests.metrics.rvt.rvt_files import trained_here

    torch.save(trained_here((32, 32)), tmp_path / "weights.pt")
    words = ["--events", str(made / "whole"), "--rvt-weights", str(tmp_path / "weights.pt")]
    assert nt(made, *words) == 0
    said = capsys.readouterr().out
    assert "eqs (own RVT), other stream" in said
    assert f"eqs (own RVT) of {stream_id(1)}'s own events: identity 1.0000" in said
    kept = json.loads((made / "nt" / "pairs.json").read_text())
    assert -1 <= kept["pairs"][0]["eqs (own RVT)"] < 1
    assert "noise 30 %" in kept["controls"]["eqs (own RVT)"]


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--events", "{}/small"], "cannot compare a 32x24 sensor with a 640x480 one"),
        (["--events", "{}/N"], "no data set"),
        (["--events", "{}/whole", "--rvt-weights", "{}/c.jsonl"], "cannot be read as network"),
        (
            ["--events", "{}/whole", "--captions", "{}/c.jsonl"],
            "events are scored by the captions in --out",
        ),
        (["--captions", "{}/c.jsonl", "--rvt-weights", "{}/c.jsonl"], "with --events"),
        (["--model", "x"], "with --imagenet"),
        ([], "no captions; give --captions, or --imagenet and --model"),
    ],
)
def test_what_cannot_be_scored_is_said_in_one_line(made, words, complaint, capsys):
    if "network" in complaint:
        pytest.importorskip("torch")
    capsys.readouterr()
    assert nt(made, *(word.format(made) for word in words)) == 2
    said = capsys.readouterr().err
    assert complaint in said
    assert len(said.splitlines()) == 1


def test_captions_of_no_stream_are_named_before_the_streams_are_read(made, tmp_path, capsys):
    text = (made / "c.jsonl").read_text() + '\n{"id": "other", "caption": "x"}'
    (tmp_path / "more.jsonl").write_text(text)
    assert (
        nt(made, "--captions", str(tmp_path / "more.jsonl"), "--classes", str(made / "nope")) == 2
    )
    said = capsys.readouterr().err
    assert "has captions of no stream in" in said
    assert said.index("other") < said.index("cannot read")
