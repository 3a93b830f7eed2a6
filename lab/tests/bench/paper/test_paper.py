"""The paper's tables: its figures, ours next to them, and what is missing."""

import dataclasses
import json
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from texvent.cli.app import main
from texvent.errors import ConfigError, InputError
from texvent.metrics.compare import compare
from texvent.metrics.event_frames import EventFrameLpips
from texvent.simulation.texvent.simulator import TexventSimulator
from texvent_lab.bench.fidelity import entries
from texvent_lab.bench.fidelity.entries import read_ablations
from texvent_lab.bench.fidelity.event_files import FileEntry
from texvent_lab.bench.paper import run as paper
from texvent_lab.bench.paper.ablations import choose_e8, measure_ablations
from texvent_lab.bench.paper.config import PaperConfig
from texvent_lab.bench.paper.published_tables import (
    TABLES,
    Measured,
    compare_with_paper,
    join_measured,
)
from texvent_lab.bench.paper.run import (
    measure_eqs,
    measure_event_frames,
    measure_images,
    measure_noise,
    measure_table,
)
from texvent_lab.bench.real.recording import RecordingPart, open_scene
from texvent_lab.bench.real.run import run_real
from texvent_lab.commands.bench.paper import _read_ablations as ablation_rows

from ..reconstruction.synthetic_network import StandInReconstructor, moving_bar, write_recording
from ..synthetic_report import synthetic_report

PAPER = Path(__file__).parents[4] / "configs" / "paper"


def test_the_paper_s_rows_are_found_wherever_the_command_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = ablation_rows(PaperConfig(rife=False))
    assert [one.name for one in found] == [one.name for one in read_ablations(PAPER)]
    with pytest.raises(InputError, match="no config file in none"):
        ablation_rows(PaperConfig(configs=Path("none")))


def test_the_paper_has_twelve_ablations_in_their_order():
    names = [entry.name for entry in read_ablations(PAPER)]
    assert names == [*(f"E{i}" for i in range(1, 13)), "Texvent"]


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("Texvent", {}),
        ("E1", {"balance": 0.001}),
        ("E2", {"balance": 15.0}),
        ("E3", {"balance": 60.0}),
        ("E4", {"cache": "none"}),
        ("E5", {"cache": "global"}),
        ("E9", {"noise": "none"}),
        ("E10", {"noise": "gaussian"}),
        ("E11", {"noise": "random"}),
        ("E12", {"timestamp_rule": "random"}),
    ],
)
def test_each_ablation_changes_what_the_paper_says(name, changes):
    entry = next(entry for entry in read_ablations(PAPER) if entry.name == name)
    assert entry.settings(5).simulate == dataclasses.replace(
        TexventSimulator.presets["paper"], **changes
    )
    assert entry.settings(5).run.seed == 5


def test_interpolation_is_removed_fixed_and_replaced():
    entries = {entry.name: entry.settings(0).interpolate for entry in read_ablations(PAPER)}
    assert entries["E6"].interpolate == "none"
    assert entries["E7"].fixed_count == 10
    assert (entries["E8"].interpolate, entries["E8"].frames_per_pixel) == ("flow", 1.0)


def test_e8_takes_super_slomo_where_its_weights_are_and_says_which(tmp_path, monkeypatch, plug_ins):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))
    entries = read_ablations(PAPER)
    kept, said = choose_e8(entries, None)
    assert kept == entries
    assert "optical flow in place of Super SloMo" in said.notes[0]
    assert "--slomo-weights" in said.needs[0]
    with pytest.raises(InputError, match=r"no weights file .*mine\.ckpt"):
        choose_e8(entries, tmp_path / "mine.ckpt")
    (tmp_path / "mine.ckpt").touch()
    chosen, said = choose_e8(entries, tmp_path / "mine.ckpt")
    changed = [one.name for one, other in zip(chosen, entries, strict=True) if one != other]
    assert changed == ["E8"]
    found = chosen[[one.name for one in chosen].index("E8")].settings(0).interpolate
    assert (found.interpolate, found.frames_per_pixel) == ("super-slomo", 1.0)
    assert found.interpolator_weights == tmp_path / "mine.ckpt"
    assert said.notes == [
        f"E8: Super SloMo ({tmp_path / 'mine.ckpt'}), with VID2E's number of frames"
    ]


def test_the_threshold_is_fitted_only_if_asked_for():
    kept, fitted = (read_ablations(PAPER, is_rate_matched=flag)[0] for flag in (False, True))
    assert kept.default_threshold is None
    assert fitted.default_threshold == 0.2


def silent(line):
    del line


