import errno
import os

import pytest

from texvent.io.hdf5.storage import DeferredErrorFile


def test_a_failed_write_is_remembered_and_ends_writing(tmp_path, monkeypatch):
    def refuse(*_: object) -> int:
        raise OSError(errno.ENOSPC, "full")

    path = tmp_path / "file.bin"
    path.touch()
    with DeferredErrorFile(path) as file:
        file.write(b"ab")
        monkeypatch.setattr(os, "write", refuse)
        assert file.write(b"cd") == 2
        monkeypatch.undo()
        assert file.write(b"ef") == 2
        file.truncate()
        file.seek(0)
        found = bytearray(6)
        assert file.readinto(found) == 6
        assert found == b"ab\0\0\0\0"
        with pytest.raises(OSError, match="full"):
            file.raise_failure()
    assert path.read_bytes() == b"ab"
