"""A wheel is checked without a compiler, and with nothing that the checkout lends."""

from __future__ import annotations

from pathlib import Path

import pytest
from tools.check_wheel import NO_COMPILER, bare_environment, main


def test_nothing_of_the_checkout_is_lent() -> None:
    lent = {
        "PATH": "/usr/bin",
        "PYTHONPATH": "src",
        "VIRTUAL_ENV": ".venv",
        "TEXVENT_CACHE": "/cache",
        "CC": "gcc",
        "PIP_CERT": "kept",
    }
    bare = bare_environment(lent)
    assert {"PATH": "/usr/bin", "PIP_CERT": "kept"}.items() <= bare.items()
    assert not {"PYTHONPATH", "VIRTUAL_ENV", "TEXVENT_CACHE"} & set(bare)
    assert bare["CC"] == bare["CXX"] == NO_COMPILER


@pytest.mark.parametrize("words", [["none.whl"], [__file__, "--python", "python-that-is-not-here"]])
def test_what_is_missing_is_named(
    words: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit, match="2"):
        main(words)
    assert f"there is no {words[-1]}" in capsys.readouterr().err