def keep_few(monkeypatch):
    """Three of the columns, without motion compensation, which is tested elsewhere."""
    few = {
        column: dataclasses.replace(paper.ENTRIES[column], interpolate="none")
        for column in ("VID2E", "Texvent")
    }
    monkeypatch.setattr(paper, "ENTRIES", few)


def test_rife_is_left_out_of_every_row_where_the_user_wants_it_so(monkeypatch):
    monkeypatch.setattr(entries, "missing_rife", lambda: None)
    monkeypatch.setattr(paper, "missing_rife", lambda: None)
    for rife, way in ((True, "rife"), (False, "flow")):
        config = PaperConfig(table=1, rife=rife)
        rows = {one.name: one for one in read_ablations(PAPER, rife=rife)}
        assert rows["Texvent"].interpolate == rows["E1"].interpolate == way
        assert paper.find_columns(config)["Texvent"].interpolate == way
        (note,) = paper.interpolation(config).notes
        assert ("--no-rife" in note) == (not rife)


def test_values_are_means_over_recordings_and_times_those_of_a_pair_in_the_fastest_run(monkeypatch):
    keep_few(monkeypatch)
    columns, base = paper.find_columns(PaperConfig(table=1)), synthetic_report()
    one = dataclasses.replace(base.scores[0], entry=columns["VID2E"].name)
    scores = [dataclasses.replace(one, values={"stpp": x}) for x in ([0.5, 0.7], [0.1, 0.2])]
    report = dataclasses.replace(base, scores=scores)
    assert paper._means(report, "stpp", PaperConfig(table=1)) == {"VID2E": "0.375"}
    durations = iter([40.0, 24.0, 36.0])
    clock = SimpleNamespace(now=0.0)
    monkeypatch.setattr(paper, "time", SimpleNamespace(perf_counter=lambda: clock.now))

    def collect():
        clock.now += next(durations) if clock.now else 1.0

    packets = SimpleNamespace(collect=collect)
    monkeypatch.setattr(paper, "prepare_video", lambda *_: SimpleNamespace(packets=packets))
    assert paper._seconds_per_pair(range(13), columns["VID2E"]) == 2.0


def test_every_row_of_a_table_has_a_figure_per_column():
    assert set(TABLES) == set(range(1, 10))
    for table in TABLES.values():
        assert all(len(figures) == len(table.columns) for figures in table.rows.values())
    # From the paper's text: the best of Tables 1, 2 and 9, and what E12 costs.
    assert TABLES[1].rows["event frames: MSE ↓"][-1] == 0.045
    assert max(TABLES[2].rows["EQS ↑"]) == TABLES[2].rows["EQS ↑"][-1] == 0.8851
    assert TABLES[9].rows["Acc@5 ↑"][-1] == 0.5458
    *_, random_times, own = TABLES[5].rows["EQS ↑"]
    assert own - random_times == pytest.approx(0.0021)


def test_ablations_give_scores_and_paired_differences_to_the_papers_setting():
    report = synthetic_report()
    names = {"texvent paper, blend": "Texvent", "better": "E12", "lost": "E9"}
    report = dataclasses.replace(
        report, scores=[dataclasses.replace(one, entry=names[one.entry]) for one in report.scores]
    )
    figures = measure_ablations(5, report).rows
    assert figures["STPP ↑, mixed, noisy pixels"]["E12"] == "0.750 (count not reached)"
    assert figures["− Texvent, mixed, noisy pixels"]["E12"] == "+0.300 ± 0.100"
    assert "E10" not in figures["STPP ↑, mixed, noisy pixels"]


def test_thresholds_are_fitted_unless_the_user_wants_the_papers_way(capsys, tmp_path, pan_folder):
    (tmp_path / "Texvent.toml").write_text('interpolate = "none"\n')
    words = ["bench", "paper", "--table", "5", "--no-oracle", "--recordings", str(pan_folder)]
    words += ["--configs", str(tmp_path), "-q", "-o", str(tmp_path / "out.json"), "--jobs", "1"]
    assert main(words) == 0
    printed = capsys.readouterr().out
    assert "## Table 5" in printed
    assert "Table 4" not in printed
    document = json.loads((tmp_path / "out.json").read_text())
    assert document["is_rate_matched"] is True
    (report,) = document["reports"]
    assert report["scores"][1]["threshold"] != 0.2


