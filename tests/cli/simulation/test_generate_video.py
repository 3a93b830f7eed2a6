"""`--video-only` and `texvent generators`, as a user meets them."""

import json
import re
from dataclasses import replace
from fractions import Fraction

import h5py
import numpy as np
import pytest
from tests.cli.running import run

import texvent
from texvent._registry import GENERATORS
from texvent.errors import FileFormatError
from texvent.generation.video_models.known_models import MODELS
from texvent.generation.videos.stored_video import reopen
from texvent.pipeline import text_to_video
from texvent.settings.resolution import resolve

PROMPT = "a red ball bounces on the grass"
SMALL = ["--sensor", "48x36", "--duration", "0.2", "--samples", "1", "--fps", "30000/1001"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "cache"))
    return tmp_path


def test_a_video_written_once_gives_events_again_and_again(folder, capsys):
    assert run("generate", PROMPT, *SMALL, "--video-only", "-o", "ball.avi") == 0
    assert capsys.readouterr().out == "ball.avi\n"
    video = reopen(folder / "ball.avi")
    assert (video.fps, video.size, video.frame_count) == (Fraction(30_000, 1001), (48, 36), 6)
    for name, threshold in (("a.h5", 0.3), ("b.h5", 0.1)):
        words = ("--contrast-threshold", threshold, "--noise", "none", "--previews", "none")
        assert run("simulate", "ball.avi", "--prompt", "a ball", *words, "-o", name) == 0
    assert len(texvent.load("b.h5")) > len(texvent.load("a.h5")) > 0
    with h5py.File("a.h5") as file:
        stored = json.loads(file.attrs["texvent"])
    assert stored["prompt"] == "a ball"
    assert stored["source"]["prompt"] == PROMPT
    assert stored["source"]["generator"] == "procedural"


def test_the_written_video_is_what_was_rendered_to_16_bits(folder):
    assert run("generate", PROMPT, *SMALL, "--video-only", "-o", "ball.avi") == 0
    options = {"sensor": "48x36", "duration": 0.2, "samples": 1, "fps": "30000/1001"}
    rendered = text_to_video(PROMPT, resolve("generate", options))
    for ours, stored in zip(rendered, reopen(folder / "ball.avi"), strict=True):
        assert ours.t_us == stored.t_us
        assert np.abs(stored.pixels / 257.0 - ours.pixels).max() <= 0.5 / 257 + 1e-4


def test_a_model_of_few_frames_per_second_warns_in_one_line(folder, capsys):
    """Without diffusers the run ends there, with an error of its own."""
    run("generate", PROMPT, "--generator", "cogvideox-2b", "--dry-run")
    lines = capsys.readouterr().err.splitlines()
    assert lines[0].startswith("warning  cogvideox-2b makes 8 frames per second")
    assert not any("frames per second" in line for line in lines[1:])


def test_a_damaged_download_does_not_end_the_list(folder, capsys, monkeypatch):
    def damaged(model):
        raise FileFormatError("x.safetensors is damaged")

    monkeypatch.setattr("texvent.cli.setup.generators.find_spec", lambda name: True)
    monkeypatch.setattr("texvent.cli.setup.generators.find_downloaded", damaged)
    assert run("generators") == 0
    rows = capsys.readouterr().out.splitlines()
    assert next(line for line in rows if line.startswith("wan2.2-5b")).split()[1] == "damaged"


@pytest.mark.parametrize("fps", ["own", None, Fraction(24), Fraction(30000, 1001), Fraction(23)])
def test_the_list_of_generators_has_the_facts_of_every_row(capsys, monkeypatch, fps):
    rows = [one if fps == "own" else replace(one, fps=fps) for one in MODELS.values()]
    monkeypatch.setattr("texvent.cli.setup.generators.MODELS", {one.name: one for one in rows})
    assert run("generators", "--json") == 0
    facts = {one["name"]: one for one in json.loads(capsys.readouterr().out)}
    assert {*facts} >= {*GENERATORS.entries(), *(one.name for one in rows)}
    monkeypatch.setenv("COLUMNS", "300")
    assert run("generators") == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines() if line}
    for row in rows:
        is_low = row.fps is not None and row.fps < 24
        said = facts[row.name]
        assert said["fps"] == (None if row.fps is None else float(row.fps))
        assert said["is_low_fps"] == is_low
        for name in ("frames", "width", "height", "gpu_gb", "offload_gb", "licence", "of_paper"):
            assert said[name] == getattr(row, name), name
        cells = re.split(r" {2,}", lines[row.name].strip())
        size = "image's" if row.width is None else f"{row.width}x{row.height}"
        gb = ["-" if one is None else f"{one:g}" for one in (row.gpu_gb, row.offload_gb)]
        rate = "not known" if row.fps is None else f"{row.fps} low" if is_low else f"{row.fps}"
        assert cells == [
            row.name + " *" * row.of_paper, rate, str(row.frames), size,
            "not known" if gb == ["-", "-"] else " / ".join(gb), row.licence_and_terms,
        ]  # fmt: skip
