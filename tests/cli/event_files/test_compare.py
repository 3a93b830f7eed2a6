"""`texvent compare` and `texvent bench` as a user meets them."""

import json
from pathlib import Path

import pytest

from texvent.bench.selftest.controls import CONTROLS
from texvent.cli.app import main
from texvent.events import EventStream
from texvent.sensor import SensorSize


@pytest.fixture
def pair(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "empty"))
    size = SensorSize(16, 12)
    truth = EventStream([1, 2, 3, 4], [0, 0, 5, 6], [100, 200, 40_000, 900_000], [1, 0, 1, 1], size)
    truth.save("truth.npz")
    truth[:2].save("guess.npz")
    return truth


def test_compare_prints_a_table_with_what_each_metric_does_not_see(pair, capsys):
    assert main(["compare", "guess.npz", "truth.npz", "--metrics", "stpp,count_ratio,isi"]) == 0
    shown = capsys.readouterr().out
    assert "count_ratio" in shown
    assert "0.5000" in shown
    assert "undefined" in shown
    assert "everything but the number of events" in " ".join(shown.split())


def test_compare_judges_the_first_file_by_the_second(pair, capsys):
    assert main(["compare", "guess.npz", "truth.npz", "--json", "--levels"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["predicted"] == {"path": "guess.npz", "events": 2}
    assert document["scores"]["count_ratio"] == 0.5
    assert document["scores"]["isi"] is None
    assert len(document["stpp_levels"]) == 5


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


def test_compare_writes_a_page_beside_its_table(pair, capsys):
    words = ["compare", "guess.npz", "truth.npz", "--metrics", "stpp,isi", "-o", "both.html"]
    assert main(words) == 0
    page = Path("both.html").read_text("utf-8")
    shown = capsys.readouterr().out
    assert "stpp" in shown
    assert shown.endswith("\nboth.html\n")
    assert main([*words, "--json", "--overwrite"]) == 0
    said = capsys.readouterr()
    assert json.loads(said.out)["scores"]["stpp"] < 1
    assert said.err == "both.html\n"
    for text in ("guess.npz", "truth.npz (reference)", ">stpp<", ">undefined<"):
        assert text in page
    assert main(words) != 0
    assert "exists already" in capsys.readouterr().err
    assert main([*words, "--overwrite", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["scores"]


def test_compare_says_which_metrics_it_left_out_and_why(pair, capsys):
    assert main(["compare", "guess.npz", "truth.npz", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert set(document["left_out"]) == {"ef_lpips", "eqs"}
    assert not set(document["left_out"]) & set(document["scores"])
    assert main(["compare", "guess.npz", "truth.npz"]) == 0
    assert "texvent weights pull lpips" in " ".join(capsys.readouterr().out.split())


def test_text_rows_are_compared_when_the_sensor_is_named(pair, tmp_path, capsys):
    events = zip(pair.t / 1e6, pair.x, pair.y, pair.p, strict=True)
    rows = (f"{t:.6f} {x} {y} {p}\n" for t, x, y, p in events)
    (tmp_path / "truth.txt").write_text("".join(rows))
    assert main(["compare", "truth.txt", "truth.txt"]) != 0
    assert "--sensor" in capsys.readouterr().err
    words = ["--sensor", "16x12", "--metrics", "count_ratio", "--json"]
    assert main(["compare", "guess.npz", "truth.txt", *words]) == 0
    assert json.loads(capsys.readouterr().out)["scores"] == {"count_ratio": 0.5}


def test_a_span_without_events_is_no_perfect_score(pair, capsys):
    assert main(["compare", "guess.npz", "truth.npz", "--start", "1"]) != 0
    assert "truth.npz from 0.000 to 0.900 s" in capsys.readouterr().err


def test_compare_cuts_to_the_span(pair, capsys):
    words = ["compare", "guess.npz", "truth.npz", "--json", "--stop", "0.01"]
    assert main([*words, "--metrics", "stpp"]) == 0
    assert json.loads(capsys.readouterr().out)["scores"] == {"stpp": 1.0}


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["compare", "guess.npz"], "Event file with the truth"),
        (["compare", "nothing.npz", "truth.npz"], "no such file: nothing.npz"),
        (["compare", "guess.npz", "truth.npz", "--metrics", "spp"], "did you mean 'stpp'"),
        (["compare", "guess.npz", "truth.npz", "--start", "2", "--stop", "1"], "after start"),
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
        (["compare", "guess.npz", "truth.npz", "-o", "both.pdf"], "must end in .html"),
        (["bench", "selftst"], "did you mean 'selftest'"),
        (["bench", "selftest", "--metrics", "spp"], "did you mean 'stpp'"),
        (["bench", "selftest", "-o", "truth.npz"], "exists already"),
        (["bench", "fidelity", "-o", "truth.npz"], "exists already"),
        (["bench", "fidelity", "--scenes", "mixd"], "did you mean 'mixed'"),
        (["bench", "fidelity", "--simulators", "esmi"], "did you mean 'esim'"),
        (["bench", "fidelity", "--interpolations", "blnd"], "did you mean 'blend'"),
        (["bench", "fidelity", "--jobs", "0"], "jobs is 0"),
    ],
)
def test_mistakes_are_one_clear_line(pair, capsys, words, message):
    assert main(words) in (2, 3)
    said = capsys.readouterr().err.strip()
    assert message in said
    assert "\n" not in said


def test_bench_lists_its_benchmarks(capsys):
    assert main(["bench", "--help"]) == 0
    assert "selftest" in capsys.readouterr().out
    assert main(["bench"]) == 2


def test_bench_fidelity_writes_tables_and_json(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    chosen = ["--scenes", "static", "--simulators", "esim", "--interpolations", "none"]
    assert main(["bench", "fidelity", *chosen, "-o", "r.json", "--jobs", "1", "-q"]) == 0
    shown = capsys.readouterr()
    assert "### static, noisy pixels" in shown.out
    assert not shown.err
    document = json.loads((tmp_path / "r.json").read_text())
    assert document["scores"][0]["entry"] == "esim, none"
    # Nothing moves, so a model without noise has no event to place.
    assert document["scores"][0]["default_ratio"] == 0
