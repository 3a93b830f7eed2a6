"""Recordings of real sensors in the benchmark, on a small one made here in the usual layouts."""

import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tests.capture.dsec_sequence import write_sequence

from texvent.data.catalogue import DATA_SETS
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.bench.fidelity.entries import ConfigEntry, Entry
from texvent_lab.bench.fidelity.results import read_report
from texvent_lab.bench.fidelity.table import fidelity_tables
from texvent_lab.bench.page import page_files
from texvent_lab.bench.real import run
from texvent_lab.bench.real.recording import RecordingPart, adapt_settings, open_scene
from texvent_lab.bench.real.run import HALVES, real_entries, run_real
from texvent_lab.commands.bench import real
from texvent_lab.frame_recordings import WITH_FRAMES, locate_source

METRICS = ("stpp", "count_ratio")
ENTRIES = (
    Entry(simulator="esim", interpolate="flow"),
    Entry(simulator="esim", interpolate="none"),
    Entry(simulator="esim", interpolate="motion"),
)


@pytest.fixture(scope="module")
def report(pan_folder):
    return run_real([open_scene(str(pan_folder), RecordingPart(offset_us=5_000))], ENTRIES, METRICS)


def test_the_first_half_is_fitted_and_whole_segments_of_the_second_are_scored(pan_folder):
    scene = open_scene(str(pan_folder), RecordingPart(offset_us=5_000))
    assert scene.fit.stop_us <= scene.scored[0].start_us
    assert [span.stop_us - span.start_us for span in scene.scored] == [100_000] * 4
    assert scene.video.times_us[0] == 40_000
    # Frames from before the warm-up to after the end.
    video = scene.frames_around(scene.scored[0])
    assert video.times_us[0] <= scene.scored[0].start_us - 100_000
    assert video.times_us[-1] >= scene.scored[0].stop_us
    later = open_scene(str(pan_folder), RecordingPart(start_s=0.2, offset_us=0))
    assert later.video.times_us[0] == 235_000


@pytest.mark.parametrize("said", [None, 0, 700])
def test_frames_of_a_data_set_are_shifted_by_its_offset_if_nothing_else_is_said(
    pan_folder, monkeypatch, said
):
    monkeypatch.setattr("texvent_lab.frame_recordings.find_pulled", lambda name: pan_folder)
    known = {str(pan_folder): 0} | {name: one.frame_offset_us for name, one in DATA_SETS.items()}
    assert {name: locate_source(name) for name in known} == {
        name: (pan_folder, offset_us) for name, offset_us in known.items()
    }
    for name in (str(pan_folder), *WITH_FRAMES):
        scene = open_scene(name, RecordingPart(offset_us=said))
        assert scene.offset_us == (known[name] if said is None else said)
        assert scene.video.times_us[0] == 35_000 + scene.offset_us


def test_motion_compensation_comes_closest_and_the_bounds_bound_it(report):
    halves, flow, none = report.scores
    assert halves.entry == HALVES
    assert flow.summary("stpp").mean > none.summary("stpp").mean + 0.05
    (reference,) = report.references
    assert reference.floor["stpp"] == [1.0] * 4
    assert np.mean(reference.null["stpp"]) < flow.summary("stpp").mean < 1
    assert flow.values["count_ratio"] == pytest.approx([1] * 4, abs=0.15)
    assert "motion vectors" in report.skipped["esim, motion"]


def test_times_are_shuffled_over_all_scored_spans_at_once(pan_folder, monkeypatch):
    scene = open_scene(str(pan_folder), RecordingPart(offset_us=5_000))
    found, span_us = {}, scene.scored[0].stop_us - scene.scored[0].start_us
    monkeypatch.setattr(run, "perturb", lambda events, name: replace(events, t=events.t + span_us))
    monkeypatch.setattr(run, "measure_bounds", lambda *words: found.update(words=words))
    run._bounds(scene, METRICS)
    _, floors, nulls, _ = found["words"]
    assert floors == scene.references
    for null, before in zip(nulls[1:], scene.references, strict=False):
        assert null.t.tolist() == (before.t + span_us).tolist()


@pytest.mark.long
def test_an_offset_that_is_wrong_scores_lower(pan_folder, report):
    wrong = run_real(
        [open_scene(str(pan_folder), RecordingPart(offset_us=20_000))], ENTRIES[:1], METRICS
    )
    assert wrong.scores[1].summary("stpp").mean < report.scores[1].summary("stpp").mean - 0.02


