"""Runs of every command with each of its options, and digests of all that they leave.

    python -m tests.options.outcomes    # writes the digests anew; CHANGELOG.md says why

`outcomes.json` holds them: of what was said, of events, of other files.
"""

import functools
import json
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from tests.options.inputs_of_commands import make_inputs
from tests.options.runs_of_commands import Listed, Outcome, listed_options, run_once
from tests.options.tries import COMMANDS_TRIED, ELSEWHERE, Try, read_tries

OUTCOMES = Path(__file__).with_name("outcomes.json")
TRIES = read_tries()
SETTLED = [one for one in COMMANDS_TRIED if one not in ("doctor", "dataset plan")]
"""Commands that do not tell of this machine or of the time that work takes on it."""


def own_options(command: str) -> Iterator[Listed]:
    """Options of a command that no other one tries."""
    shared = {*COMMANDS_TRIED[command].shared}
    for name, listed in listed_options(command).items():
        if not {listed.section, name} & shared and (command, name) not in ELSEWHERE:
            yield listed


def tries_of(command: str, listed: Listed) -> list[Try]:
    """Ways to give an option another value, from the table or from its choices."""
    kind, name = command.partition(" --")[0], listed.name.removeprefix("no-")
    for key in (f"{kind} --{name}", f"--{name}"):
        if key in TRIES:
            return TRIES[key]
    words = listed.other_values()
    assert words, f"{command} --{name} has no value to try: add one to tries.txt"
    return [Try(one) for one in words]


def runs_of(command: str, one: Try) -> Iterator[tuple[str, str]]:
    """The command line without and with the option, or with each of two values, and what ran
    before."""
    base = (one.base or COMMANDS_TRIED[command].words).replace("BASE", command)
    base = f"{base} {one.beside}"
    values = one.words.split("<") if "<" in one.words else ("", one.words)
    before = one.before.replace("BASE", base)
    for words in values:
        yield f"{base} {words}", before


def outcomes_of(command: str, outcome: Callable[..., Outcome]) -> dict[str, str]:
    """Command line of every run with an option of a command → digests of what it left."""
    found = {}
    for listed in own_options(command):
        for one in tries_of(command, listed):
            for words, before in runs_of(command, one):
                found[f"{before}; {words}".removeprefix("; ")] = outcome(words, before=before).mark
    return found


@functools.cache
def stored_outcomes() -> Mapping[str, Mapping[str, str]]:
    """Command → what `outcomes_of` gave."""
    found: dict[str, dict[str, str]] = json.loads(OUTCOMES.read_text(encoding="utf-8"))
    return found


def _write() -> None:
    with tempfile.TemporaryDirectory() as folder:
        make_inputs(Path(folder))
        run = functools.cache(functools.partial(run_once, Path(folder)))
        found = {one: outcomes_of(one, run) for one in SETTLED}
    lines = (f"{json.dumps(command)}: {json.dumps(one)}" for command, one in found.items())
    OUTCOMES.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    _write()
