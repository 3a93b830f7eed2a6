"""Jobs that run commands from a pipe, advice of `texvent check`, and stills of `--preview`."""

import json
import re
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.cli.app import main
from texvent.options.values import option_names
from texvent.settings.resolution import resolve
from texvent.video_check.checks import CHECKS


@pytest.mark.parametrize(("commands", "runs", "code"), [("vv", 2, 0), ("vxv", 1, 2), ("x", 0, 2)])
def test_a_job_runs_its_commands_until_one_fails(commands: str, runs: int, code: int) -> None:
    words = {"v": ["scenes", "--help"], "x": ["no-command"]}
    job = [sys.executable, "-m", "texvent.cli.simulation.job"]
    with subprocess.Popen(job, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(json.dumps([words[one] for one in commands]) + "\n")
        process.stdin.flush()
        said = process.stdout.read()  # its end of the pipe stays open until the job is over
        assert (said.count("usage: "), process.wait(60)) == (runs, code)


OF_GENERATE = {"seed", "on_failure"}


def test_advice_names_options_that_exist():
    settings = resolve("simulate", {})
    known = {name for group in settings.groups().values() for name in option_names(type(group))}
    named = r"(?:`|\b)([a-z_]+)(?:`|=')"
    advised = {name for check in CHECKS for name in re.findall(named, check.help)}
    assert advised <= known | OF_GENERATE
    assert "deflicker" in advised


def test_a_preview_shows_the_scene_and_says_what_is_shown_and_nothing_more(folder, capsys):
    words = ["generate", "a wug and a red ball bounce", "--sensor", "64x48", "--duration", "0.5"]
    assert main([*words, "--preview", "scene.png"]) == 0
    said = capsys.readouterr()
    assert said.out == "scene.png\n"
    assert 'scene    objects: noun = "ball", colour = "red"' in said.err
    assert "warning  prompt words not understood: wug" in said.err
    assert [path.name for path in Path().iterdir()] == ["scene.png"]
    image = cv2.imread("scene.png")
    assert image.shape == (48, 3 * 64 + 2 * 4, 3)
    assert not np.array_equal(image[:, :64], image[:, 68:132])
    assert main([*words, "--preview", "scene.png"]) == 3  # exists already
