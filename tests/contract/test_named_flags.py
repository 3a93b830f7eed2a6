"""Every flag that a page, a help or an error names exists, and belongs to the command before it."""

import contextlib
import io
import re
from functools import cache
from pathlib import Path

import pytest

from texvent._registry import GENERATORS, SIMULATORS
from texvent.cli.app import all_commands, main
from texvent.cli.option_types import flag_of
from texvent.generation.video_models.config import DiffusersConfig
from texvent.options.values import option_names

ROOT = Path(__file__).parents[2]
FLAG = re.compile(r"(?<![\w-])--[a-z][a-z0-9-]*[a-z0-9](?![\w/-])")
CALL = re.compile(r"(?<![\w/.-])texvent (\w+)( \w+)?((?:[^\n`;|#]|\\\n)*)")
FOREIGN = {
    *("--allow", "--array", "--background", "--end", "--error-unmatch", "--exclude"),
    *(
        "--force-reinstall",
        "--gpus",
        "--head",
        "--show",
        "--hypothesis-profile",
        "--no-deps",
        "--num-cpus",
    ),
    *("--only-binary", "--packages-select", "--porcelain", "--python", "--repo-type", "--rm"),
    *(
        "--ros-args",
        "--untracked-files",
        "--user",
        "--version",
        "--on",
        "--help",
        "--table",
        "--show",
    ),
    *("--local-dir", "--save-dir", "--dataset", "--standalone", "--draw", "--real-size"),
    *("--only", "--whole", "--names", "--randomize", "--noise-hz", "--path", "--published"),
}
"""Flags of pip, git, Docker, ROS, Slurm and the like, of CSS, of tools/ and measure."""
PARTS = [*map(SIMULATORS.load, SIMULATORS.names()), *map(GENERATORS.load, GENERATORS.shipped())]
OF_PARTS = {
    flag_of(name)
    for config in (*(part.config_type for part in PARTS), DiffusersConfig)
    for name in option_names(config)
}


def help_of(*words: str) -> str:
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.suppress(SystemExit):
        main([*words, "--help", "all"])
    return out.getvalue()


@cache
def flags_of(command: str) -> set[str]:
    """Flags of a command and of its steps; of a run, also those of every model and generator."""
    page = help_of(command)
    steps = set(re.findall(rf"^  (?:texvent {command} )?(\w+) {{2,}}", page, re.MULTILINE))
    steps |= set(re.findall(rf"texvent {command} (\w+)", page))
    pages = page + "".join(help_of(command, step) for step in sorted(steps))
    found = set(FLAG.findall(pages))
    found |= OF_PARTS if "--contrast-threshold" in found or "--start-preset" in found else set()
    return found | {f"--no-{flag[2:]}" for flag in found} | {"--help"}


def files(*patterns: str) -> list[Path]:
    return sorted(path for pattern in patterns for path in ROOT.glob(pattern))


PAGES = files("README.md", "CONTRIBUTING.md", "docs/**/*.md", "ros/**/*.md", "comfyui/**/*.md")
SOURCES = files("src/**/*.py", "ros/**/*.py", "comfyui/**/*.py")


@pytest.mark.parametrize("kind", ["pages", "sources"])
def test_named_flags_exist(kind):
    known = FOREIGN.union(*map(flags_of, all_commands()))
    wrong = set()
    for path in PAGES if kind == "pages" else SOURCES:
        named = set(FLAG.findall(path.read_text(encoding="utf-8")))
        wrong |= {(str(path.relative_to(ROOT)), flag) for flag in named - known}
    assert not wrong


def test_flags_of_a_named_command_are_its_own():
    wrong = set()
    for path in (*PAGES, *SOURCES):
        text = re.sub(r'"\s*\n\s*f?"', "", path.read_text(encoding="utf-8"))
        for command, _, words in CALL.findall(text):
            if command in all_commands() and command not in ("doctor",):
                named = set(FLAG.findall(words))
                wrong |= {(path.name, command, flag) for flag in named - flags_of(command)}
    assert not wrong
