"""`texvent compare` as a user meets it."""

import json

import pytest

from texvent.cli.app import main
from texvent.events import EventStream
from texvent.metrics.controls import CONTROLS
from texvent.sensor import SensorSize


@pytest.fixture
def pair(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "empty"))
    size = SensorSize(16, 10)
    truth = EventStream([1, 2, 3, 4], [0, 0, 5, 6], [100, 200, 40_000, 900_000], [1, 0, 1, 1], size)
    truth.save("truth.npz")
    truth[:2].save("guess.npz")
    return truth


def test_compare_prints_a_table_with_what_each_metric_does_not_see(pair, capsys):
    assert main(["compare", "guess.npz", "truth.npz", "--metrics", "stpp,count_ratio,ef_ssim"]) == 0
    shown = capsys.readouterr().out
    assert "count_ratio" in shown
    assert "0.5000" in shown
    assert "undefined" in shown
    assert "everything but the number of events" in " ".join(shown.split())


def test_compare_judges_the_first_file_by_the_second(pair, capsys):
    assert main(["compare", "guess.npz", "truth.npz", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["predicted"] == {"path": "guess.npz", "events": 2}
    assert document["scores"]["count_ratio"] == 0.5
    assert document["scores"]["ef_ssim"] is None


def test_compare_shows_a_similarity_beside_its_controls(pair, capsys):
    assert main(["compare", "guess.npz", "truth.npz", "--json", "--metrics", "lfs"]) == 0
    controls = json.loads(capsys.readouterr().out)["controls"]["lfs"]
    assert controls["identity"] == 1.0
    assert set(controls) == set(CONTROLS)
    assert main(["compare", "guess.npz", "truth.npz", "--metrics", "lfs,stpp"]) == 0
    shown = capsys.readouterr().out
    assert "lfs, controls" in shown
    assert "split half" in shown
    assert "stpp, controls" not in shown


def test_compare_cuts_to_the_span(pair, capsys):
    words = ["compare", "guess.npz", "truth.npz", "--json", "--time", ",0.01"]
    assert main([*words, "--metrics", "stpp"]) == 0
    assert json.loads(capsys.readouterr().out)["scores"] == {"stpp": 1.0}


def test_several_files_are_judged_beside_each_other(pair, capsys):
    words = ["compare", "guess.npz", "late.npz", "truth.npz", "--metrics", "count_ratio,nearest"]
    EventStream(pair.x, pair.y, pair.t + 1000, pair.p, pair.size).save("late.npz")
    assert main([*words, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    scores = {one["predicted"]["path"]: one["scores"] for one in document["candidates"]}
    assert scores["guess.npz"]["count_ratio"] == 0.5
    assert scores["late.npz"] == {"count_ratio": 1.0, "nearest": 1.0}
    assert main(words) == 0
    assert "guess.npz late.npz" in " ".join(capsys.readouterr().out.split())
