"""The commands of an installed package: the first that fails ends them."""

import pytest

from texvent.cli import app
from tools import smoke


@pytest.mark.parametrize("code", [0, 1, 130])
@pytest.mark.parametrize("number", [0, len(smoke.COMMANDS) // 2, len(smoke.COMMANDS) - 1])
def test_a_command_that_fails_is_the_last_and_is_named(number, code, monkeypatch, capsys):
    codes = iter([0] * number + [code] + [0] * len(smoke.COMMANDS))
    used = []
    monkeypatch.setattr(app, "main", lambda words: next(codes))
    for name in ("write_inputs", "write_others"):
        monkeypatch.setattr(smoke, name, lambda: None)
    monkeypatch.setattr(smoke, "use_python", lambda: used.append(code))
    said = f"error: texvent {smoke.COMMANDS[number]} ended with {code}\n"
    assert smoke.main() == int(code != 0)
    assert capsys.readouterr().err == said * int(code != 0)
    assert used == [0] * int(code == 0)
