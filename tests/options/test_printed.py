"""Frozen reports: what commands print of small inputs, word by word and figure by figure.

After a wanted change, run `python -m tests.options.test_printed` and read the difference.
"""

from __future__ import annotations

import functools
import os
import re
import tempfile
from pathlib import Path

import pytest
from tests.options.inputs_of_commands import make_inputs
from tests.options.runs_of_commands import Outcome, run_once
from tests.options.tries import COMMANDS_TRIED, EVENTS, FLICKER

PRINTED = Path(__file__).with_name("printed.txt")
ELAPSED = re.compile(r"(computed in |made in |\.tar: .* events, )[\d.,]+ \w+")
OTHER_TESTS = ("scenes", "generators", "doctor")
"""Commands that print a table of the program, or facts of the machine."""
COMMANDS = (
    *(one.words for name, one in COMMANDS_TRIED.items() if name not in OTHER_TESTS),
    FLICKER,
    "check ../clip.npy --fps 5",
    "check ../cut.npy --fps 25 --all",
    f"compare {EVENTS} ../others.h5 --metrics stpp,nearest,on_difference,active_iou",
    f"info {EVENTS} --all",
    "info ../plain.csv --sensor 16x12",
    "validate ../rest.npz",
    "convert ../damaged.csv o.npz --sensor 16x12 --repair",
    "dataset verify ../cars --workers 1",
    "data list",
    "weights list",
)


def report_of(command: str, seen: Outcome) -> str:
    """What a run printed, without what differs from machine to machine."""
    text = ELAPSED.sub(r"\1TIME", f"{seen.printed}{seen.errors}")
    text = re.sub(r"\d+\.\d+\.\d+\+g[.\w]+", "VERSION", text)
    text = re.sub(r"/\S*/run\b", "FOLDER", text)
    lines = [line.rstrip() for line in text.splitlines()]
    return "\n".join([f"$ texvent {command}", *lines, ""])


@pytest.mark.parametrize("command", COMMANDS)
def test_a_report_is_as_it_was(command, outcome, monkeypatch, tmp_path):
    for name, value in environment(tmp_path).items():
        monkeypatch.setenv(name, value)
    assert report_of(command, outcome(command)) in PRINTED.read_text(encoding="utf-8")


def environment(folder: Path) -> dict[str, str]:
    """Variables of all runs: the width of a page, and folders without downloads."""
    return {"COLUMNS": "100", "TEXVENT_DATA": str(folder), "TEXVENT_CACHE": str(folder)}


def _write() -> None:
    with tempfile.TemporaryDirectory() as folder:
        os.environ.update(environment(Path(folder) / "empty"))
        make_inputs(Path(folder))
        run = functools.partial(run_once, Path(folder))
        PRINTED.write_text("\n".join(report_of(one, run(one)) for one in COMMANDS))


if __name__ == "__main__":
    _write()
