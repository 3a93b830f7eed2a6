"""Help fits a screen: what matters first, the rest by section."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from texvent.cli.app import COMMANDS, main

COLUMNS, LINES = 80, 40
EVERY_COMMAND = [
    (),
    *((name,) for name in COMMANDS if name not in ("data", "weights")),
    ("data",),
    ("data", "pull"),
    ("weights",),
    ("weights", "pull"),
]
MATTER = ("--out", "--sensor", "--simulator", "--preset", "--contrast-threshold", "--noise")


@pytest.fixture
def show(capsys, monkeypatch):
    """What a command line prints in a terminal of 80 columns, which must succeed."""
    monkeypatch.setenv("COLUMNS", str(COLUMNS))

    def shown(*words):
        assert main(words) == 0
        return capsys.readouterr().out

    return shown


@pytest.mark.parametrize("command", EVERY_COMMAND, ids=" ".join)
def test_help_of_every_command_fits_one_screen(show, command):
    lines = show(*command, "--help").splitlines()
    assert len(lines) <= LINES
    assert max(map(len, lines)) <= COLUMNS


@pytest.mark.parametrize("command", ["simulate", "generate"])
def test_help_shows_what_matters_two_examples_and_where_the_rest_is(show, command):
    said = show(command, "--help")
    assert all(f"{flag} " in said for flag in MATTER)
    assert said.count(f"\n  texvent {command} ") == 2
    assert "--max-intermediate" not in said
    assert f"texvent {command} --help all" in said
    assert "interpolate or simulate" in said


@pytest.mark.parametrize("command", ["simulate", "generate", "batch"])
def test_help_all_shows_every_option_in_its_section(show, command):
    said = show(command, "--help", "all")
    sections = ("input", "output", "run", "interpolate", "simulate")
    assert all(f"\n{section}:\n" in said for section in sections)
    assert all(flag in said for flag in (*MATTER, "--max-intermediate", "--no-detect-cuts"))


@pytest.mark.parametrize("flag", ["--help", "-h"])
def test_a_prompt_may_be_a_flag_of_help(capsys, flag):
    assert main(["generate", "--dry-run", "--", flag]) == 2
    assert "nothing in the prompt was understood" in capsys.readouterr().err


def test_help_of_a_section_shows_that_section_alone(show):
    said = show("simulate", "--help", "interpolate")
    assert "--max-intermediate" in said
    assert "--previews" not in said
    assert show("simulate", "--help=output") == show("simulate", "--help", "output")


def test_the_options_of_a_named_simulator_are_shown(show):
    assert "--cutoff-hz" in show("simulate", "--simulator", "v2e", "--help", "simulator")
    assert "--cutoff-hz" in show("simulate", "--help", "all", "--simulator", "v2e")
    assert "--cutoff-hz" not in show("simulate", "--help", "all")


def test_help_is_readable_where_the_terminal_knows_ascii_only():
    plain = {**os.environ, "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}
    words = [sys.executable, "-m", "texvent.cli.app", "generate", "--help", "all"]
    done = subprocess.run(words, env=plain, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()
    assert b"--contrast-threshold" in done.stdout


def test_help_of_an_installed_wheel_says_where_the_pages_are_that_it_names(show, monkeypatch):
    place = "The pages of docs/ are in texvent's repository"
    assert place not in show("simulate", "--help", "all")
    monkeypatch.setattr("texvent.cli.help.CHECKOUT", Path("/elsewhere"))
    assert place in show("simulate", "--help", "all")
