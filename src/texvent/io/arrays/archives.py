"""Zip archives from elsewhere: refused when they would unpack to far more than they are.

Event columns and text shrink to a half or a tenth; an archive of zeros shrinks to a thousandth.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

from texvent.errors import FileFormatError

FREE_BYTES = 256 * 2**20
"""Archives that unpack to less are never refused."""
MAX_RATIO = 100


def check_archive(path: Path, archive: zipfile.ZipFile) -> None:
    """Refuse an archive that claims to unpack to more than 100 times its size.

    Raises:
        FileFormatError: see above.
    """
    packed = path.stat().st_size
    unpacked = sum(entry.file_size for entry in archive.infolist())
    if unpacked > max(FREE_BYTES, MAX_RATIO * packed):
        raise FileFormatError(
            f"{path} has {packed} bytes and claims to unpack to {unpacked}; it is damaged, or "
            "made to fill the memory"
        )
