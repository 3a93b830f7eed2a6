"""The speed measurement: matched counts, rows of small clips, tables of the stored result."""

import itertools
from pathlib import Path
from types import SimpleNamespace

import pytest

from texvent.sensor import SensorSize
from texvent_lab.bench.document import describe_environment, read_document
from texvent_lab.measure.speed import kernels, peers, runs, scenes
from texvent_lab.measure.speed.peers import Peer, match_count, measure_duel
from texvent_lab.measure.speed.runs import measure_run, measure_steps
from texvent_lab.measure.speed.tables import as_markdown

ROOT = Path(__file__).parents[3]


def test_a_threshold_is_found_that_gives_the_count():
    threshold, count = match_count(lambda tried: round(1000 / tried), 5000)
    assert count == pytest.approx(5000, rel=0.02)
    assert threshold == pytest.approx(0.2, rel=0.02)


def test_times_are_those_of_pairs_after_the_first_and_of_frames_of_both_clips(monkeypatch):
    ends = iter([0.0, 50.0, 100.0, *(103.0, 106.0, 109.0), 1e6])
    monkeypatch.setattr(runs, "time", SimpleNamespace(perf_counter=lambda: next(ends)))
    run = measure_run(scenes.EXCERPT, "excerpt", interpolate="none", pairs=3)
    assert (run["pairs"], run["ms_per_pair"]) == (3, 3000)
    frames = scenes.jumping_pixels(SensorSize(8, 6), 0.2, 5)
    monkeypatch.setattr(kernels, "seconds", lambda work: 12.0)
    assert kernels._in_two_threads("esim", frames, 12)["median"] == 12_000 / 2 / 2
    shown = [one.pixels for one in itertools.islice(scenes.to_and_fro(frames), 10)]
    order = [0, 1, 2, 3, 4, 3, 2, 1, 0, 1]
    assert all((one == frames[place]).all() for one, place in zip(shown, order, strict=True))


def test_every_peer_runs_beside_each_of_our_models(monkeypatch):
    asked = []
    monkeypatch.setattr(peers, "measure_duel", lambda clip, name, ours, own, others, rounds:
                        asked.append((ours, others, rounds)) or {})  # fmt: skip
    rows = peers.measure_peers(quick=True, video=None)
    assert len(rows) == len(peers.OURS) + 1
    assert asked[:-1] == [(ours, peers.CORES, 3) for ours in peers.OURS]
    assert asked[-1][1:] == ((peers.ADAPTIVE,), 3)


def absent():
    raise ImportError("no module")


def test_small_rows_of_every_kind_become_tables(monkeypatch):
    size, models = SensorSize(64, 48), ("texvent", "esim")
    plan = kernels.KernelPlan(frames=2, steps=1, models=models, sizes=(size,), densities=(0.2,))
    rows = kernels.measure_kernels(plan)
    assert [(row["model"], row["way"]) for row in rows][:2] == [
        ("texvent", "clip"),
        ("texvent", "clips"),
    ]
    # A fifth of the pixels jumps, each by one event of the paper preset.
    assert rows[0]["events_per_frame"] == pytest.approx(0.2 * 64 * 48, rel=0.2)
    others = (
        Peer("peer", "peer", lambda: lambda clip, tried: round(500 / tried)),
        Peer("absent", "absent", absent),
    )
    clip = scenes.embedded_heavy_clip(count=3)
    duel = measure_duel(clip, "heavy", "ours", lambda clip, tried: 1000, others, rounds=1)
    assert duel["peers"][0]["threshold"] == pytest.approx(0.5, rel=0.02)
    assert duel["peers"][1]["installed"] is False
    run = measure_run(scenes.EXCERPT, "excerpt", interpolate="none", pairs=1)
    assert run["events_per_pair"] > 0
    monkeypatch.setattr(runs, "STEP_SIZES", (SensorSize(64, 48),))
    steps = measure_steps(steps=2)
    assert [row["model"] for row in steps] == ["texvent", "esim", "v2e"]
    assert all(0 < row["ms_median"] <= row["ms_p95"] for row in steps)
    document = {
        "quick": False,
        "environment": describe_environment(),
        "load_at_start": 0.5,
        "load_at_end": 0.5,
        "kernels": rows,
        "runs": [run],
        "steps": steps,
        "peers": [duel],
        "commands": [{"command": "demo", "cpu_s": 15.0, "clock_s": 9.5}],
    }
    text = as_markdown(document)
    assert "| texvent | 64x48 | 20.0% | clip |" in text
    assert "| not installed (no module) |" in text
    assert "| demo | 15 | 9.5 |" in text
    assert f"| v2e | 64x48 | {steps[2]['events_per_step']:,.0f} | " in text


def test_the_stored_result_has_tables():
    assert as_markdown(read_document(ROOT / "docs/results/speed.json.gz")).count("\n## ") == 6
