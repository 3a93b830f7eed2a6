"""The oracle benchmark: fitting, scoring, its document and its tables."""

import dataclasses
import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import ConfigError
from texvent.metrics.compare import compare
from texvent.pipeline import video_to_events
from texvent.run.rate_search import ThresholdMatch
from texvent.settings.resolution import resolve
from texvent.simulation.physical.threshold_map import read_threshold_map
from texvent_lab.bench.fidelity.comparison import Comparison
from texvent_lab.bench.fidelity.entries import ConfigEntry, Entry, choose_entries
from texvent_lab.bench.fidelity.oracle_run import FidelityPlan, record_truths, run_fidelity
from texvent_lab.bench.fidelity.results import read_report
from texvent_lab.bench.fidelity.run import score_entry
from texvent_lab.bench.fidelity.table import fidelity_tables
from texvent_lab.bench.oracle.pixel import IDEAL, NOISY, TARGETS, PixelArray
from texvent_lab.bench.oracle.recording import SIZE, TrueFrames, oracle_scene, record
from texvent_lab.bench.oracle.scenes import EXPOSURE

from ..synthetic_report import synthetic_report

CLEAN = Entry(simulator="physical", preset="clean", interpolate="exact")
QUICK = FidelityPlan(
    scenes=("translate",),
    targets=("ideal",),
    fit_seeds=(7,),
    score_seeds=(7,),
    metrics=("stpp", "count_ratio", "nearest"),
    entries=(CLEAN, Entry(simulator="esim", interpolate="none")),
)


@pytest.fixture(scope="module")
def report():
    return run_fidelity(QUICK)


@pytest.mark.parametrize("name", ["scenes", "targets", "metrics"])
def test_a_plan_of_a_name_that_nothing_has_is_refused(name):
    with pytest.raises(ConfigError, match="'nothing'"):
        FidelityPlan(**{name: ("nothing",)})


def test_noise_differs_between_recordings_and_the_sensor_in_the_last_one_alone(monkeypatch):
    class AskedError(Exception):
        pass

    def ask(scene, sensors):
        raise AskedError(sensors)

    monkeypatch.setattr("texvent_lab.bench.fidelity.oracle_run.record", ask)
    with pytest.raises(AskedError) as caught:
        record_truths(dataclasses.replace(QUICK, targets=tuple(TARGETS)), "translate")
    for target, model in TARGETS.items():
        asked = [one for (name, _), one in caught.value.args[0].items() if name == target]
        assert len({noise for _, noise in asked}) == len(asked) == 3
        reference, floor, other = (pixels for pixels, _ in asked)
        assert reference == floor == model
        assert other == dataclasses.replace(model, sensor_seed=other.sensor_seed) != model


@pytest.mark.long
def test_an_ideal_model_with_true_frames_recovers_the_ideal_oracle():
    """The two were written apart: each checks the other."""
    scene = oracle_scene("translate", 7)
    truth = record(scene, {"ideal": (IDEAL, 1)})["ideal"]
    options = {"simulator": "physical", "preset": "clean", "interpolate": "exact"}
    # The oracle's dark level on the camera's linear scale; 200 frames between two.
    same_pixel = {"balance": 255 * EXPOSURE * IDEAL.dark_level}
    settings = resolve("simulate", {**options, **same_pixel, "fixed_count": 199})
    events = video_to_events(TrueFrames(scene), settings).packets.collect()
    scores = compare(events, truth, ["count_ratio", "stpp", "nearest", "van_rossum"])
    assert scores["count_ratio"] == pytest.approx(1.0, abs=0.01)
    assert scores["stpp"] > 0.97
    assert scores["nearest"] < 0.2
    assert scores["van_rossum"] < 0.02


@pytest.mark.long
def test_a_model_without_intermediate_frames_is_further_from_the_truth(report):
    clean, frames_only = report.scores[:2]
    assert frames_only.track == "frames"
    assert frames_only.summary("stpp").mean < clean.summary("stpp").mean - 0.1
    assert frames_only.normalised("stpp", report.references[0]) < 0.8


@pytest.mark.long
def test_the_rate_is_matched_on_the_fitting_seeds(report):
    for score in report.scores:
        assert score.is_matched
        assert score.values["count_ratio"][0] == pytest.approx(1, abs=0.021)


@pytest.mark.long
def test_a_document_read_back_gives_the_report(report):
    document = json.loads(json.dumps(report.document(), allow_nan=False))
    assert read_report(document).document() == document
    restored = read_report(json.loads(json.dumps(synthetic_report().document())))
    assert math.isnan(restored.scores[2].values["stpp"][0])
    assert fidelity_tables(restored) == fidelity_tables(synthetic_report())


