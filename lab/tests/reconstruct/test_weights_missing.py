"""Who has no weights is told which file it is, where it comes from and where to put it."""

import pytest

from texvent.errors import InputError
from texvent_lab.reconstruct.reconstructor import load_reconstructor
from texvent_lab.registries import RECONSTRUCTORS


@pytest.mark.torch
@pytest.mark.parametrize("name", RECONSTRUCTORS.names())
def test_without_weights_the_message_says_where_they_come_from_and_go(name, tmp_path, monkeypatch):
    pytest.importorskip("torch")
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))
    with pytest.raises(InputError) as told:
        load_reconstructor(name)
    message = str(told.value)
    assert f"{name} needs its weights" in message
    assert "ercanburak/EVREAL" in message
    assert "`weights`" in message
    assert str(tmp_path / "weights" / f"{name}.pth") in message
    assert "\n" not in message
