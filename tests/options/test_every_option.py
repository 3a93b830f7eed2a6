"""Every option of every command changes something, and figures change in the stated direction."""

from __future__ import annotations

import functools

import pytest
from tests.options.inputs_of_commands import make_inputs
from tests.options.runs_of_commands import Listed, listed_options, run_once
from tests.options.tries import COMMANDS_TRIED, ELSEWHERE, SERVED, Try, read_tries

from texvent.cli.app import COMMANDS
from texvent.cli.dataset.dataset import STEPS

TRIES = read_tries()


@pytest.fixture(scope="module")
def outcome(tmp_path_factory):
    """Function of a command line, and of one that ran before: its outcome, kept."""
    folder = tmp_path_factory.mktemp("inputs")
    make_inputs(folder)
    return functools.cache(functools.partial(run_once, folder))


def tries_of(command: str, listed: Listed) -> list[Try]:
    """Ways to give an option another value, from the table or from its choices."""
    kind, name = command.partition(" --")[0], listed.name.removeprefix("no-")
    for key in (f"{kind} --{name}", f"--{name}"):
        if key in TRIES:
            return TRIES[key]
    words = listed.other_values()
    assert words, f"{command} --{name} has no value to try: add one to tries.txt"
    return [Try(one) for one in words]


def fault_of(outcome, command: str, one: Try) -> str | None:
    """Why a try shows no effect, or a wrong one; None if it is as the table says."""
    base = (one.base or COMMANDS_TRIED[command].words).replace("BASE", command)
    assert base.startswith(command.partition(" --")[0]), base
    base = f"{base} {one.beside}"
    if "<" in one.words:
        low, high = (outcome(f"{base} {words}") for words in one.words.split("<"))
        if low.code or high.code:
            return f"refused: {low.said}{high.said}"
        first, second = low.measure(one.changes), high.measure(one.changes)
        return None if first < second else f"{one.changes} is {first}, then {second}: {one.words}"
    before = one.before.replace("BASE", base)
    without, changed = outcome(base, before=before), outcome(f"{base} {one.words}", before=before)
    part = one.changes or COMMANDS_TRIED[command].changes
    if part != "code" and max(changed.code, without.code) > 1:
        return f"refused ({changed.code}, {without.code}): {changed.said}{without.said}"
    if getattr(changed, part) == getattr(without, part):
        return f"{part} the same with {one.words}: {changed.said}"
    return None


@pytest.mark.parametrize("command", COMMANDS_TRIED)
def test_every_option_changes_something_and_figures_in_the_direction_of_its_help(command, outcome):
    wrong = {}
    for name, listed in listed_options(command).items():
        assert listed.text.strip(), name
        shared = COMMANDS_TRIED[command].shared
        if {listed.section, name} & {*shared} or (command, name) in ELSEWHERE:
            continue
        for one in tries_of(command, listed):
            if fault := fault_of(outcome, command, one):
                wrong[f"--{name}"] = fault
    assert not wrong, "\n".join(f"{one}: {why}" for one, why in wrong.items())


def test_every_command_and_step_is_tried():
    steps = {f"dataset {one}" for one in STEPS}
    tried = {one.partition(" --")[0] for one in COMMANDS_TRIED}
    assert {*COMMANDS} | steps == tried | {*SERVED, "dataset"}
