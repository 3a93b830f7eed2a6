"""The benchmark of Blender films, on three small frames."""

import json
import sys
from pathlib import Path

import pytest

pytest.importorskip("OpenEXR")

from texvent_lab.measure.blender import main

SAMPLE = Path(__file__).parents[3] / "tests" / "capture" / "motion_vectors" / "blender_sample"


def test_a_film_against_itself(tmp_path, monkeypatch, capsys):
    words = [SAMPLE, SAMPLE, "--json", tmp_path / "a.json"]
    monkeypatch.setattr(sys, "argv", ["blender", *map(str, words)])
    main()
    results = json.loads((tmp_path / "a.json").read_text())
    assert results["film"]["frames"] == results["rows"]["dense"]["frames"] == 3
    assert results["film"]["size"] == [48, 36]
    assert results["film"]["render_seconds"] > 0
    assert results["rows"]["blend"]["stpp"] == 1.0
    assert results["rows"]["blend"]["events"] == results["rows"]["dense"]["events"] > 0
    assert "stpp" in capsys.readouterr().out
