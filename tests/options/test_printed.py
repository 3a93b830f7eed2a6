"""Frozen reports: what commands print of small inputs, word by word and figure by figure.

After a wanted change, run `python -m tests.options.test_printed` and read the difference.
"""

import functools
import re
import tempfile
from pathlib import Path

import pytest
from tests.options.inputs_of_commands import make_inputs
from tests.options.runs_of_commands import Outcome, run_once
from tests.options.tries import COMMANDS_TRIED, EVENTS, FLICKER, read_lines

from texvent._version import full_version

PRINTED = Path(__file__).with_name("printed.golden")
ELAPSED = re.compile(r"(computed in |made in |\.tar: .* events, )[\d.,]+ \w+")
OTHER_TESTS = ("scenes", "generators", "doctor")
"""Commands that print a table of the program, or facts of the machine."""
COMMANDS = (
    *(one.words for name, one in COMMANDS_TRIED.items() if name not in OTHER_TESTS),
    FLICKER,
    "check ../clip.npy --fps 5",
    "check ../cut.npy --fps 25 --all",
    f"compare {EVENTS} ../others.h5 --metrics stpp,nearest,on_difference,active_iou",
    f"compare {EVENTS} ../others.h5 --metrics lfs,ef_ssim",
    f"compare {EVENTS} ../others.h5 ../events.h5 --metrics count_ratio,nearest",
    f"info {EVENTS} --all",
    "scenes cube",
    "info ../plain.csv --sensor 16x12",
    "validate ../rest.npz",
    "convert ../damaged.csv o.npz --sensor 16x12 --repair",
    "dataset verify ../cars --workers 1",
    "data list",
    "weights list",
)
MISTAKES = read_lines("mistakes.txt")


def report_of(command: str, seen: Outcome) -> str:
    """What a run printed, without what differs from machine to machine."""
    text = ELAPSED.sub(r"\1TIME", f"{seen.printed}{seen.errors}")
    text = re.sub(r"/\S*/(run|cache)\b", r"\1", text.replace(full_version(), "VERSION"))
    lines = [line.rstrip() for line in text.splitlines()]
    left = f"exit code {seen.code}; files: {', '.join(seen.names) or 'none'}"
    return "\n".join([f"$ texvent {command}", *lines, left, ""])


@pytest.mark.parametrize("command", COMMANDS)
def test_a_report_is_as_it_was(command, outcome):
    assert report_of(command, outcome(command)) in PRINTED.read_text(encoding="utf-8")


@pytest.mark.parametrize("command", MISTAKES)
def test_a_mistake_is_one_line_and_leaves_nothing(command, outcome):
    seen = outcome(command)
    assert report_of(command, seen) in PRINTED.read_text(encoding="utf-8")
    assert (seen.code in (2, 3), seen.printed, seen.names) == (True, "", [])
    assert re.fullmatch(r"error: .{,292}\n", seen.errors)


def _write() -> None:
    with tempfile.TemporaryDirectory() as folder:
        make_inputs(Path(folder))
        run = functools.partial(run_once, Path(folder))
        PRINTED.write_text("\n".join(report_of(one, run(one)) for one in (*COMMANDS, *MISTAKES)))


if __name__ == "__main__":
    _write()
