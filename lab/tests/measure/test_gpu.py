"""The benchmark of the GPU backend runs to its end, here at a size that the interpreter can do."""

from __future__ import annotations

import json

import pytest

from texvent.sensor import SensorSize
from texvent_lab.measure import gpu

TINY = SensorSize(24, 16)


@pytest.mark.torch
def test_every_figure_is_measured_and_stored():
    torch = pytest.importorskip("torch")
    pytest.importorskip("triton")
    plan = gpu.Plan(
        size=TINY, densities=(0.2,), batches=(1, 2), frames=2, repeats=1, calls=1,
        copy_bytes=2**20, pair_sizes=(),
    )  # fmt: skip
    document = json.loads(
        json.dumps(gpu.measure(plan, "cuda" if torch.cuda.is_available() else "cpu"))
    )
    assert document["copy_gb_per_s"]["median"] > 0
    cases = [(row["model"], row["pixels"], row["batch"]) for row in document["simulation"]]
    assert ("paper", "uint8", 1) in cases
    assert {("esim", "uint8", 2), ("accurate", "uint8", 2), ("paper", "float32", 2)} <= set(cases)
    for row in document["simulation"]:
        assert row["us_per_frame"]["q1"] <= row["us_per_frame"]["median"]
        share = row["events_per_frame"] / (TINY.width * TINY.height)
        assert 0 <= share < 0.4
        if row["density"] == 0.2:
            assert share > 0.1
    text = gpu.as_markdown(document)
    assert text.count("| paper |") == len(plan.densities) + len(plan.batches)


@pytest.mark.torch
def test_pairs_with_rife_are_measured_by_size_and_preset(tmp_path):
    torch = pytest.importorskip("torch")
    pytest.importorskip("triton")
    from tests.interpolate.rife.rife_files import save_published

    from texvent.interpolate.rife.network import RIFE_4_0

    weights = save_published(torch, RIFE_4_0, tmp_path / "rife.pkl")
    plan = gpu.Plan(pair_sizes=(TINY,), pairs=2)
    is_gpu = torch.cuda.is_available()
    rows = list(gpu.measure_pairs(plan, "cuda" if is_gpu else "cpu", weights))
    assert [(row["size"], row["preset"]) for row in rows] == [
        (str(TINY), "paper"),
        (str(TINY), "accurate"),
    ]
    for row in rows:
        assert row["ms_per_pair"] > 0
        assert row["frames_between"] > 0
        assert row["levels_from_float32"] <= (1.0 if is_gpu else 0.0)
