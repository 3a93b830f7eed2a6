"""`texvent batch`: many samples, one run; stopped and taken up again."""

import io
import json
import multiprocessing
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from tests.cli.running import run

import texvent

QUICK = (
    *("--sensor", "48x36", "--duration", "0.1", "--samples", "1"),
    *("--previews", "none", "--interpolate", "none", "--noise", "none"),
)


def recordings(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.glob("*.h5"))}


def test_a_strict_batch_names_a_row_that_it_refuses_and_makes_nothing(folder, capsys):
    (folder / "p.txt").write_text("a wug and a dog run\na red ball bounces\nqwerty zxcv\n")
    assert run("batch", "p.txt", "-o", "out", "--strict", *QUICK) == 2
    said = capsys.readouterr().err
    assert "2 of 3 prompts are refused, such as p.txt line 1: strict: the prompt is not" in said
    assert not (folder / "out").exists()


def test_a_batch_keeps_the_report_of_every_prompt_and_counts_them(folder, capsys):
    (folder / "p.txt").write_text("a wug and a dog run\na red ball bounces\n")
    assert run("batch", "p.txt", "-o", "out", "--dry-run", *QUICK) == 0
    wug = "; 1 with words not understood (wug)"
    assert f"1 of 2 prompts understood word for word{wug}" in capsys.readouterr().out
    assert run("batch", "p.txt", "-o", "out", *QUICK) == 0
    assert f"1 of 2 prompts shown as they say{wug}" in capsys.readouterr().err
    lines = map(json.loads, (folder / "out" / "samples.jsonl").read_text().splitlines())
    reports = {one["prompt"]: one["prompt_report"] for one in lines}
    assert reports["a wug and a dog run"]["not_understood"] == ["wug"]
    assert "not_understood" not in reports["a red ball bounces"]
    (event_file, _) = sorted((folder / "out").glob("*.h5"))
    assert texvent.load(event_file).metadata["prompt_report"]["scene"]


def test_images_of_a_folder_each_shake_in_their_own_way(folder, capsys):
    rows, columns = np.mgrid[:40, :60]
    image = np.uint8(127 + 100 * np.sin(columns / 2) * np.cos(rows / 3))
    (folder / "photos").mkdir()
    for name in ("a.png", "b.png"):
        cv2.imwrite(str(folder / "photos" / name), image)
    words = ("batch", "photos", "--camera", "shake", "--duration", 0.1, "--noise", "none")
    assert run(*words, "-o", "out", "--previews", "none") == 0
    one, other = (texvent.load(path) for path in sorted((folder / "out").glob("*.h5")))
    assert len(one)
    assert not one.equals(other)
    alone = {"camera": "shake", "duration": 0.1, "noise": "none", "seed": one.metadata["seed"]}
    assert texvent.simulate(folder / "photos" / "a.png", **alone).equals(one)
    capsys.readouterr()
    assert run(*words, "-o", "out", "--previews", "none") == 0
    assert "kept     2 of 2 samples" in capsys.readouterr().err


def test_files_of_others_in_the_folder_are_not_replaced(folder, capsys):
    (folder / "p.csv").write_text("prompt,name\na dog runs,dog\n")
    (folder / "p").mkdir()
    (folder / "p" / "dog.h5").write_bytes(b"mine")
    assert run("batch", "p.csv", *QUICK) == 3
    assert "exists already" in capsys.readouterr().err
    assert (folder / "p" / "dog.h5").read_bytes() == b"mine"


def test_a_prompt_that_fails_does_not_end_the_others(folder, capsys):
    (folder / "p.txt").write_text("qwerty zxcv\na wug and a dog run\n")
    assert run("batch", "p.txt", *QUICK) == 1
    said = capsys.readouterr().err
    assert "failed   p.txt line 1: nothing in the prompt was understood: qwerty zxcv" in said
    assert "warning  p.txt line 2: prompt words not understood: wug" in said
    assert "error: 1 of 2 samples failed" in said
    assert len(recordings(folder / "p")) == 1


