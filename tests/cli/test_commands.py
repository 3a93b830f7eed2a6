"""The command line as a user meets it: results, summaries, and one line for every mistake."""

import json
import resource
import subprocess
import sys
import tomllib
from pathlib import Path

import av
import cv2
import h5py
import numpy as np
import pytest
from tests.cli.running import refused, run

import texvent
from texvent.cli.app import main
from texvent.errors import InputError

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
QUICK = ["--interpolate", "none", "--stop", "0.2"]
PROMPT = "a red ball bounces on the grass"


def test_the_whole_path_on_a_real_video(folder, capsys):
    assert run("simulate", CLIP, "-o", "out.h5", "--seed", 3) == 0
    assert capsys.readouterr().out.split() == [
        "out.h5",
        "out.events.mp4",
        "out.events.png",
        "out.events.html",
    ]
    with h5py.File("out.h5") as file:
        assert (file.attrs["width"], file.attrs["height"]) == (320, 180)
        stored = json.loads(file.attrs["texvent"])
    assert stored["seed"] == 3
    assert stored["settings"]["simulate"]["balance"] == 20.0
    assert stored["texvent_version"].startswith(texvent.__version__)
    events = texvent.load("out.h5")
    assert len(events) > 20_000
    assert np.all(np.diff(events.t) >= 0)
    # Events at many times inside the frame interval, not clumped at frame times.
    assert len(np.unique(events.t % 40_000)) > 5_000
    with av.open("out.events.mp4") as video:
        assert video.streams.video[0].codec_context.width >= 2 * 320
    assert cv2.imread("out.events.png") is not None
    page = Path("out.events.html").read_text(encoding="utf-8")
    assert "http://" not in page
    assert "https://" not in page


def test_the_api_gives_the_events_that_the_command_writes(folder):
    assert (
        run("simulate", CLIP, "-o", "out.h5", "--previews", "none", "-q", "--seed", 3, *QUICK) == 0
    )
    direct = texvent.simulate(CLIP, interpolate="none", stop=0.2, seed=3)
    assert texvent.load("out.h5").equals(direct)


def test_printed_options_read_back_give_the_same_options(folder, capsys):
    words = ["simulate", CLIP, "--balance", "15", "--fps", "30000/1001", "--no-detect-cuts"]
    assert run(*words, "--print-config") == 0
    printed = capsys.readouterr().out
    Path("run.toml").write_text(printed, encoding="utf-8")
    assert tomllib.loads(printed)["capture"]["fps"] == "30000/1001"
    assert run("simulate", CLIP, "--config", "run.toml", "--print-config") == 0
    assert capsys.readouterr().out == printed
    assert run("simulate", CLIP, "--config", "run.toml", "--balance", 20, "--print-config") == 0
    assert tomllib.loads(capsys.readouterr().out)["simulate"]["balance"] == 20.0


def test_the_options_of_an_event_file_make_it_again_and_serve_another_run(folder):
    scene = ("a red car drives left", "--previews", "none")
    words = ("--duration", "0.2", "--sensor", "48x36", "--simulator", "v2e", "--seed", "5")
    assert run("generate", *scene, *words, "-o", "a.h5") == 0
    assert run("generate", *scene, "--config", "a.h5", "-o", "b.h5") == 0
    assert Path("a.h5").read_bytes() == Path("b.h5").read_bytes()
    np.save("f.npy", np.full((4, 48, 64), 90, np.uint8))
    small = ("--fps", "30", "--interpolate", "none", "--previews", "none")
    assert run("simulate", "f.npy", "--config", "a.h5", *small, "-o", "c.h5") == 0
    assert texvent.load("c.h5").metadata["simulator"] == "v2e"


def test_the_version_is_said(capsys):
    assert run("--version") == 0
    assert texvent.__version__ in capsys.readouterr().out


def test_an_unknown_command_is_named(capsys):
    assert "did you mean 'simulate'" in refused(capsys, "simulat")
    assert "allowed: generate, batch, dataset, " in refused(capsys, "frobnicate")


def test_packages_add_commands_but_replace_none_and_break_only_their_own(install, capsys):
    added = "COMMANDS = {'scenes': ('extra:none', ''), 'extra': ('extra', '')}\n"
    points = "[texvent.commands]\nmine = extra:COMMANDS\n"
    install("extra", points, extra=f"{added}def run(words): return 7\n")
    assert (run("extra"), run("scenes", "mug")) == (7, 0)
    install("broken", "[texvent.commands]\nbroken = broken_module:COMMANDS\n")
    assert run("scenes", "mug") == 0
    said = refused(capsys, "extra", codes=(1,))
    assert "command 'broken' of another package cannot be loaded from broken_module" in said


def test_an_empty_path_is_refused():
    with pytest.raises(InputError, match="the path is empty; give the name"):
        texvent.simulate("")


def test_existing_outputs_are_kept_unless_told_otherwise(folder, capsys):
    Path("out.events.png").write_text("mine", encoding="utf-8")
    said = refused(capsys, "simulate", CLIP, "-o", "out.h5", *QUICK, codes=(3,))
    assert "out.events.png exists already" in said
    assert Path("out.events.png").read_text(encoding="utf-8") == "mine"
    assert [path.name for path in folder.iterdir()] == ["out.events.png"]
    assert run("simulate", CLIP, "-o", "out.h5", "-q", "--overwrite", *QUICK) == 0
    assert Path("out.events.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.long
def test_a_file_that_the_system_refuses_to_grow_is_one_line(folder):
    words = [sys.executable, "-m", "texvent.cli.app", "simulate", str(CLIP), "-o", "out.h5"]
    limit = 64 * 1024  # bytes; stands for a quota or a file system's own limit
    done = subprocess.run(
        [*words, "--previews", "none", "-q"],
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )
    assert done.returncode == 3
    assert done.stderr.startswith("error: ")
    assert len(done.stderr.splitlines()) == 1
    assert not list(folder.iterdir())


@pytest.mark.parametrize(
    ("word", "family", "name"),
    [("strol", "", ""), ("stroll", "motion", "walk"), ("meadow", "place", "grass"),
     ("twilight", "light", "dusk"), ("dark red", "colour", "red"), ("wooden", "material", "wood"),
     ("mist", "weather", "fog"), ("pan", "camera move", "pan"), ("atop", "relation", "on")],
)  # fmt: skip
def test_all_that_a_sentence_says_can_be_looked_up(word, family, name, capsys) -> None:
    assert (main(["scenes", word]) == 0) is bool(family)
    said = capsys.readouterr()
    rows = [row.split() for row in said.out.splitlines()]
    assert any(row[: len(family.split()) + 1] == [*family.split(), name] for row in rows) or (
        "is in no list; did you mean 'stroll'" in said.err
    )


@pytest.mark.parametrize(("word", "found"), [("meadows", "grass"), ("reefs", "underwater")])
def test_a_plural_is_found_and_not_listed(word, found, capsys):
    assert main(["scenes", word]) == 0
    printed = capsys.readouterr().out
    assert found in printed
    assert word not in printed
