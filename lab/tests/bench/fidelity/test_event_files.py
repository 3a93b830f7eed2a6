"""Rows of other programs: the frames they get, and the event files they give."""

import math
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from texvent.capture.image_folder import ImageFolder
from texvent.cli.app import main
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent_lab.bench.fidelity import oracle_run
from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.fidelity.event_files import FileEntry, named_folders
from texvent_lab.bench.fidelity.oracle_run import (
    FidelityPlan,
    clip_name,
    record_truths,
    run_fidelity,
)
from texvent_lab.bench.fidelity.run import score_entry
from texvent_lab.bench.kept_results import digest_of, digest_of_file
from texvent_lab.bench.oracle.recording import LAST_US, SIZE, oracle_scene, render_video
from texvent_lab.bench.real import run as real_run
from texvent_lab.bench.real.recording import RecordingPart, open_scene

PLAN = FidelityPlan(
    scenes=("translate",), targets=("ideal",), fit_seeds=(7,), score_seeds=(21,), metrics=("stpp",)
)
OURS = Entry(simulator="esim", interpolate="none", is_rate_matched=False)
CLIPS = [clip_name(*pair) for pair in PLAN.clips]


def save_runs(folder, threshold=None):
    """Events of ours as the files of another program."""
    folder.mkdir(parents=True, exist_ok=True)
    for scene, seed in PLAN.clips:
        events = OURS.simulate(oracle_scene(scene, seed), seed, threshold)
        events.save(folder / f"{clip_name(scene, seed)}.h5")
    return folder


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Runs at three thresholds, a folder each."""
    folder = tmp_path_factory.mktemp("runs")
    for threshold in (0.1, 0.2, 0.9):
        save_runs(folder / str(threshold), threshold)
    return folder


def test_a_program_gets_the_frames_that_simulators_get(tmp_path, capsys):
    given = ["bench", "fidelity", "--scenes", "translate", "--write-frames", str(tmp_path / "f")]
    assert main(given) == 0
    assert "translate-7.h5 and so on, times from 0" in capsys.readouterr().out
    true = render_video(oracle_scene("translate", 21))
    clip = tmp_path / "f" / "translate-21"
    read = list(ImageFolder(clip))
    assert [one.t_us for one in read] == list(true.times_us)
    assert all(np.array_equal(one.pixels, two) for one, two in zip(read, true.pixels, strict=True))
    assert main(given) == 3
    assert main([*given, "--overwrite"]) == 0
    (tmp_path / "f" / "mine.txt").touch()
    assert main([*given, "--overwrite"]) == 3
    assert "holds other files ('mine.txt')" in capsys.readouterr().err


@pytest.fixture(scope="module")
def truth():
    """True events of the plan."""
    ((truth, _, _),) = record_truths(PLAN, "translate")
    return truth


@pytest.mark.long
def test_files_score_as_the_simulator_that_wrote_them(runs, truth):
    rows = FileEntry.find("Mine", runs / "0.2", CLIPS), OURS
    files, ours = (score_entry(truth, row, PLAN.metrics) for row in rows)
    assert (files.entry, ours.entry) == ("Mine", "esim, none")
    assert files.threshold is None
    # ESIM's own threshold is 0.2.
    assert files.values == ours.values
    assert files.default_ratio == ours.default_ratio


@pytest.mark.long
def test_of_several_thresholds_that_one_is_scored_whose_count_is_nearest(runs, truth):
    row = FileEntry.find("Mine", runs, CLIPS)
    counts = {0.1: 900, 0.2: 400, 0.9: 30}
    for target, best in ((1000, 0.1), (700, 0.1), (600, 0.2), (10, 0.9), (0, 0.9)):
        match, _ = row.fit(counts.__getitem__, target)
        assert match.threshold == best
        assert match.ratio == counts[best] / target if target else math.isnan(match.ratio)
    score = score_entry(truth, row, PLAN.metrics)
    alone = FileEntry.find("Mine", runs / str(score.threshold), CLIPS)
    assert score.values == score_entry(truth, alone, PLAN.metrics).values
    with pytest.raises(InputError, match="several thresholds, and none is fitted here"):
        row.packets(CLIPS[0], SIZE, (0, LAST_US))


@pytest.mark.parametrize("fault", ["size", "late", "ms", "missing", "beside", "damaged"])
def test_files_that_are_not_of_these_frames_are_named_before_any_work(
    runs, tmp_path, monkeypatch, capsys, fault
):
    monkeypatch.setattr(oracle_run, "record_truths", lambda *_: pytest.fail("work was done"))
    folder = save_runs(tmp_path / "mine")
    for seed in (33, 54, 68, 85, 97):
        # A jitter of less than a millisecond is no other clock.
        EventStream.from_columns([1], [2], [LAST_US + 999], [1], size=SIZE).save(
            folder / f"translate-{seed}.h5"
        )
    path, t_us = folder / "translate-54.h5", LAST_US + 1_001 if fault == "late" else 5
    size = "8x6" if fault == "size" else SIZE
    path.unlink()
    if fault != "missing":
        EventStream.from_columns([1], [2], [t_us], [1], size=size).save(path)
    if fault == "ms":
        t_ms = np.linspace(0, LAST_US / 1000, 10).astype(np.int64)
        events = EventStream.from_columns([1] * 10, [2] * 10, t_ms, [1] * 10, size=SIZE)
        events.save(path, overwrite=True)
    if fault == "beside":
        (folder / "0.2").mkdir()
    if fault == "damaged":
        path.write_bytes(path.read_bytes()[:900])
    given = ["bench", "fidelity", "--scenes", "translate", "--events", f"Mine={folder}"]
    assert main([*given, "--simulators", "esim", "--interpolations", "none"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert {
        "size": "8x6",
        "late": f"at {LAST_US + 1_001} µs; the frames of translate-54 are from 0 to {LAST_US} µs",
        "ms": f"all its events within {LAST_US // 1000} µs; the frames of translate-54 are from 0",
        "missing": "not one event file each of translate-54",
        "beside": "event files beside folders of thresholds (0.2 ...)",
        "damaged": "translate-54.h5",
    }[fault] in line


@pytest.mark.parametrize("is_part", [False, True])
def test_a_program_that_saw_half_of_the_frames_is_refused_and_one_that_saw_little_is_not(
    tmp_path, is_part
):
    def save(name, *t_us):
        ones = [1] * len(t_us)
        EventStream.from_columns(ones, ones, list(t_us), ones, size=SIZE).save(
            tmp_path / f"{name}.h5", overwrite=True
        )

    row = {one: (100_000, 500_000) for one in ("a", "b")}
    save("a", 100_001)
    save("b", 100_000, 299_999)
    found = FileEntry.find("Mine", tmp_path, list(row))
    with pytest.raises(InputError, match=r"b\.h5 has no event after 50% of its frames"):
        found.check(SIZE, row, is_part=is_part)
    save("a", 300_000)  # one clip that is at rest later does no harm
    found.check(SIZE, row, is_part=is_part)
    for name in row:  # nor do thresholds that nothing reaches
        save(name)
    found.check(SIZE, row, is_part=is_part)


def test_rows_that_tables_could_not_tell_apart_are_refused(runs, tmp_path, monkeypatch):
    monkeypatch.setattr(oracle_run, "record_truths", lambda *_: pytest.fail("work was done"))
    named = replace(FileEntry.find("Mine", runs / "0.2", CLIPS), program=OURS.name)
    for rows in ((OURS, OURS), (OURS, named)):
        with pytest.raises(ConfigError, match="2 rows are called 'esim, none'; name each row once"):
            run_fidelity(replace(PLAN, entries=rows))
    for name in ("0.2", "0.20"):
        (tmp_path / name).mkdir()
    with pytest.raises(InputError, match="are of one threshold; keep one"):
        FileEntry.find("Mine", tmp_path, CLIPS)


def test_rows_are_named_once_by_folders_that_exist(tmp_path):
    assert named_folders([f"v2CE={tmp_path}"], ("V2CE",)) == {"V2CE": tmp_path}
    for texts, message in (
        (["Mine"], "'Mine'; it must be NAME=FOLDER"),
        ([f"Mine={tmp_path}/no"], "a folder that exists"),
        ([f"Mine={tmp_path}", f"Mine={tmp_path}"], "events names Mine twice"),
    ):
        with pytest.raises(ConfigError, match=message):
            named_folders(texts)


def test_frames_and_events_of_a_recording_are_on_its_own_clock(pan_folder, tmp_path, capsys):
    given = ["bench", "real", str(pan_folder), "--offset-us", "5000"]
    assert main([*given, "--write-frames", str(tmp_path / "f")]) == 0
    name = pan_folder.name
    assert f"{name}.h5" in capsys.readouterr().out
    first = (tmp_path / "f" / name / "timestamps.txt").read_text().split()[0]
    scene = open_scene(str(pan_folder), RecordingPart(offset_us=5_000))
    assert round(float(first) * 1e6) + 5_000 == scene.video.times_us[0]
    own = replace(scene.events, t=scene.events.t - 5_000)
    for threshold, events in (("0.1", own[::2]), ("0.2", own), ("0.3", own[::3])):
        (tmp_path / "runs" / threshold).mkdir(parents=True)
        events.save(tmp_path / "runs" / threshold / f"{name}.h5")
    row = FileEntry.find("Mine", tmp_path / "runs", [name])
    match, _ = row.fit(lambda one: scene.count(row, one), scene.fit_count)
    assert (match.threshold, match.ratio) == (0.2, 1.0)
    assert scene.simulate(row, 0.2) == scene.references


def test_a_recordings_files_are_refused_before_any_work_and_may_be_silent_for_a_while(
    pan_folder, tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(real_run, "score_entries", lambda *_, **__: pytest.fail("work was done"))
    path = tmp_path / f"{pan_folder.name}.h5"
    scene = open_scene(str(pan_folder))
    given = ["bench", "real", str(pan_folder), "--events", f"Mine={tmp_path}"]
    for size, t_us, message in (
        ("8x6", scene.video.times_us[0], "8x6"),
        (scene.video.size, scene.video.times_us[-1] + 1_001, f"{path} has no event from"),
    ):
        events = EventStream.from_columns([1], [2], [t_us], [1], size=size)
        events.save(path, overwrite=True)
        assert main(given) == 2
        assert message in capsys.readouterr().err
    late = scene.events.cut(*scene.scored[-1])
    late.save(path, overwrite=True)
    row = FileEntry.find("Mine", tmp_path, [pan_folder.name])
    scene.check(row)
    assert scene.count(row, None) == 0
    assert scene.simulate(row, None)[-1] == scene.references[-1]


def test_the_digest_of_files_is_that_of_their_content_read_in_pieces(tmp_path):
    content = np.random.default_rng(0).bytes(8_000_000)
    digests = []
    for name, data in {"one": content, "same": content, "other": content[:-1] + b"."}.items():
        (tmp_path / name).mkdir()
        (tmp_path / name / "a.h5").write_bytes(data)
        entry = FileEntry.find("Mine", tmp_path / name, ["a"])
        tracemalloc.start()
        digests.append(entry.digest)
        assert tracemalloc.get_traced_memory()[1] < 1_000_000
        tracemalloc.stop()
    assert digests[0] == digests[1] != digests[2]
    assert digest_of_file(tmp_path / "one" / "a.h5") == digest_of(content)