def test_event_frames_are_compared_where_simulators_can_run(pan_folder, monkeypatch):
    keep_few(monkeypatch)
    monkeypatch.setattr(EventFrameLpips, "missing", lambda self: "no weights")
    scenes = [open_scene(str(pan_folder), RecordingPart(offset_us=5_000))]
    config = PaperConfig(table=1, jobs=1, recordings=str(pan_folder))
    found = measure_event_frames(scenes, config, silent)
    mse = found.rows["event frames: MSE ↓"]
    assert set(mse) == {"VID2E", "Texvent"}
    assert all(0 < float(value) < 1 for value in mse.values())
    assert "ef_lpips: no weights" in found.needs
    # A recording compared with itself would have 0.
    recorded = scenes[0].recorded(scenes[0].scored[0])
    assert compare(recorded, recorded, ["ef_mse"]) == {"ef_mse": 0.0}


@pytest.fixture
def others(tmp_path):
    """Folder where another program left its events of the recording "bar": the recorded ones."""
    (tmp_path / "others").mkdir()
    moving_bar(frames=40).events.save(tmp_path / "others" / "bar.h5")
    (tmp_path / "others" / "bar.events.png").touch()
    return tmp_path / "others"


@pytest.fixture
def bar(tmp_path, monkeypatch):
    """That recording; no weights are in the cache."""
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))
    return write_recording(tmp_path / "bar", moving_bar(frames=40))


def test_event_files_fill_columns_of_their_own_or_of_the_table(others, bar, monkeypatch):
    keep_few(monkeypatch)
    events = (f"v2ce={others}", f"vid2e={others}", f"Mine={others}")
    options = {"recordings": str(bar), "events": events, "match_rate": False}
    config = PaperConfig(table=1, jobs=1, **options)
    frames = measure_event_frames([open_scene(str(bar))], config, silent)
    assert {**frames.rows["event frames: MSE ↓"], "Texvent": ""} == {
        "VID2E": "0.000", "V2CE": "0.000", "Mine": "0.000", "Texvent": ""
    }  # fmt: skip
    images = measure_images(config, StandInReconstructor(), silent)
    mse = images.rows["images: MSE ↓"]
    assert mse["V2CE"] == mse["Mine"] == mse["VID2E"] == "0.000" != mse["Texvent"]
    assert "V2CE: events of that program, from files" in images.notes
    lines = compare_with_paper(TABLES[1], join_measured([frames, images])).splitlines()
    assert lines[2].endswith("| Texvent | Mine |")
    assert lines[4].endswith("| 0.045 | – |")


def test_event_files_are_on_the_clock_of_the_frames_as_they_are_stored(pan_folder, tmp_path):
    offset_us = 5_000
    scene = open_scene(str(pan_folder), RecordingPart(offset_us=offset_us))
    early = dataclasses.replace(scene.events, t=scene.events.t - offset_us)
    early.save(tmp_path / f"{scene.scene}.h5")
    row = FileEntry.find("Mine", tmp_path, [scene.scene])
    for found, true in zip(scene.simulate(row, None), scene.references, strict=True):
        assert found == true
    # No threshold is searched by which the file would not change.
    assert dataclasses.replace(row, is_rate_matched=True).default_threshold is None
    late = dataclasses.replace(early, t=early.t + 10**9)
    late.save(tmp_path / f"{scene.scene}.h5", overwrite=True)
    with pytest.raises(InputError, match=r"no event from .* clock of the frames"):
        run_real([scene], [row])


def test_a_folder_that_lacks_a_recording_is_named_before_any_work(others, bar, monkeypatch):
    monkeypatch.setattr(paper, "measure_times", lambda *_: pytest.fail("work was done"))
    (others / "bar.h5").rename(others / "barrel.h5")
    for table in (1, 2, 8):
        config = PaperConfig(table=table, recordings=str(bar), events=(f"V2CE={others}",))
        with pytest.raises(InputError, match="others has not one event file each of bar;"):
            measure_table(config, silent)


@pytest.mark.parametrize(
    ("table", "events", "message"),
    [
        (1, ("V2CE",), "'V2CE'; it must be NAME=FOLDER"),
        (1, ("V2CE=nowhere",), "'V2CE=nowhere'; it must be NAME=FOLDER, a folder that exists"),
        (1, ("V2CE=.", "v2ce=.."), "names V2CE twice"),
        (4, ("V2CE=.",), "columns of tables 1, 2, 8, 9"),
        (None, ("V2CE=.",), "columns of tables 1, 2, 8, 9"),
    ],
)
def test_columns_that_cannot_be_are_refused(table, events, message):
    with pytest.raises(ConfigError, match=message):
        PaperConfig(table=table, events=events)


