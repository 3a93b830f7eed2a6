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
