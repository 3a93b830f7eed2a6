import re
from pathlib import PurePosixPath

import pytest

from texvent.data.catalogue import DATA_SETS


@pytest.mark.parametrize("name", DATA_SETS)
def test_every_entry_is_complete_and_safe(name):
    entry = DATA_SETS[name]
    digests = [entry.archive.sha256, *(part.sha256 for part in (*entry.files, *entry.folders))]
    assert all(re.fullmatch(r"[0-9a-f]{64}", digest) for digest in digests)
    assert len(entry.caveat) > 20
    for part in (*entry.files, *entry.folders):
        target = PurePosixPath(part.name)
        assert not target.is_absolute()
        assert ".." not in target.parts
    suffix = {"sdist": ".tar.gz", "wheel": ".whl"}[entry.archive.kind]
    assert entry.archive.filename.endswith(suffix)
    assert entry.archive.version in entry.archive.filename
