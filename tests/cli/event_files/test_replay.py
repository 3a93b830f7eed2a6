"""`texvent replay` makes the same bytes again, or says what is another one."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

import texvent
from texvent._version import full_version
from texvent.cli.app import main

CLIP = Path(__file__).parents[2] / "clips" / "bigbuckbunny_excerpt.mp4"
SCENE = ("a red car drives left", "--duration", "0.2", "--sensor", "64x48", "--samples", "1")


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run(*words: object) -> int:
    return main([str(word) for word in words])


def made_again(name: str, capsys: pytest.CaptureFixture[str], *words: object) -> bool:
    capsys.readouterr()
    assert run("replay", name, "-o", f"again-{name}", *words) == 0
    assert "the same bytes" in capsys.readouterr().out
    return Path(f"again-{name}").read_bytes() == Path(name).read_bytes()


@pytest.mark.parametrize(
    "options",
    [
        ("--simulator", "v2e", "--seed", "5"),
        ("--simulator", "esim", "--interpolate", "flow"),
        ("--simulator", "physical", "--randomize", "v2v", "--seed", "9"),
        ("--target-rate", "20000", "--label-noise", "--interpolate", "blend"),
    ],
    ids=lambda options: options[1],
)
def test_a_prompt_is_made_again(capsys, options):
    assert run("generate", *SCENE, *options, "--events-only", "-o", "a.h5") == 0
    assert made_again("a.h5", capsys)


@pytest.mark.parametrize("name", ["a.aedat4", "a.raw", "a.txt", "a.npz"])
def test_other_formats_are_made_again(capsys, name):
    assert run("generate", *SCENE, "--events-only", "-o", name) == 0
    assert made_again(name, capsys)


def test_a_format_that_the_extension_does_not_tell_is_made_again(capsys):
    assert run("generate", *SCENE, "--events-only", "-o", "a.h5", "--format", "dsec") == 0
    assert run("generate", *SCENE, "--events-only", "-o", "b.h5", "--format", "v2e") == 0
    assert made_again("a.h5", capsys)
    assert made_again("b.h5", capsys)


def test_a_video_is_made_again_where_it_was_or_beside_the_file(capsys):
    Path("data").mkdir()
    shutil.copy(CLIP, "data/clip.mp4")
    small = ("--stop", "0.2", "--sensor", "64x36", "--events-only")
    assert run("simulate", "data/clip.mp4", *small, "-o", "a.h5") == 0
    assert made_again("a.h5", capsys)
    Path("data/clip.mp4").rename("moved.mp4")
    assert run("replay", "a.h5") == 2
    assert "its source data/clip.mp4 is not here; name it with --source" in capsys.readouterr().err
    assert made_again("a.h5", capsys, "--source", "moved.mp4", "--overwrite")
    Path("moved.mp4").rename("clip.mp4")
    assert made_again("a.h5", capsys, "--overwrite")


def test_another_source_is_told(capsys):
    shutil.copy(CLIP, "clip.mp4")
    small = ("--stop", "0.2", "--sensor", "64x36", "--events-only")
    assert run("simulate", "clip.mp4", *small, "-o", "a.h5") == 0
    with Path("clip.mp4").open("ab") as file:
        file.write(b"\0")
    assert run("replay", "a.h5") == 1
    assert "its source was changed. --anyway" in capsys.readouterr().err
    assert not Path("a.replay.h5").exists()
    assert run("replay", "a.h5", "--anyway") == 1
    assert "the same events as a.h5, in other bytes" in capsys.readouterr().out


def test_a_prompt_with_its_video_is_made_again(capsys):
    assert run("generate", *SCENE, "--video-only", "-o", "v.avi") == 0
    assert run("simulate", "v.avi", "--prompt", SCENE[0], "--events-only", "-o", "a.h5") == 0
    assert made_again("a.h5", capsys)


def test_another_version_is_told(capsys):
    assert run("generate", *SCENE, "--events-only", "-o", "a.h5") == 0
    events = texvent.load("a.h5")
    changed = {**events.metadata, "texvent_version": "0.0.9"}
    events.with_metadata(changed).save("old.h5")
    assert run("replay", "old.h5") == 1
    assert f"version: was '0.0.9', is {full_version()!r}" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("metadata", "why"),
    [
        ({}, "does not say how it was made"),
        ({"settings": {}, "source": {"kind": "array", "source": "array"}}, "came from memory"),
        ({"settings": {}, "source": {}, "edits": [{"crop": "1"}]}, "was edited after its run"),
        (
            {"settings": {}, "source": {"source": "my clip.mp4"}, "complete": False},
            "makes it whole: texvent simulate 'my clip.mp4' --config a.h5 -o whole.h5",
        ),
        ({"settings": {"run": {"seed": "x"}}, "source": {}}, "seed"),
        ({"settings": {"run": {"none": 1}}, "source": {}}, "unknown option 'none'"),
    ],
)
def test_files_without_a_run_are_refused_in_one_line(capsys, metadata, why):
    stream = texvent.EventStream.from_columns([1], [1], [5], [1], size=(64, 48), metadata=metadata)
    stream.save("a.h5")
    assert run("replay", "a.h5") == 2
    said = capsys.readouterr().err
    assert why in said
    assert len(said.splitlines()) == 1
    assert [path.name for path in Path().iterdir()] == ["a.h5"]


def test_the_options_of_a_file_serve_another_run(capsys):
    words = ("--simulator", "v2e", "--seed", "5", "--events-only")
    assert run("generate", *SCENE, *words, "-o", "a.h5") == 0
    assert run("generate", "a dog runs", "--config", "a.h5", "--events-only", "-o", "b.h5") == 0
    assert texvent.load("b.h5").metadata["settings"] == texvent.load("a.h5").metadata["settings"]
    np.save("f.npy", np.full((4, 48, 64), 90, np.uint8))
    small = ("--fps", "30", "--interpolate", "none", "--events-only")
    assert run("simulate", "f.npy", "--config", "a.h5", *small, "-o", "c.h5") == 0
    assert texvent.load("c.h5").metadata["simulator"] == "v2e"
