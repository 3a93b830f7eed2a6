from __future__ import annotations

import webbrowser
from pathlib import Path

import numpy as np
import pytest
from tests.cli.running import run

from texvent.events import EventStream
from texvent.sensor import SensorSize

CLIP = Path(__file__).parents[2] / "clips" / "bigbuckbunny_excerpt.mp4"
SCENE = ["--duration", "0.2", "--fps", "10", "--sensor", "48x36", "--samples", "1"]


@pytest.fixture
def recording(folder) -> Path:
    step = np.arange(500)
    size = SensorSize(32, 18)
    return EventStream(step % 32, step % 18, step * 400, step % 2, size).save(folder / "in.h5")


@pytest.fixture
def generated(folder) -> Path:
    words = ("generate", "a red ball bounces", "-o", "scene.h5", "--previews", "none", "-q", *SCENE)
    assert run(*words) == 0
    return folder / "scene.h5"


def test_view_opens_a_temporary_page(recording, monkeypatch, tmp_path, capsys) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda url: opened.append(url) or True)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert run("view", recording) == 0
    page = Path(capsys.readouterr().out.strip())
    assert opened == [page.as_uri()]
    assert "Shows all 500 events." in page.read_text("utf-8")


def test_view_saves_a_page_with_the_video_beside_and_opens_nothing(recording, monkeypatch) -> None:
    monkeypatch.setattr(webbrowser, "open", lambda url: pytest.fail("nothing was to be opened"))
    assert run("view", recording, "-o", "page.html", "--video", CLIP, "--points", 100) == 0
    page = Path("page.html").read_text("utf-8")
    assert "Shows 100 of 500 events" in page
    assert page.count("data:image/jpeg") > 3


def test_a_generated_recording_is_seen_with_its_scene_unless_told_not_to(generated) -> None:
    assert run("view", generated, "-o", "with.html") == 0
    assert Path("with.html").read_text("utf-8").count("data:image/jpeg") == 2
    assert run("view", generated, "-o", "without.html", "--video", "none") == 0
    assert "data:image/jpeg" not in Path("without.html").read_text("utf-8")


def test_a_part_of_the_time_is_shown_alone(recording) -> None:
    assert run("view", recording, "-o", "part.html", "--time", "0.04,0.12") == 0
    page = Path("part.html").read_text("utf-8")
    # One event every 400 µs, from 40 ms to 120 ms.
    assert "Shows all 200 events." in page
    assert run("render", recording, "-o", "part.png", "--time", "0.04,0.12") == 0
    assert run("render", recording, "-o", "whole.png") == 0
    assert Path("part.png").read_bytes() != Path("whole.png").read_bytes()
