"""The page opened in a real browser: it draws, and it asks nothing of the network."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.view.page import show

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--virtual-time-budget=2000",
)

pytestmark = pytest.mark.skipif(
    BROWSER is None, reason="chromium is not installed, so the page was not opened"
)


def cube_of_events() -> EventStream:
    index = np.arange(20_000)
    return EventStream(
        index * 7 % 64, index * 13 % 48, index * 100, index % 2, SensorSize(64, 48), {"prompt": "p"}
    )


def browse(folder: Path, page: Path, *arguments: str) -> str:
    finished = subprocess.run(
        [
            str(BROWSER),
            *OPTIONS,
            f"--user-data-dir={folder / 'profile'}",
            *arguments,
            page.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    return finished.stdout


def screenshot(folder: Path, page: Path, width: int) -> np.ndarray:
    target = folder / "shot.png"
    browse(folder, page, f"--window-size={width},1100", f"--screenshot={target}")
    picture = cv2.imread(str(target))
    assert picture is not None
    return picture


def coloured_pixels(picture: np.ndarray) -> tuple[int, int]:
    """How many pixels are blue and how many are red."""
    signed = picture[..., 0].astype(int) - picture[..., 2]
    return int((signed > 60).sum()), int((signed < -60).sum())


def page_with_only_the_cloud(folder: Path) -> Path:
    page = show(cube_of_events(), folder / "out.html")
    hide = "<style>.still, .rate, .controls { display: none }</style></head>"
    alone = folder / "alone.html"
    alone.write_text(page.read_text("utf-8").replace("</head>", hide), encoding="utf-8")
    return alone


@pytest.mark.parametrize("width", [1280, 500])
def test_the_cloud_is_drawn_in_both_colours(tmp_path: Path, width: int) -> None:
    blue, red = coloured_pixels(screenshot(tmp_path, page_with_only_the_cloud(tmp_path), width))
    assert min(blue, red) > 3_000
    assert 0.5 < blue / red < 2.0


def test_the_controls_work_and_nothing_overflows_a_narrow_screen(tmp_path: Path) -> None:
    page = show(cube_of_events(), tmp_path / "out.html")
    probe = """<script>
      document.getElementById("toggle-off").click();
      const length = document.getElementById("length");
      length.value = 100;
      length.dispatchEvent(new Event("input"));
      document.querySelector("[data-view=top]").click();
      document.getElementById("play").click();
      const text = (id) => document.getElementById(id).textContent;
      document.title = [
        document.getElementById("toggle-off").getAttribute("aria-pressed"),
        document.getElementById("play").getAttribute("aria-pressed"),
        text("length-text"),
        document.getElementById("cloud-fallback").hidden,
        document.documentElement.scrollWidth <= window.innerWidth,
      ].join("|");
    </script></body>"""
    probed = page.with_name("probed.html")
    probed.write_text(page.read_text("utf-8").replace("</body>", probe), encoding="utf-8")
    dom = browse(tmp_path, probed, "--window-size=500,900", "--dump-dom")
    assert "<title>false|true|199.99 ms|true|true</title>" in dom


def test_a_browser_without_webgl_says_what_is_missing(tmp_path: Path) -> None:
    page = show(cube_of_events(), tmp_path / "out.html")
    dom = browse(tmp_path, page, "--disable-3d-apis", "--dump-dom")
    assert '<p class="fallback" id="cloud-fallback">This browser offers no WebGL' in dom
