"""The benchmark of training steps runs to its end, here at a size for a CPU."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.measure import train_gpu  # noqa: E402

pytestmark = pytest.mark.torch


def test_every_case_is_measured_and_stored(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert train_gpu.main(["--tiny", "--json", str(tmp_path / "steps.json")]) == 0
    document = json.loads((tmp_path / "steps.json").read_text())
    rows = {(row["network"], row["precision"]): row for row in document["rows"]}
    assert len(rows) == len(document["rows"]) == 4
    for network in ("firenet+", "e2vid+"):
        exact, mixed = (rows[network, precision] for precision in ("float32", "bfloat16"))
        assert mixed["loss"] == pytest.approx(exact["loss"], rel=0.05)
        assert exact["step_ms"]["q1"] <= exact["step_ms"]["median"] <= exact["step_ms"]["q3"]
        assert exact["step_ms"]["n"] == train_gpu.TINY.repeats
    assert document["environment"]["packages"]["torch"]
    assert capsys.readouterr().out.count("e2vid+") == 2
