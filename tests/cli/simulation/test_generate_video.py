"""`--video-only` and `texvent generators`, as a user meets them."""

import json
from fractions import Fraction

import h5py
import numpy as np
import pytest
from tests.cli.running import run

import texvent
from texvent.errors import FileFormatError
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