FILE = """interpolate = "rife"
preset = "paper"
rife_flow = "each"
"""
RIFE = Entry(simulator="texvent", preset="paper", interpolate="rife", rife_flow="each")
ROWS = {
    "simulator": {"simulator": "esim", "preset": None},
    "preset": {"preset": "accurate"},
    "interpolate": {"interpolate": "blend"},
    "rife_flow": {"rife_flow": "once"},
    "options": {"options": (("contrast_threshold", 0.4),)},
}


@pytest.mark.parametrize("name", ROWS)
def test_every_field_of_a_row_reaches_its_run_and_beats_its_file(name, tmp_path):
    (tmp_path / "one.toml").write_text(FILE)
    of_file = ConfigEntry.read(tmp_path / "one.toml")
    assert of_file.settings(3).as_tables() == RIFE.settings(3).as_tables()
    for row in (RIFE, of_file):
        if hasattr(row, name) and (row is RIFE or name in ("interpolate", "options")):
            changed = dataclasses.replace(row, **ROWS[name])
            assert changed.settings(3).as_tables() != row.settings(3).as_tables()
        assert {row.settings(seed).run.seed for seed in (3, 4)} == {3, 4}
        flow = row.or_flow(rife=False).settings(3).interpolate
        assert (flow.interpolate, row.settings(3).interpolate.rife_flow) == ("flow", "each")


def test_entries_are_chosen_by_name_and_preset():
    entries = choose_entries("physical:davis346,esim", "none")
    assert [entry.name for entry in entries] == ["physical davis346, none", "esim, none"]


def test_the_calibrated_entry_knows_the_sensor():
    (entry,) = choose_entries("physical:calibrated", "exact")
    assert entry.track == "true frames, sensor known"
    found = entry.settings(0).simulate
    # Half of the radiance is level 115, from which on the true bandwidth is 250 Hz.
    assert found.cutoff_limit_hz == pytest.approx(250, rel=0.02)
    for level, tolerance in ((28, 0.4), (57, 0.4), (115, 0.2)):
        share = (level + found.balance) / (255 + found.balance)
        bandwidth = min(found.cutoff_hz * share, found.cutoff_limit_hz)
        assert bandwidth == pytest.approx(250 * level / 115, rel=tolerance)
    true = PixelArray(NOISY, SIZE, 0)
    measured = read_threshold_map(found.threshold_map)
    for each, own in zip(measured, (true._on, true._off), strict=True):
        error = each.reshape(-1) * own.mean() - own
        assert np.sqrt(np.nanmean(error**2)) < 0.2 * own.std()
    assert found.contrast_threshold == pytest.approx(NOISY.threshold, rel=0.15)
    assert found.threshold_sigma == pytest.approx(NOISY.threshold_sigma, rel=0.15)


@pytest.mark.long
def test_floor_and_null_bound_the_scores(report):
    reference = report.reference("translate", "ideal")
    # Ideal pixels have no noise: a second recording is the same recording.
    assert reference.floor["stpp"] == [1.0]
    assert reference.null["stpp"][0] < 0.7


def test_a_scene_without_true_events_has_undefined_ratios_not_numbers(tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))  # where no weights are
    metrics = ("nearest", "stpp")
    plan = FidelityPlan(scenes=("static",), targets=("ideal",), score_seeds=(21,), metrics=metrics)
    ((truth, reference, _),) = record_truths(plan, "static")
    assert (list(truth.fit), list(truth.scored)) == ([7], [21])
    score = score_entry(truth, Entry(simulator="esim", interpolate="none"), metrics)
    assert math.isnan(score.default_ratio)
    assert math.isnan(score.values["nearest"][0])
    assert not score.is_matched
    assert reference.events == [0]
    name, reason = score_entry(truth, Entry(simulator="esim", interpolate="rife"), metrics)
    assert name == "esim, rife"
    assert "texvent[rife]" in reason or "weights" in reason


@pytest.mark.parametrize("ratio", [None, 0.5, 1.01])
def test_a_score_says_whether_its_threshold_gave_the_count(monkeypatch, ratio):
    match = ThresholdMatch(0.3, ratio, 4) if ratio else None
    entry, asked = Entry(simulator="esim", interpolate="none"), []
    monkeypatch.setattr(Entry, "fit", lambda own, count, target: (match, 0.75))
    truth = SimpleNamespace(
        scene="s", target="t", references=[], fit_count=5,
        simulate=lambda entry, threshold: asked.append(threshold) or [],
    )  # fmt: skip
    score = score_entry(truth, entry, ("stpp",))
    assert (score.threshold, score.is_matched) == (match and 0.3, ratio == 1.01)
    assert (asked, score.default_ratio, score.entry) == ([score.threshold], 0.75, entry.name)


