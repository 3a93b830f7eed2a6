"""The main commands in a folder whose name has spaces, an umlaut, a dash and Chinese characters."""

from pathlib import Path

import cv2
import numpy as np
import pytest

import texvent
from texvent.cli.app import main

NAME = "Ereignis daten – 事件 ü"
SPECIFICATION = """
name = "cubes"
filters = { min_events = 1 }
splits = { train = 1.0 }

[[sources]]
videos = ["Bilder mit Leer zeichen.npy"]
label = "größer"

[options]
fps = 100
interpolate = "none"
noise = "none"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("named") / NAME
    folder.mkdir()
    frames = np.random.default_rng(0).uniform(0, 255, (4, 24, 32)).astype(np.float32)
    np.save(folder / "Bilder mit Leer zeichen.npy", frames)
    (folder / "Bilder 图").mkdir()
    for number, frame in enumerate(frames):
        # OpenCV's own writer takes no such name on every system.
        cv2.imencode(".png", frame)[1].tofile(folder / "Bilder 图" / f"bild {number} é.png")
    texvent.simulate(frames, fps=100, noise="none").save(folder / "ereignisse 事件.h5")
    return folder


@pytest.fixture(autouse=True)
def _inside(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)


def run(*words: object) -> int:
    return main([str(word) for word in words])


@pytest.mark.parametrize("source", ["Bilder mit Leer zeichen.npy", "Bilder 图"])
@pytest.mark.parametrize("is_absolute", [False, True])
def test_simulate(folder: Path, source: str, is_absolute: bool) -> None:
    begin = folder if is_absolute else Path()
    out = begin / f"aus {source.split()[-1]} ø.h5"
    options = ("--fps", 100, "--interpolate", "none", "--overwrite")
    assert run("simulate", begin / source, "-o", out, *options) == 0
    assert len(texvent.load(out)) > 0
    assert {path.suffix for path in folder.glob(f"{out.stem}*")} == {".h5", ".mp4", ".png", ".html"}


@pytest.mark.parametrize("extension", ["aedat4", "raw", "csv", "npz", "dat", "bag", "mcap"])
def test_convert_and_info(extension: str, capsys: pytest.CaptureFixture[str]) -> None:
    target = f"umge wandelt 事.{extension}"
    assert run("convert", "ereignisse 事件.h5", target) == 0
    assert run("info", target) == 0
    assert target in capsys.readouterr().out
    assert len(texvent.load(target)) == len(texvent.load("ereignisse 事件.h5"))


@pytest.mark.parametrize("extension", ["mp4", "gif", "png", "html"])
def test_render(extension: str) -> None:
    target = Path(f"Bild – 事件.{extension}")
    assert run("render", "ereignisse 事件.h5", "-o", target) == 0
    assert target.stat().st_size > 0


def test_dataset_make(folder: Path) -> None:
    (folder / "Daten satz 事.toml").write_text(SPECIFICATION, encoding="utf-8")
    assert (
        run("dataset", "make", "Daten satz 事.toml", "-o", "Satz 1 事", "--workers", 1, "-q") == 0
    )
    samples = texvent.dataset.open("Satz 1 事")
    assert samples.labels == ("größer",)
    assert len(samples[0].events) > 0
    assert run("dataset", "verify", "Satz 1 事") == 0
