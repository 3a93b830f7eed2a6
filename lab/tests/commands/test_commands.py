"""Commands of the laboratory as a user of `texvent` meets them."""

import pytest

from texvent._registry import Registry
from texvent.cli import app
from texvent.cli.app import main
from texvent_lab.commands import COMMANDS
from texvent_lab.commands.bench.bench import BENCHMARKS

COLUMNS, LINES = 80, 40
EVERY = [*((name,) for name in COMMANDS), *(("bench", name) for name in BENCHMARKS)]


@pytest.mark.parametrize("command", EVERY, ids=" ".join)
def test_help_of_every_command_fits_one_screen(capsys, monkeypatch, command):
    monkeypatch.setenv("COLUMNS", str(COLUMNS))
    assert main([*command, "--help"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) <= LINES
    assert max(map(len, lines)) <= COLUMNS


def test_texvent_lists_the_commands_and_without_the_package_names_it(capsys, monkeypatch):
    assert set(COMMANDS) == set(app.OF_THE_LAB)
    assert main(["--help"]) == 0
    shown = capsys.readouterr().out
    assert all(f"\n  {name} " in shown for name in COMMANDS)
    # A group of entry points that no package has, as where the laboratory is not installed.
    monkeypatch.setattr(app, "PACKAGES", Registry("command of nobody", {}))
    assert main(["bench"]) == 4
    assert "pip install" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["bench", "selftst"], "did you mean 'selftest'"),
        (["bench", "selftest", "--metrics", "spp"], "did you mean 'stpp'"),
        (["bench", "selftest", "-o", "truth.npz"], "exists already"),
        (["bench", "fidelity", "-o", "truth.npz"], "exists already"),
        (["bench", "fidelity", "--scenes", "mixd"], "did you mean 'mixed'"),
        (["bench", "fidelity", "--simulators", "esmi"], "did you mean 'esim'"),
        (["bench", "fidelity", "--interpolations", "blnd"], "did you mean 'blend'"),
        (["bench", "fidelity", "--jobs", "0"], "jobs is 0"),
        (["bench", "page", "x.json", ""], "unexpected ''"),
    ],
)
def test_mistakes_are_one_clear_line(tmp_path, monkeypatch, capsys, words, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "truth.npz").touch()
    assert main(words) in (2, 3)
    said = capsys.readouterr().err.strip()
    assert message in said
    assert "\n" not in said
