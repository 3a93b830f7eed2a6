from __future__ import annotations

import sys

import pytest

from texvent.cli.app import main
from texvent.cli.simulation.web import LOOPBACK, AppOptions


def fails(capsys, *words: str, code: int = 2) -> str:
    assert main(["app", *words]) == code
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    return lines[0]


def test_without_gradio_the_extra_is_named_and_nothing_remains(
    capsys, monkeypatch, tmp_path
) -> None:
    monkeypatch.setitem(sys.modules, "gradio", None)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert "pip install 'texvent[app]'" in fails(capsys, "--no-browser", code=4)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--port", "70000"], "port is 70000"),
        (["--generators", ","], "generators is empty"),
        (["--generators", "sora"], "unknown generator 'sora'"),
        (["--max-seconds", "0"], "max_seconds is 0"),
    ],
)
def test_mistakes_are_one_line(capsys, words: list[str], message: str) -> None:
    assert message in fails(capsys, *words)


def test_only_this_machine_reaches_the_page_unless_told_otherwise() -> None:
    assert AppOptions().host == LOOPBACK == "127.0.0.1"
