"""A run writes its files from threads of their own; what goes wrong there is said once, cleanly."""

import errno
import threading
from pathlib import Path

import pytest

from texvent.cli.app import main
from texvent.errors import OutputError
from texvent.io import block_writer
from texvent.io.hdf5.storage import Hdf5Writer

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"


def simulate(folder, *words):
    return main(["simulate", str(CLIP), "-o", str(folder / "out.h5"), "--stop", "0.5", *words])


def fail_in_a_thread(*_):
    assert threading.current_thread() is not threading.main_thread()
    raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("interpolate", ["none", "flow"])
def test_a_full_disk_stops_the_run_and_leaves_nothing(tmp_path, monkeypatch, capsys, interpolate):
    monkeypatch.setattr(block_writer, "BLOCK_EVENTS", 100)
    monkeypatch.setattr(Hdf5Writer, "_write_pending", lambda *_, final: fail_in_a_thread())
    assert simulate(tmp_path, "--interpolate", interpolate) == OutputError.exit_code
    said = capsys.readouterr()
    assert "the disk is full" in said.err.splitlines()[-1]
    assert said.out == ""
    assert not list(tmp_path.iterdir())
    assert not [one for one in threading.enumerate() if one.name.startswith("texvent-writer")]
