"""`--dry-run`: parts of a clip say what the whole run would take."""

import itertools
from pathlib import Path
from unittest import mock

import cv2
import numpy as np
import pytest
from tests.capture.conftest import ClipWriter

import texvent
from texvent.cli.app import main
from texvent.cli.run import estimate_run
from texvent.frames import Video
from texvent.pipeline import video_to_events
from texvent.settings.resolution import resolve
from texvent.simulation.texvent.simulator import TexventSimulator

pytestmark = pytest.mark.usefixtures("folder")
FRAMES = np.random.default_rng(1).integers(0, 256, (7, 12, 16), dtype=np.uint8)
OPTIONS = {"interpolate": "none", "noise": "none", "seed": 1}


def estimate(frames):
    video = Video(frames, [20_000 * i for i in range(len(frames))])
    return estimate_run(video_to_events(video, resolve("simulate", OPTIONS)))


def test_all_pairs_of_a_short_clip_are_counted():
    said = estimate(FRAMES)
    assert f"about {len(texvent.simulate(FRAMES, fps=50, **OPTIONS)):,.0f} events in " in said
    assert "6 of 6 pairs" in said


@pytest.mark.parametrize("begin", [30, 50])
def test_what_happens_late_in_a_clip_is_counted(begin):
    """A clip that stands still at first and then flickers as much at every frame."""
    steps = np.arange(60) // 2 * 60 % 120 * (np.arange(60) >= begin)
    frames = np.broadcast_to((60 + steps)[:, None, None], (60, 12, 16)).astype(np.uint8)
    said = estimate(frames)
    true = len(texvent.simulate(frames, fps=50, **OPTIONS))
    assert "12 of 59 pairs" in said
    guess = float(said.split()[1].replace(",", ""))
    assert 0.3 * true < guess < 3 * true


@pytest.mark.parametrize("count", [13, 40, 61])
def test_an_estimate_is_the_mean_of_the_pairs_of_four_parts_each_rested_for_one(count):
    """Of a short clip, all; the first pair of a later part does not count, nor its rest before."""
    frames = np.random.default_rng(count).integers(0, 256, (count, 12, 16), dtype=np.uint8)
    starts = [part * (count - 4) // 3 for part in range(4)] if count > 13 else [0]
    parts = [range(start, start + 4 if count > 13 else count) for start in starts]
    found = []
    for part in parts:
        times_us = 20_000 * np.array(part)
        events = texvent.simulate(frames[part], t_us=times_us, **OPTIONS)
        pairs = [len(events.between(*one)) for one in itertools.pairwise(times_us.tolist())]
        found += pairs[1:] if part.start else pairs
    assert f"about {np.mean(found) * (count - 1):,.0f} events in " in estimate(frames)


@pytest.mark.parametrize("compiles_s", [0.0, 1000.0])
def test_compilation_is_no_part_of_the_time_of_the_whole(compiles_s):
    """By a clock on which a frame takes 1/4 s, and the first one the time of compilation too."""
    now, calls, advance = [0.0], itertools.count(), TexventSimulator.advance

    def slow(simulator, pair):
        now[0] += 0.25 if next(calls) else 0.25 + compiles_s
        return advance(simulator, pair)

    with (
        mock.patch.object(TexventSimulator, "advance", slow),
        mock.patch("texvent.cli.run.time.perf_counter", side_effect=lambda: now[0]),
    ):
        said = estimate(np.resize(FRAMES, (61, 12, 16)))
    assert " in 20.0 s (12 of 60 pairs" in said


def write_images(times_us):
    Path("frames").mkdir()
    for index in range(len(times_us)):
        cv2.imwrite(f"frames/{index:03}.png", FRAMES[index % len(FRAMES)])
    names = [f"{t_us / 1e6} {index:03}.png" for index, t_us in enumerate(times_us)]
    Path("frames/images.txt").write_text("\n".join(names), encoding="utf-8")
    return "frames"


def write_film(times_us):
    frames = np.resize(FRAMES, (len(times_us), 12, 16))
    kinds = {"codec": "ffv1", "stored": "gray", "given": "gray"}
    times_ms = [t_us // 1000 for t_us in times_us]
    return str(ClipWriter(Path()).write("film.mkv", frames, times_ms=times_ms, **kinds))


@pytest.mark.parametrize("write", [write_images, write_film])
def test_a_dry_run_finds_the_jumps_that_the_run_finds(write, capsys):
    late = [40_000 * i + 86_400_000_000 * (i >= 10) for i in range(12)]
    words = ["simulate", write(late), "--noise", "none", "--previews", "none"]
    for more in (["--dry-run"], ["-o", "a.h5"]):
        assert main([*words, *more]) == 2
        assert "after 0.36 s the next frame is 86,400 s later" in capsys.readouterr().err
    assert main([*words, "--dry-run", "--stop", "0.3"]) == 0
    assert "later" not in capsys.readouterr().err


def write_joined(times_us):
    """A stream that begins again in its middle."""
    frames = [np.full((48, 64, 3), 9 * level, np.uint8) for level in range(len(times_us))]
    path = ClipWriter(Path()).write("joined.mpg", frames, codec="mpeg2video", ticks=25)
    path.write_bytes(path.read_bytes() * 2)
    return str(path)


@pytest.mark.parametrize(
    ("write", "words"),
    [(write_joined, "280000"), (write_film, "t.txt has 5 times")],
)
def test_a_dry_run_finds_times_that_the_run_refuses(write, words, capsys):
    Path("t.txt").write_text("0\n.1\n.2\n.3\n.4\n")
    given = ["simulate", write([40_000 * i for i in range(8)]), "--interpolate", "none"]
    given += ["--timestamps", "t.txt"] * (write is write_film)
    for more in (["--dry-run"], ["-o", "a.h5", "--previews", "none"]):
        assert main([*given, *more]) == 2
        assert words in capsys.readouterr().err


def test_a_dry_run_says_what_is_shown_of_the_prompt(capsys):
    words = ["generate", "a red ball bounces", "--sensor", "32x24", "--duration", "0.1"]
    assert main([*words, "--dry-run"]) == 0
    said = capsys.readouterr()
    assert 'scene    objects: noun = "ball", colour = "red"' in said.err
    assert "about" in said.out
    assert "memory" in said.out
    assert not list(Path().iterdir())


def test_a_dry_run_refuses_no_existing_file_as_it_replaces_none(capsys):
    np.save("drift.npy", FRAMES)
    Path("out.h5").write_text("mine", encoding="utf-8")
    words = ["simulate", "drift.npy", "--fps", "60", "-o", "out.h5"]
    assert main([*words, "--dry-run"]) == 0
    assert "note     the run needs --overwrite: there is already out.h5" in capsys.readouterr().err
    assert Path("out.h5").read_text(encoding="utf-8") == "mine"
    assert main(words) == 3


def test_a_share_of_a_pair_of_a_scene_with_fast_light_tells_what_all_take(capsys):
    Path("fast.toml").write_text(
        '[[objects]]\nnoun = "box"\n[light]\nflicker_hz = 400\n[place]\nname = "plain"\n'
    )
    wanted = ["generate", "fast.toml", "--dry-run", "--duration", "0.2", "--sensor", "24x18"]
    assert main(wanted) == 0
    whole = capsys.readouterr().out
    with mock.patch("texvent.cli.run.MOST_SECONDS", 0.0):
        assert main(wanted) == 0
    brief = capsys.readouterr().out
    assert " (0." in brief
    guess, true = (float(one.split()[1].replace(",", "")) for one in (brief, whole))
    assert 0.2 * true < guess < 5.0 * true
