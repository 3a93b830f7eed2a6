"""`texvent compare` as a user meets it."""

import json

import numpy as np
import pytest
from tests.cli.running import refused

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


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["compare", "guess.npz"], "guess.npz is the only file; give one or several to judge"),
        (["compare", "nothing.npz", "truth.npz"], "no such file: nothing.npz"),
        (["compare", "guess.npz", "truth.npz", "--metrics", "spp"], "did you mean 'stpp'"),
        (
            ["compare", "guess.npz", "truth.npz", "--time", "2,3"],
            "no file has events in the time 2,3",
        ),
        (
            ["compare", "guess.npz", "truth.npz", "--metrics", "ef_lpips"],
            "texvent weights pull lpips",
        ),
        (
            ["compare", "guess.npz", "truth.npz", "--metrics", "eqs"],
            "metric eqs cannot be computed: it needs RVT's weights, pass --rvt-weights FILE",
        ),
        (
            ["compare", "guess.npz", "truth.npz", "--rvt-weights", "none.ckpt"],
            "no weights file none.ckpt",
        ),
    ],
)
def test_mistakes_are_one_clear_line(pair, capsys, words, message):
    assert message in refused(capsys, *words, codes=(2, 3))


@pytest.fixture
def candidates(tmp_path, monkeypatch):
    """A truth of 1.2 s, a candidate that is 1 ms late, and one that is 4 ms late."""
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(0)
    size = SensorSize(16, 10)
    t = np.sort(rng.integers(0, 1_250_000, 6000))
    t[0] = 0
    x, y, p = rng.integers(0, 16, 6000), rng.integers(0, 10, 6000), rng.integers(0, 2, 6000)
    for name, late_us in (("truth", 0), ("near", 1_000), ("far", 4_000)):
        EventStream(x, y, t + late_us, p, size).save(f"{name}.npz")


def test_several_candidates_are_compared_by_windows_in_words(candidates, capsys):
    words = ["compare", "near.npz", "far.npz", "truth.npz", "--metrics", "stpp,nearest"]
    assert main(words) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "near.npz far.npz" in shown
    assert "nearest: near.npz is closer than far.npz by" in shown
    assert "12 windows of 0.1 s" in shown
    assert main([*words, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert [one["predicted"]["path"] for one in document["candidates"]] == ["near.npz", "far.npz"]
    nearest = document["differences"][1]
    assert (nearest["metric"], nearest["closer"]) == ("nearest", "near.npz")
    values = [one["window_means"]["nearest"]["values"] for one in document["candidates"]]
    assert nearest["mean"] == pytest.approx(np.mean(np.subtract(*values)))
    assert nearest["high"] < 0
    assert document["windows"]["starts_us"] == list(range(0, 1_200_000, 100_000))


def test_one_candidate_has_intervals_of_its_window_means(candidates, capsys):
    words = ["compare", "near.npz", "truth.npz", "--metrics", "stpp,ef_ssim"]
    assert main(words) == 0
    table = capsys.readouterr().out
    assert "mean of windows" in table
    assert "undefined" in table
    assert main([*words, "--json", "--window", "0.2"]) == 0
    document = json.loads(capsys.readouterr().out)
    stpp = document["window_means"]["stpp"]
    assert stpp["windows"] == 6
    assert stpp["mean"] == pytest.approx(np.mean(stpp["values"]))
    assert stpp["low"] < stpp["mean"] < stpp["high"]
