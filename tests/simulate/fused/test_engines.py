"""Which pairs are fused, and which runs are refused before any work."""

from __future__ import annotations

import numpy as np
import pytest

import texvent
from texvent.cli.app import main
from texvent.errors import ConfigError
from texvent.io.files import save
from texvent.pipeline import text_to_events
from texvent.run.settings import resolve
from texvent.simulate.fused.candidates import compiled_kernels

from .clips import panning

LINES = {"multi_event": True, "reset": "step", "timestamp_rule": "linear"}


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"simulator": "v2e"}, "cannot run simulator 'v2e'; it runs esim, and texvent"),
        ({}, "multi_event, reset 'step' and timestamp_rule 'linear' only"),
        ({**LINES, "cache": "none"}, "cache local, leaky or global"),
        ({**LINES, "noise": "gaussian"}, "noise adaptive, random or none"),
        ({"simulator": "esim", "threshold_sigma": 0.03}, "threshold_sigma 0"),
        ({"simulator": "esim", "interpolate": "exact"}, "follows flow, blend, none"),
    ],
)
def test_what_the_continuous_engine_cannot_do_is_refused_before_any_work(options, message):
    settings = resolve("generate", {"interpolate": "flow", **options, "engine": "continuous"})
    with pytest.raises(ConfigError, match=message):
        text_to_events("", settings)  # an empty prompt would be refused next
    with pytest.raises(ConfigError, match="engine"):
        texvent.simulate(panning(2), engine="continuous", **options)


@pytest.mark.parametrize(
    ("options", "is_tried"),
    [
        ({}, True),
        ({"preset": "accurate"}, True),
        ({"simulator": "esim"}, True),
        ({"interpolate": "blend"}, False),
        ({"interpolate": "none", "simulator": "esim"}, False),
        ({"noise": "gaussian"}, False),
        ({"backend": "reference"}, False),
        ({"simulator": "esim", "threshold_sigma": 0.03}, False),
    ],
)
def test_a_pair_is_not_drawn_where_it_can_be_fused(options, is_tried, monkeypatch):
    estimated = []
    kernels = compiled_kernels()
    whole = kernels.estimate_active
    monkeypatch.setattr(
        kernels, "estimate_active", lambda *given: estimated.append(1) or whole(*given)
    )
    texvent.simulate(panning(3), **options)
    assert bool(estimated) is is_tried


def test_the_file_says_which_engine_made_it(tmp_path, capsys):
    clip, out = tmp_path / "clip.npy", tmp_path / "events.h5"
    np.save(clip, panning(3).pixels)
    command = ["simulate", str(clip), "--fps", "25", "--simulator", "esim", "-o", str(out)]
    assert main([*command, "--engine", "continuous"]) == 0
    stored = texvent.load(out)
    assert stored.metadata["settings"]["run"]["engine"] == "continuous"
    direct = texvent.simulate(panning(3).pixels, fps=25, simulator="esim", engine="continuous")
    save(tmp_path / "direct.h5", direct)
    assert stored.equals(texvent.load(tmp_path / "direct.h5"))
    capsys.readouterr()
    assert main([*command, "--engine", "continuous", "--interpolate", "rife", "--overwrite"]) != 0
    assert "engine 'continuous' cannot follow interpolate 'rife'" in capsys.readouterr().err
