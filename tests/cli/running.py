"""Commands as a user types them, and the one line of those that are refused."""

import pytest

from texvent.cli.app import main


def run(*words: object) -> int:
    return main([str(word) for word in words])


def refused(
    capsys: pytest.CaptureFixture[str], *words: object, codes: tuple[int, ...] = (2,)
) -> str:
    """The line, without its "error: ", that is all a command says that must be refused."""
    capsys.readouterr()
    assert run(*words) in codes
    said = capsys.readouterr()
    assert said.out == ""
    (line,) = said.err.splitlines()
    assert line.startswith("error: ")
    assert len(line) < 300
    return line.removeprefix("error: ")