def test_the_document_states_what_was_used_and_gives_the_page_again(report):
    document = json.loads(json.dumps(report.document(), allow_nan=False))
    (facts,) = document["protocol"].values()
    assert facts["frame_offset_us"] == 5_000
    assert len(facts["scored_us"]) == 4
    restored = read_report(document)
    assert fidelity_tables(restored) == fidelity_tables(report)
    files = page_files(document, "real.json", baseline="esim, none")
    assert set(files) == {"real.md", "real.svg"}
    page = files["real.md"].decode()
    assert page.startswith("# Simulators against recorded events")
    assert "STPP − esim, none" in page
    assert "floor: the recording itself" in page
    assert "frame_offset_us 5000" in page


def test_frames_of_a_davis_are_linear_to_models_that_ask(pan_folder):
    scene = open_scene(str(pan_folder))
    physical = adapt_settings(
        Entry(simulator="physical", interpolate="flow").settings(0), scene.frames_gamma
    )
    assert physical.simulate.gamma == 1.0
    assert physical.interpolate.max_intermediate == 16
    esim = Entry(simulator="esim", interpolate="flow").settings(0)
    assert adapt_settings(esim, scene.frames_gamma).simulate == esim.simulate


def test_a_config_file_is_a_row_with_its_own_threshold(pan_folder, tmp_path):
    (tmp_path / "mine.toml").write_text('simulator = "esim"\ninterpolate = "blend"\n')
    entry = ConfigEntry.read(tmp_path / "mine.toml")
    score = run_real([open_scene(str(pan_folder))], [entry], ["stpp"]).scores[1]
    assert (score.entry, score.threshold) == ("mine", None)


def test_true_frames_are_refused_for_recordings(pan_folder):
    exact = Entry(simulator="esim", interpolate="exact")
    with pytest.raises(ConfigError, match="true frames"):
        run_real([open_scene(str(pan_folder))], [exact])
    assert all(entry.track == "frames" for entry in real_entries())


def test_a_dsec_sequence_opens_as_a_scene_with_display_gamma(tmp_path):
    folder = write_sequence(tmp_path / "seq", frames=20)
    times = np.arange(0, 1_000_000, 500)
    events = EventStream(times % 32, times % 24, 1_000_000 + times, times % 2, SensorSize(32, 24))
    events.save(folder / "events" / "left" / "events.h5", overwrite=True, format="dsec")
    scene = open_scene(str(folder))
    assert scene.frames_gamma == 2.2
    assert scene.video.size == scene.events.size == SensorSize(32, 24)
    assert (scene.scene, scene.offset_us) == ("seq", 0)


def test_images_are_scored_as_the_options_of_the_command_say(pan_folder, monkeypatch):
    asked = {}
    monkeypatch.setattr(real, "find_network", lambda name: SimpleNamespace(name=name))
    monkeypatch.setattr(real, "load_reconstructor", lambda *words: words)
    monkeypatch.setattr(real, "reconstruction_tables", lambda report: "")
    monkeypatch.setattr(real, "run_reconstruction", lambda recordings, scorer, progress:
                        asked.update(name=recordings[0].name, scorer=scorer))  # fmt: skip
    words = [str(pan_folder), "--network", "firenet", "--weights", "w.pt", "--start", "0.5"]
    words += ["--seconds", "0.75", "--match-rate", "--frames-gamma", "1.5", "--simulators", "esim"]
    real.run([*words, "--interpolations", "none,flow", "--quiet"])
    scorer, plan = asked["scorer"], asked["scorer"].plan
    assert (asked["name"], scorer.reconstructor) == (pan_folder.name, ("firenet", Path("w.pt")))
    assert [one.name for one in plan.entries] == ["esim, none", "esim, flow"]
    assert (plan.start_s, plan.seconds, plan.is_rate_matched, plan.frames_gamma) == (
        0.5, 0.75, True, 1.5
    )  # fmt: skip
    real.run([str(pan_folder), "--network", "firenet", "--quiet"])
    plan = asked["scorer"].plan
    assert {one.interpolate for one in plan.entries} == {"flow"}
    assert (plan.start_s, plan.seconds, plan.is_rate_matched, plan.frames_gamma) == (
        0.0, 4.0, False, 1.0
    )  # fmt: skip