def test_videos_of_a_folder_are_samples(folder, capsys):
    for name in ("left", "right"):
        prompt = f"a red car drives {name}"
        clip = ["--video-only", "-o", f"clips/{name}.avi"]
        Path("clips").mkdir(exist_ok=True)
        assert run("generate", prompt, "--duration", "0.1", "--sensor", "48x36", *clip) == 0
    quick = ("--sensor", "48x36", "--previews", "none", "--interpolate", "none")
    assert run("batch", "clips", "-o", "events", *quick) == 0
    assert len(recordings(folder / "events")) == 2
    assert sorted(path.name for path in Path("clips").iterdir()) == ["left.avi", "right.avi"]
    previews = ("--sensor", "48x36", "--interpolate", "none")
    assert run("batch", "clips", "-o", "clips", *previews) == 3
    assert "among the files of the input" in capsys.readouterr().err


FLAT = ("--fps", 30, "--interpolate", "none", "--noise", "none", "--previews", "none")


def write_video(path: Path, seed: int) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    np.save(path, np.random.default_rng(seed).integers(0, 255, (4, 12, 16), dtype=np.uint8))


def counts(folder: Path) -> list[int]:
    return sorted(len(texvent.load(path)) for path in folder.glob("*.h5"))


def test_another_video_of_the_same_name_is_not_taken_for_done(folder, capsys):
    videos = [f"{name}/x/v.npy" for name in "ab"]
    for seed, video in enumerate(videos):
        write_video(folder / video, seed)
        assert run("batch", video, "-o", f"alone-{seed}", *FLAT) == 0
    expected = sorted(count for seed in (0, 1) for count in counts(folder / f"alone-{seed}"))
    assert len({*expected}) == 2
    for order in (videos[:1], videos[1:], videos[::-1], videos):
        assert run("batch", *order, "-o", "out", *FLAT) == 0
    assert counts(folder / "out") == expected
    assert "kept     2 of 2 samples, done before" in capsys.readouterr().err


def test_the_folder_of_another_version_is_refused_whatever_its_rows_hold(folder, capsys):
    write_video(folder / "v.npy", 0)
    assert run("batch", "v.npy", "-o", "out", *FLAT) == 0
    for name, key in (("batch.json", "texvent_version"), ("samples.jsonl", "inputs")):
        facts = json.loads((folder / "out" / name).read_text())
        (folder / "out" / name).write_text(json.dumps(dict(facts, **{key: None})) + "\n")
    assert run("batch", "v.npy", "-o", "out", *FLAT) == 2
    assert "made with other options: the version of texvent was not set" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("flag", "value"),
    [
        *(("palette", "dv"), ("previews", "png"), ("format", "npz"), ("seed", 1)),
        *(("preset", "paper"), ("contrast-threshold", 0.3), ("sensor", "8x8"), ("stop", 0.1)),
    ],
)
def test_a_batch_made_with_other_options_is_not_gone_on_with(folder, capsys, flag, value):
    write_video(folder / "v.npy", 0)
    words = ("batch", "v.npy", "-o", "out", *FLAT)
    assert run(*words) == 0
    before = {path.name: path.read_bytes() for path in (folder / "out").iterdir()}
    capsys.readouterr()
    assert run(*words, f"--{flag}", value) == 2
    assert f"made with other options: --{flag} was " in capsys.readouterr().err
    assert {path.name: path.read_bytes() for path in (folder / "out").iterdir()} == before
    assert run(*words) == 0


def test_options_of_a_batch_that_made_nothing_may_be_mended(folder, capsys):
    write_video(folder / "v.npy", 0)
    assert run("batch", "v.npy", "-o", "out", "--duration", 1, *FLAT) == 2
    assert "leave duration out" in capsys.readouterr().err
    assert run("batch", "v.npy", "-o", "out", "--stop", 0.1, *FLAT) == 0
    assert run("batch", "v.npy", "-o", "out", *FLAT) == 2
    assert "made with other options: --stop was 0.1" in capsys.readouterr().err


@pytest.mark.long
def test_several_processes_make_the_same_files(folder, monkeypatch):
    (folder / "p.txt").write_text("a red car drives left\na dog runs\na ball bounces\n")
    seen = {"1": set(), "2": set()}
    for jobs, ids in seen.items():

        class Watched(io.StringIO):
            def write(self, text, ids=ids):
                ids.update(one.pid for one in multiprocessing.active_children())
                return super().write(text)

        monkeypatch.setattr(sys, "stderr", Watched())
        assert run("batch", "p.txt", "-o", jobs, "--jobs", jobs, *QUICK) == 0
    assert [len(ids) for ids in seen.values()] == [0, 2]
    assert recordings(folder / "1") == recordings(folder / "2")
