"""Every option of every command changes something, and figures change in the stated direction."""

import math
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from rich.console import Console
from tests.options.outcomes import (
    SETTLED,
    outcomes_of,
    own_options,
    runs_of,
    stored_outcomes,
    tries_of,
)
from tests.options.runs_of_commands import listed_options, run_once
from tests.options.tries import COMMANDS_TRIED, SERVED, Try

from texvent.cli.app import own_commands
from texvent.cli.dataset.dataset import STEPS
from texvent.runtime import console_progress

RANGES = Path(__file__).with_name("ranges.txt").read_text(encoding="utf-8").splitlines()
ALL_RANGES, BEYOND = "\n".join(RANGES), 10**30


def fault_of(outcome, command: str, one: Try) -> str | None:
    """Why a try shows no effect, or a wrong one; None if it is as the table says."""
    runs = list(runs_of(command, one))
    assert runs[0][0].startswith(command.partition(" --")[0]), runs
    first, second = (outcome(words, before=before) for words, before in runs)
    part = one.changes or COMMANDS_TRIED[command].changes
    if part != "code" and max(first.code, second.code) > 1:
        return f"refused ({first.code}, {second.code}): {first.said}{second.said}"
    if "<" in one.words:
        low, high = first.measure(part), second.measure(part)
        return None if low < high else f"{part} is {low}, then {high}: {one.words}"
    if getattr(first, part) == getattr(second, part):
        return f"{part} the same with {one.words}: {second.said}"
    return None


@pytest.mark.long
@pytest.mark.parametrize("command", COMMANDS_TRIED)
def test_every_option_changes_something_and_figures_in_the_direction_of_its_help(command, outcome):
    wrong = {}
    for listed in own_options(command):
        assert listed.text.strip(), listed.name
        for one in tries_of(command, listed):
            if fault := fault_of(outcome, command, one):
                wrong[listed.flag] = fault
    assert not wrong, "\n".join(f"{one}: {why}" for one, why in wrong.items())


@pytest.mark.long
@pytest.mark.parametrize("command", SETTLED)
def test_runs_with_each_option_leave_what_they_left(command, outcome):
    """`python -m tests.options.outcomes` writes them anew."""
    found = outcomes_of(command, outcome)
    stored = stored_outcomes()[command]
    assert list(found) == list(stored)
    assert {words: mark for words, mark in found.items() if mark != stored[words]} == {}


@pytest.mark.parametrize(
    "command",
    [
        one
        for one in COMMANDS_TRIED
        if "--" not in one and (one == "compare" or "quiet" in listed_options(one))
    ],
)
def test_a_terminal_sees_progress_unless_the_command_is_quiet(command, outcome, monkeypatch):
    monkeypatch.setattr(Console, "is_terminal", True)
    monkeypatch.setattr(console_progress, "PATIENCE_SECONDS", 0.0)
    run, words = outcome.__wrapped__, COMMANDS_TRIED[command].words
    assert run(words).errors
    assert "quiet" not in listed_options(command) or not run(f"{words} --quiet").errors


def test_every_command_and_step_is_tried():
    steps = {f"dataset {one}" for one in STEPS}
    tried = {one.partition(" --")[0] for one in COMMANDS_TRIED}
    assert {*own_commands()} | steps == tried | {*SERVED, "dataset"}


def stated_range(low: str, high: str) -> str:
    """The range that refusals of two numbers beyond it state; empty: they do not."""
    found = [re.search(r" is -?1e\+30.*?; it must be (.+)", one) for one in (low, high)]
    return " and ".join(dict.fromkeys(one[1] for one in found if one))


@pytest.mark.parametrize("command", COMMANDS_TRIED)
def test_options_of_a_command_have_the_ranges_of_the_table(command, outcome):
    words, found = COMMANDS_TRIED[command].words, []
    for listed in own_options(command):
        if listed.placeholder and "{" not in listed.placeholder:
            low, high = (
                outcome(f"{words} {listed.flag}={sign}{BEYOND}").errors for sign in ("-", "")
            )
            if stated := stated_range(low, high):
                found.append(f"{command} {listed.flag}: {stated}")
    assert found == [one for one in RANGES if re.match(rf"{re.escape(command)} --[\w-]+:", one)]


def numbers_at_bounds(stated: str, *, is_whole: bool) -> Iterator[tuple[float, bool]]:
    """Each end of a stated range, the next number on either side, and whether it is allowed."""
    stated = stated.replace("2^63 - 1", str(2**63 - 1))
    ends = re.match(r"(?:at least )?([\d.e+-]+?)(?:\.\.([\d.e+-]+))?(?: |$)", stated).groups()
    for end, outwards in zip(ends, (-1, 1), strict=True):
        if end:
            bound = int(end) if end.isdigit() else (int if is_whole else float)(float(end))
            for side in (-1, 0, 1):
                way = side * outwards
                near = bound + way if is_whole else math.nextafter(bound, way * math.inf)
                yield near if side else bound, side <= 0


@pytest.mark.parametrize("command", [one for one in COMMANDS_TRIED if f"{one} --" in ALL_RANGES])
def test_options_of_a_command_are_taken_up_to_their_bounds_and_no_further(command, tmp_path):
    """What is taken meets the next fault: no input, or no folder of the output."""
    words = COMMANDS_TRIED[command].words.replace(" -o ", " -o no/")
    words += " -o no/rig" if command == "rig" else ""
    wrong = []
    for line in RANGES:
        if named := re.fullmatch(rf"{re.escape(command)} (--[\w-]+): (.+)", line):
            flag, stated = named.groups()
            said = run_once(tmp_path, f"{words} {flag}=0.5").errors
            for number, is_allowed in numbers_at_bounds(stated, is_whole="whole number" in said):
                said = run_once(tmp_path, f"{words} {flag}={number!r}").errors
                if not said or (f"must be {stated}" in said) == is_allowed:
                    wrong.append(f"{flag}={number!r}: {said}")
    assert not wrong, "\n".join(wrong)
