"""The benchmark of the GPU backend runs to its end, here at a size that the interpreter can do."""

import json
import sys
from dataclasses import replace

import pytest

torch = pytest.importorskip("torch")
pytest.importorskip("triton")

from texvent.generation.video_models.known_models import MODELS as VIDEO_MODELS  # noqa: E402
from texvent.simulation.gpu.support import MODELS as ON_GPU  # noqa: E402
from texvent.simulation.gpu.support import RunDevice  # noqa: E402
from texvent_lab.measure import gpu  # noqa: E402
from texvent_lab.measure.generated_video import measure_generated  # noqa: E402
from texvent_lab.measure.real_size import PUBLISHED, RealSize, measure_real_size  # noqa: E402

pytestmark = pytest.mark.torch
TINY = gpu.SMALL


@pytest.mark.parametrize(("repeats", "calls"), [(1, 1), (3, 1), (2, 4)])
def test_repeats_are_timed_per_call_and_the_first_two_are_not(repeats, calls, monkeypatch):
    clock, seen = [0.0], []

    def call():
        seen.append(clock[0])
        clock[0] += 100.0 if len(seen) <= 2 * calls else 0.5

    monkeypatch.setattr(gpu.time, "perf_counter", lambda: clock[0])
    assert gpu._times(call, repeats, "cpu", calls=calls) == [0.5] * repeats
    assert len(seen) == (repeats + 2) * calls


def test_every_figure_is_measured_and_stored():
    plan = replace(gpu.TINY, pair_sizes=(), long_run=0, wan=None)
    saved: list[int] = []
    device = "cuda" if torch.cuda.is_available() else "cpu"
    document = gpu.measure(plan, device, lambda so_far: saved.append(len(json.dumps(so_far))))
    document = json.loads(json.dumps(document))
    assert saved == sorted(set(saved))
    assert len(saved) == len(document["simulation"]) + len(document["stream"])
    assert [row["randomize"] for row in document["stream"]] == ["v2v", "physical"]
    assert all(row["stream_clips_per_hour"] > 0 for row in document["stream"])
    assert document["failed"] == {}
    assert document["copy_gb_per_s"]["median"] > 0
    cases = [(row["model"], row["pixels"], row["batch"]) for row in document["simulation"]]
    assert ("paper", "uint8", 1) in cases
    models = set(ON_GPU) - {"texvent"} | {"accurate"}
    assert {*((model, "uint8", 2) for model in models), ("paper", "float32", 2)} <= set(cases)
    for row in document["simulation"]:
        assert row["us_per_frame"]["q1"] <= row["us_per_frame"]["median"]
        share = row["events_per_frame"] / (TINY.width * TINY.height)
        assert 0 <= share < 0.4
        if row["density"] == 0.2:
            assert share > 0.1
    text = gpu.as_markdown(document)
    assert text.count("| paper |") == len(plan.densities) + len(plan.batches)


@pytest.mark.filterwarnings("ignore:.*DeprecationWarning")
def test_the_whole_program_is_tried_out_without_a_gpu(tmp_path, capsys, monkeypatch):
    pytest.importorskip("diffusers")
    file = tmp_path / "gpu.json"
    monkeypatch.setattr(sys, "argv", ["gpu", "--tiny", "--json", str(file)])
    assert gpu.main() == 0
    document = json.loads(file.read_text())
    assert document["failed"] == {}
    parts = {"pairs": 2, "stream": 2, "generated": 3, "simulation": 6, "memory": 1}
    assert {name: len(document[name]) for name in parts} == parts
    assert list(document["memory"][0]["after"]) == ["2", "20"]
    assert "\nmemory: " in capsys.readouterr().out


@pytest.mark.filterwarnings("ignore:.*DeprecationWarning")
def test_a_video_of_a_model_goes_from_its_decoder_to_events_and_a_file():
    pytest.importorskip("diffusers")
    device = torch.device("cuda" if torch.cuda.is_available() else "cpu")
    rows = list(measure_generated(gpu.TINY.wan, RunDevice(device)))
    assert [row["video"] for row in rows] == ["moving texture", "moving texture", "decoded noise"]
    for row in rows:
        assert (row["frames"], row["size"]) == (5, "16x16")
        assert 0 < row["check_s"] < row["last_event_s"]
        assert row["file_s"] > 0


@pytest.mark.filterwarnings("ignore:.*DeprecationWarning")
@pytest.mark.skipif(torch.cuda.is_available(), reason="a GPU can do it")
@pytest.mark.parametrize("words", [[], ["--tiny"]])
def test_a_published_size_is_not_tried_on_a_cpu(words, capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["gpu", "--real-size", "wan-vace-1.3b", *words])
    assert gpu.main() == 2
    assert "no GPU, which --real-size needs" in capsys.readouterr().err


def test_a_model_of_real_size_goes_from_its_files_to_events():
    pytest.importorskip("diffusers")
    size = RealSize(2, 12, 2, 32, 32, 1, 4)
    shape = {"frames": 5, "width": 32, "height": 32, "steps": 2, "on_failure": "ignore"}
    row = measure_real_size("wan-vace-1.3b", size, "cpu", **shape)
    assert (row["size"], row["frames"]) == ("32x32", 5)
    assert {"loading", "denoise 2 of 2", "decode and check", "simulate"} <= set(row["seconds"])
    assert set(PUBLISHED) <= set(VIDEO_MODELS)


def test_pairs_with_rife_are_measured_by_size_and_preset(tmp_path):
    from tests.interpolate.rife.rife_files import save_published

    from texvent.interpolate.rife.network import RIFE_4_0

    weights = save_published(torch, RIFE_4_0, tmp_path / "rife.pkl")
    plan = gpu.Plan(pair_sizes=(TINY,), pairs=2)
    is_gpu = torch.cuda.is_available()
    device = "cuda" if is_gpu else "cpu"
    (row, _) = gpu.measure_pairs(plan, device)
    assert row["weights"] in ("random", "published")
    assert row["ms_per_pair"] > 0
    rows = list(gpu.measure_pairs(plan, device, weights))
    assert [(row["size"], row["preset"]) for row in rows] == [
        (str(TINY), "paper"),
        (str(TINY), "accurate"),
    ]
    for row in rows:
        assert row["ms_per_pair"] > 0
        assert row["frames_between"] > 0
        assert row["levels_from_float32"] <= (1.0 if is_gpu else 0.0)


def test_a_part_that_fails_is_noted_and_the_next_begins(tmp_path, capsys):
    one = gpu.stream.StreamPlan(1, 2, 8, 2, repeats=1, plain=1)
    plan = gpu.Plan(
        size=TINY, densities=(), batches=(1,), frames=2, repeats=1, calls=1, copy_bytes=2**20,
        pair_sizes=(TINY,), pairs=2, wan=None, streams=(one,), long_run=0, seconds=1e6,
    )  # fmt: skip
    device = "cuda" if torch.cuda.is_available() else "cpu"
    saved = []
    document = gpu.measure(plan, device, saved.append, tmp_path / "missing.pkl")
    assert list(document["failed"]) == ["pairs"]
    assert "missing.pkl" in document["failed"]["pairs"]
    assert len(document["stream"]) == 1
    assert "missing.pkl" in gpu.as_markdown(saved[-1])
    assert "Traceback" in capsys.readouterr().err