def six_textures(**entries):
    """A report of one scene with six textures: entry → STPP on each."""
    report = synthetic_report()
    (reference,) = report.references
    bounds = {"floor": {"stpp": [0.9] * 6}, "null": {"stpp": [0.2] * 6}}
    scores = [
        dataclasses.replace(report.scores[0], entry=name, values={"stpp": values}, **changes)
        for name, (values, changes) in entries.items()
    ]
    return dataclasses.replace(
        report,
        references=[dataclasses.replace(reference, **bounds)],
        scores=scores,
        score_seeds=[1, 2, 3, 4, 5, 6],
    )


STEADY = [0.60, 0.61, 0.62, 0.63, 0.64, 0.65]
TRACKS = {
    "lost": ([math.nan] * 6, {}),
    "steady": (STEADY, {}),
    "twin": ([0.61, 0.60, 0.63, 0.62, 0.64, 0.64], {}),
    "behind": ([one - 0.1 for one in STEADY], {}),
    "true frames": ([0.8] * 6, {"track": "true frames"}),
    "half": ([0.7] * 6, {"track": "recorded"}),
}


def test_tables_say_how_far_an_entry_is_behind_the_best_that_gets_the_same_frames():
    table = fidelity_tables(six_textures(**TRACKS), baseline="twin")
    cells = {row.split(" | ")[0].strip("| "): row for row in table.splitlines() if "|" in row}
    assert cells["entry"].endswith("| STPP − twin | behind the best |")
    assert cells["steady"].endswith("| best |")
    assert cells["true frames"].endswith("| best |")
    assert cells["behind"].endswith("| 0.100 [0.100, 0.100] |")
    assert cells["twin"].endswith("] ≈ |")
    assert "| +0.002 [" in cells["steady"]
    assert cells["half"].endswith("|  |")
    assert cells["lost"].endswith("| undefined | undefined |")
    ranked = six_textures(**TRACKS).ranked("mixed", "noisy")
    order = [one.entry for one in ranked]
    assert order == ["true frames", "half", "steady", "twin", "behind", "lost"]
    assert [name for name in cells if name in TRACKS] == order
    document = six_textures(**TRACKS).document()
    behind = {score["entry"]: score["behind_best"] for score in document["scores"]}
    assert behind["steady"] is behind["half"] is behind["true frames"] is None
    assert (behind["behind"]["best"], behind["behind"]["is_significant"]) == ("steady", True)
    assert behind["behind"]["low"] > 0
    assert behind["twin"]["is_significant"] is False
    assert behind["lost"]["low"] is None


def test_kinds_of_pixels_of_one_scene_count_as_one_window_over_scenes():
    report = six_textures(steady=(STEADY, {}), other=([one - 0.1 for one in STEADY], {}))
    places = [(f"scene {number}", kind) for number in range(6) for kind in ("noisy", "ideal")]
    report = dataclasses.replace(
        report,
        references=[
            dataclasses.replace(report.references[0], scene=scene, target=kind)
            for scene, kind in places
        ],
        scores=[
            dataclasses.replace(score, scene=scene, target=kind)
            for score in report.scores
            for scene, kind in places
        ],
    )
    overall = report.overall_comparison()
    assert overall.windows == 6
    assert overall.behind_best["other"].difference.mean == pytest.approx(0.1 / 0.7)
    overview = fidelity_tables(report).partition("##")[0]
    assert "| 0.143 [0.143, 0.143] |" in overview
    assert "over 6 scenes" in overview


@given(seed=st.integers(0, 99), windows=st.sampled_from([4, 40]))
def test_marks_tell_the_best_and_those_like_it_of_each_track(seed, windows):
    noise = np.random.default_rng(seed).normal(0, 1e-3, (5, windows))
    means = {"a": 0.5, "like a": 0.5 - 1e-9, "worse": 0.4, "alone": 0.9, "half": 0.99}
    values = {one: (mean + row).tolist() for (one, mean), row in
              zip(means.items(), noise, strict=True)}  # fmt: skip
    values["like a"] = [a - 1e-9 * (-1) ** n for n, a in enumerate(values["a"])]
    values["a"][0] += 1e-6
    tracks = {"a": "frames", "like a": "frames", "worse": "frames", "alone": "true frames"}
    found = Comparison(values, tracks, is_in_sequence=False)
    lost = {"lost": [math.nan] * windows}  # an undefined one is never the best, the first neither
    with_it = Comparison(lost | values, tracks | {"lost": "frames"}, is_in_sequence=False)
    assert {one: behind.best for one, behind in with_it.behind_best.items()} == {
        one: "a" for one in ("lost", "like a", "worse")
    }
    unsure, worse = ("(?)", "(?)") if windows < 6 else ("(≈)", "")
    marks = {one: found.mark(one) for one in values}
    assert marks == {"a": "(best)", "like a": unsure, "worse": worse, "alone": "(best)", "half": ""}
    two = {one: tracks[one] for one in ("a", "worse")}
    assert [Comparison({one: values[one] for one in some}, some, is_in_sequence=False).mark("a")
            for some in (two, {"a": "frames"})] == ["(best)", ""]  # fmt: skip
