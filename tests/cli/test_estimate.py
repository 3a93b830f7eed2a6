"""`--dry-run` says what the run then takes; times depend on the machine and are not tested."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

import texvent
from texvent.cli import trial_pairs
from texvent.cli.app import main

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
FACTOR = 1.7


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    drift = np.random.default_rng(2).integers(40, 200, (60, 160)).astype(np.uint8)
    np.save("drift.npy", np.stack([np.roll(drift, step, axis=1)[:, :80] for step in range(120)]))


def said_and_done(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, tuple[Any, float]]:
    """What the dry run says, and what the run makes: events, bytes in all and of events."""
    capsys.readouterr()
    assert main([*words, "-o", "out.h5", "--dry-run"]) == 0
    said = capsys.readouterr().out
    assert not list(Path().glob("out*"))
    assert main([*words, "-o", "out.h5", "-q"]) == 0
    events = re.search(r"about ([\d,]+)(?: \(([\d,]+) to ([\d,]+)\))? events", said)
    assert events is not None
    mean, *span = (float(one.replace(",", "")) for one in events.groups() if one)
    found: dict[str, tuple[Any, float]] = {
        "events": (span or [mean, mean], len(texvent.load("out.h5")))
    }
    unit = {"MB": 2**20, "KB": 2**10}
    patterns = {"out*": r"files  ([\d.,]+) (MB|KB):", "out.h5": r"([\d.,]+) (MB|KB) \.h5"}
    for names, pattern in patterns.items():
        size = re.search(pattern, said)
        assert size is not None
        written = sum(path.stat().st_size for path in Path().glob(names))
        found[names] = ([float(size[1].replace(",", "")) * unit[size[2]]] * 2, written)
    return found


def test_a_preview_shows_the_scene_and_says_what_is_shown_and_nothing_more(capsys):
    words = ["generate", "a wug and a red ball bounce", "--sensor", "64x48", "--duration", "0.5"]
    assert main([*words, "--preview", "scene.png", "-o", "out.h5"]) == 0
    said = capsys.readouterr()
    assert said.out == "scene.png\n"
    assert "scene    1 ball, red, bounces" in said.err
    assert "warning  prompt words not understood: wug" in said.err
    assert "warning  --preview stops before the events, so -o has no effect" in said.err
    assert not Path("out.h5").exists()
    image = cv2.imread("scene.png")
    assert image.shape == (48, 3 * 64 + 2 * 4, 3)
    assert not np.array_equal(image[:, :64], image[:, 68:132])
    assert main([*words, "--preview", "scene.png"]) == 3  # exists already
    assert main([*words, "--preview", "scene.jpg"]) == 2
    assert main([*words, "--preview", "a.png", "--generator", "wan-1.3b"]) == 2
    assert not Path("a.png").exists()


def test_a_dry_run_says_what_is_shown_of_the_prompt(capsys):
    words = ["generate", "a red ball bounces", "--sensor", "32x24", "--duration", "0.1"]
    assert main([*words, "--dry-run"]) == 0
    said = capsys.readouterr()
    assert "scene    1 ball, red, bounces" in said.err
    assert "about" in said.out
    assert not list(Path().glob("*.h5"))


@pytest.mark.parametrize(
    "words",
    [
        ("simulate", "drift.npy", "--fps", "60"),
        ("simulate", "drift.npy", "--fps", "60", "--simulator", "v2e", "--interpolate", "none"),
        ("simulate", str(CLIP), "--sensor", "80x60"),
        ("generate", "a ball bounces", "--sensor", "64x48", "--samples", "1", "--duration", "2"),
        ("simulate", "drift.npy", "--fps", "60", "--stop", "0.04"),
    ],
    ids=["array", "v2e", "video", "prompt", "three frames"],
)
def test_events_and_sizes_are_within_a_factor_of_the_run(capsys, words):
    for what, ((least, most), done) in said_and_done(capsys, *words).items():
        assert least / FACTOR <= done <= most * FACTOR, (what, least, most, done)


def test_a_single_frame_takes_nothing(capsys):
    np.save("one.npy", np.zeros((1, 8, 8), np.uint8))
    assert main(["simulate", "one.npy", "--fps", "30", "--dry-run"]) in (0, 2)
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "tried"),
    [
        (("simulate", "drift.npy", "--fps", "60"), "3 of 119"),
        (("simulate", "drift.npy", "--fps", "60", "--stop", "0.04"), "2 of 2"),
        (("generate", "a red ball bounces", "--sensor", "32x24"), "3 of 48"),
    ],
    ids=["video", "short video", "prompt"],
)
def test_three_pairs_are_tried_and_their_range_is_said(capsys, words, tried):
    assert main([*words, "--dry-run"]) == 0
    said = capsys.readouterr().out
    assert f"\ntried  {tried} pairs: " in said
    assert "rough" not in said


def test_when_the_time_is_over_a_pair_is_left_and_the_guess_is_called_rough(capsys, monkeypatch):
    monkeypatch.setattr(trial_pairs, "MOST_SECONDS", 0.0)
    count = ["--count", "fixed", "--fixed-count", "9", "--interpolate", "blend"]
    words = ["simulate", "drift.npy", "--fps", "60", *count, "--dry-run"]
    assert main(words) == 0
    said = capsys.readouterr().out
    assert "\ntried  1 of 119 pairs: " in said
    assert "rough guess, as less than 1 " in said
    assert "sizes not tried" in said


def test_a_dry_run_refuses_no_existing_file_as_it_replaces_none(capsys):
    Path("out.h5").write_text("mine", encoding="utf-8")
    words = ["simulate", "drift.npy", "--fps", "60", "-o", "out.h5"]
    assert main([*words, "--dry-run"]) == 0
    assert "note     the run needs --overwrite: there is already out.h5" in capsys.readouterr().err
    assert Path("out.h5").read_text(encoding="utf-8") == "mine"
    assert main(words) == 3


def test_slow_motion_adds_up_between_the_pairs_tried(capsys):
    x, t = np.arange(96), np.arange(61)[:, None] / 240
    rows = np.rint(128 + 80 * np.sin(2 * np.pi * (x - 40 * t) / 30)).astype(np.uint8)
    np.save("slow.npy", np.repeat(rows[:, None], 24, axis=1))
    words = ["simulate", "slow.npy", "--fps", "240", "--noise", "none", "--interpolate", "none"]
    assert main([*words, "-o", "a.h5", "--dry-run"]) == 0
    said = capsys.readouterr().out
    assert "slow change adds up" in said
    assert main([*words, "-o", "a.h5", "--events-only", "-q"]) == 0
    estimated = re.search(r"about ([\d,]+) events", said)
    assert estimated is not None
    done = len(texvent.load("a.h5"))
    assert done / 2 <= float(estimated[1].replace(",", "")) <= done * FACTOR
    assert main([*words, "--preset", "paper", "-o", "b.h5", "--dry-run"]) == 0
    assert "about 0 events" in capsys.readouterr().out  # which forgets, and makes none