@pytest.mark.torch
def test_eqs_of_a_network_trained_here_has_a_row_of_its_own_with_controls(
    pan_folder, tmp_path, monkeypatch
):
    torch = pytest.importorskip("torch")
    from tests.metrics.rvt.rvt_files import trained_here

    keep_few(monkeypatch)
    weights = tmp_path / "weights.pt"
    torch.save(trained_here((32, 32)), weights)
    config = PaperConfig(table=2, recordings=str(pan_folder), rvt_weights=weights, jobs=1)
    found = measure_eqs(config, silent)
    assert set(found.rows["eqs (own RVT) ↑"]) == {"VID2E", "Texvent"}
    assert "EQS ↑" not in found.rows
    (controls,) = [note for note in found.notes if "identity" in note]
    assert "identity 1.000" in controls
    assert all(one in controls for one in ("shuffle all times", "flip 100 %", "noise 30 %"))


def test_noise_that_grows_makes_images_less_like_those_without(tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))  # no weights of LPIPS
    folder = write_recording(tmp_path / "bar", moving_bar())
    config = PaperConfig(table=7, recordings=str(folder))
    found = measure_noise(config, StandInReconstructor(), silent)
    errors = [float(found.rows["MSE ↓"][column]) for column in TABLES[7].columns]
    assert 0 <= errors[0] < errors[2] < errors[4]
    assert any(need.startswith("lpips: ") for need in found.needs)


def test_tables_say_which_input_is_missing(monkeypatch, tmp_path):
    monkeypatch.setenv("TEXVENT_DATA", str(tmp_path))
    words = {**dict.fromkeys((1, 3, 7, 8), "data pull"), 6: "--folder", 9: "--folder"}
    for number, word in words.items():
        found = measure_table(PaperConfig(table=number), silent)
        assert not found.rows
        assert word in " ".join(found.needs)


def test_all_tables_become_one_document_and_one_page(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))  # no weights
    monkeypatch.setattr(paper, "STAND_IN", "firenet")
    monkeypatch.setitem(paper.NETWORKS, 8, "firenet")
    keep_few(monkeypatch)
    monkeypatch.setattr(paper, "measure_times", lambda *_: Measured({"time, s": {"VID2E": "0.1"}}))
    configs, result = tmp_path / "configs", tmp_path / "paper.json.gz"
    configs.mkdir()
    (configs / "Texvent.toml").write_text('interpolate = "none"\n')
    words = ["bench", "paper", "--all", "--scenes", "translate", "--configs", str(configs)]
    bar = write_recording(tmp_path / "bar", moving_bar(frames=40))
    words += ["--recordings", str(bar), "--no-oracle", "-q", "--jobs", "1", "-o", str(result)]
    assert main(words) == 0
    printed = capsys.readouterr().out
    assert main(["bench", "page", str(result)]) == 0
    page = (tmp_path / "paper.md").read_text()
    for number in TABLES:
        assert printed.count(f"## Table {number}: ") == page.count(f"## Table {number}: ") == 1
    assert page.count("- Measured in ") == len((1, 2, 4, 5))
    assert page.count("images by e2vid; ") == 2
    assert page.count("images by firenet; ") == 3
    assert not (tmp_path / "paper.svg").exists()
    with pytest.raises(ConfigError, match="all takes every table; leave out"):
        PaperConfig(all=True, table=1)


def test_streams_are_classified_as_n_imagenet_does(tmp_path, monkeypatch):
    asked, (first, *_, last) = [], TABLES[9].columns

    def evaluate(training, weights, hardware):
        data = training.data
        asked.append((data.recordings, weights, hardware.device, data.slice_events,
                      data.image_size, training.network.name))  # fmt: skip
        top_1 = {first.lower(): 0.75, last.lower(): 0.5}[data.validation_split]
        return SimpleNamespace(scores={"accuracy": top_1, "top-5 accuracy": 1 - top_1 / 5})

    monkeypatch.setitem(sys.modules, "texvent_lab.train.run", SimpleNamespace(evaluate=evaluate))
    for name in (first.lower(), last.lower()):
        (tmp_path / name / "tench").mkdir(parents=True)
    config = PaperConfig(table=9, folder=tmp_path, weights=tmp_path / "w.pt")
    found = measure_table(config, silent)
    assert list(found.rows.values()) == [
        {first: "0.7500", last: "0.5000"},
        {first: "0.8500", last: "0.9000"},
    ]
    assert asked == [(tmp_path, tmp_path / "w.pt", "cpu", 30_000, "224x224", "resnet34")] * 2
    mine = dataclasses.replace(config, events=(f"{last}={tmp_path / first.lower()}",))
    assert measure_table(mine, silent).rows["Acc@1 ↑"] == dict.fromkeys((first, last), "0.7500")
    (tmp_path / first.lower() / "shark").mkdir()
    with pytest.raises(InputError, match=f"{last.lower()} lacks shark, which another column has"):
        measure_table(config, silent)
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="original, vid2e"):
        measure_table(dataclasses.replace(config, folder=tmp_path / "empty"), silent)
