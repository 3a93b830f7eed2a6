"""Events judged by the images made of them, on a recording whose events explain its frames."""

import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import Video
from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.perturbations import scatter
from texvent_lab.bench.reconstruction.run import (
    DEFAULT_SKIP,
    RECORDED,
    ReconstructionPlan,
    ReconstructionScorer,
    recorded_rate_hz,
    run_reconstruction,
    simulate_recording,
)
from texvent_lab.bench.reconstruction.scores import ImageScores
from texvent_lab.bench.reconstruction.table import (
    _compare,
    reconstruction_document,
    reconstruction_tables,
)
from texvent_lab.frame_recordings import FrameRecording
from texvent_lab.reconstruct.image_measures import load_measures

from .synthetic_network import FRAMES, SIZE, STEP_US, StandInReconstructor, moving_bar

ESIM = Entry(simulator="esim", interpolate="blend")


@pytest.fixture(autouse=True)
def no_weights(tmp_path, monkeypatch):
    """LPIPS takes long; the measures that need no weights are enough here."""
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))


def scorer(**plan):
    plan.setdefault("entries", (ESIM,))
    return ReconstructionScorer(
        reconstructor=StandInReconstructor(),
        measures=load_measures(),
        plan=ReconstructionPlan(**plan),
    )


def test_events_that_explain_the_frames_score_as_well_as_images_can():
    row = scorer(skip=0).score(moving_bar(), moving_bar().events)
    assert row.source == RECORDED
    assert row.events == len(moving_bar().events.collect())
    assert len(row.scores.t_us) == FRAMES - 1
    assert row.scores.mean("mse") < 1e-12
    assert row.scores.mean("ssim") == pytest.approx(1.0, abs=1e-6)


def test_a_run_scores_the_recorded_events_and_every_simulator():
    recordings = [moving_bar("one"), moving_bar("two", frames=13)]
    report = run_reconstruction(recordings, scorer(skip=2))
    assert [(row.recording, row.source) for row in report.rows] == [
        ("one", RECORDED),
        ("one", ESIM.name),
        ("two", RECORDED),
        ("two", ESIM.name),
    ]
    assert [len(row.scores.t_us) for row in report.rows_of(RECORDED)] == [FRAMES - 3, 10]
    recorded, simulated = report.rows[:2]
    assert recorded.threshold is None
    assert simulated.threshold is not None
    assert recorded.scores.mean("mse") < simulated.scores.mean("mse")


def test_a_simulator_that_cannot_run_is_skipped_with_the_reason():
    report = run_reconstruction(
        [moving_bar()], scorer(entries=(Entry(simulator="esim", interpolate="motion"), ESIM))
    )
    assert [row.source for row in report.rows] == [RECORDED, ESIM.name]
    assert "motion" in report.skipped["esim, motion"]


def test_by_default_the_part_that_evreal_names_counts_else_all_but_the_first_images():
    plan = ReconstructionPlan()
    assert plan.scored_part(moving_bar("slider_depth")) == ((1_000_000, 2_500_000), 0)
    assert plan.scored_part(moving_bar()) == (None, DEFAULT_SKIP)
    chosen = ReconstructionPlan(start_s=0.1, seconds=0.2)
    assert chosen.scored_part(moving_bar("slider_depth")) == ((100_000, 300_000), DEFAULT_SKIP)
    assert ReconstructionPlan(skip=3).scored_part(moving_bar("slider_depth")) == (None, 3)


def test_nothing_is_reconstructed_after_the_part_that_counts():
    end_us = 5 * STEP_US
    part = {"start_s": 2 * STEP_US / 1e6, "seconds": 3 * STEP_US / 1e6, "skip": 0}
    row = scorer(**part).score(moving_bar(), moving_bar().events)
    assert row.scores.t_us == [number * STEP_US for number in range(2, 6)]
    assert row.events == len(moving_bar().events.collect().between(0, end_us))


def test_a_fitted_threshold_gives_about_the_recorded_number_of_events():
    recording = moving_bar()
    plan = ReconstructionPlan(is_rate_matched=True)
    simulated = simulate_recording(recording, ESIM, plan).packets.collect()
    seconds = (FRAMES - 1) * STEP_US / 1e6
    assert len(simulated) / seconds == pytest.approx(recorded_rate_hz(recording), rel=0.1)


@given(
    gaps=st.lists(st.integers(1, 400_000), min_size=1, max_size=12),
    times=st.lists(st.integers(0, 4_000_000), min_size=1, max_size=40).map(sorted),
)
def test_the_recorded_rate_is_that_of_the_frames_of_the_first_second(gaps, times):
    at_us = np.cumsum([5, *gaps])
    t = np.array([0, 6, *times])
    events = EventStream(0 * t, 0 * t, np.sort(t), 0 * t, SIZE)
    packets = EventPackets((events[:3], events[3:]), SIZE)
    frames = Video(np.zeros((len(at_us), *SIZE.shape), np.uint8), at_us.tolist())
    recording = FrameRecording(name="it", frames=frames, events=packets)
    after = at_us[at_us - at_us[0] >= 1_000_000]
    last_us = after[0] if len(after) else at_us[-1]
    count = sum(at_us[0] <= one < last_us for one in t.tolist())
    if count:
        rate = recorded_rate_hz(recording)
        assert rate == pytest.approx(count * 1e6 / (last_us - at_us[0]))


def test_frames_of_a_sensor_are_linear_for_models_that_ask():
    plan = ReconstructionPlan(frames_gamma=1.5)
    entry = Entry(simulator="physical", interpolate="none")
    assert simulate_recording(moving_bar(), entry, plan).settings.simulate.gamma == 1.5


def test_scattered_events_keep_their_number_and_the_others_stay():
    events = moving_bar().events.collect()
    rng = np.random.default_rng(0)
    assert scatter(events, rng, share=0.0).equals(events)
    moved = scatter(events, rng, share=0.25)

    def cells(one):
        return set(zip(one.x.tolist(), one.y.tolist(), one.t.tolist(), strict=True))

    assert len(cells(events) & cells(moved)) / len(cells(events)) == pytest.approx(0.75, abs=0.1)
    assert len(moved) == len(events)


def test_tables_and_document_state_every_figure():
    recordings = [moving_bar("one"), moving_bar("two")]
    report = run_reconstruction(recordings, scorer())
    text = reconstruction_tables(report)
    for part in ("## one, stand-in (4 images)", "## all recordings", "| esim, blend | ×"):
        assert part in text
    assert "not measured: lpips: LPIPS's weights are not here" in text
    document = json.loads(json.dumps(reconstruction_document(report), allow_nan=False))
    assert document["schema"] == "texvent-reconstruction-3"
    drift = ImageScores(t_us=range(16), values={"mse": [n / 16 for n in range(16)]})
    rows = [dataclasses.replace(report.rows[1], source=one, scores=dataclasses.replace(
        drift, values={"mse": [factor * x for x in drift.values["mse"]]}))
        for one, factor in (("best", 0.1), ("other", 1.0))]  # fmt: skip
    behind = _compare(rows)["mse"].behind_best["other"].difference
    assert (behind.windows, behind.block) == (4, 4)  # neighbouring images are alike
    assert len(document["rows"]) == 4
    assert len(document["rows"][0]["values"]["ssim"]) == 4
    assert document["rows"][1]["mean"]["mse"] == pytest.approx(report.rows[1].scores.mean("mse"))
    assert document["network"] == {
        "name": "stand-in",
        "sha256": "0" * 64,
    }
