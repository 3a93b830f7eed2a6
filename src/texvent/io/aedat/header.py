"""Text lines before the records of AEDAT1, AEDAT2 and AEDAT3.1, each of which starts with `#`.

Nothing but the first byte of a line says whether it still is text. AEDAT3.1 closes its header by a
line of its own, jAER closes AEDAT2 by `#End Of ASCII Header`.

Source: iniVation, AEDAT 2.0 and 3.1 file formats.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError
from texvent.io.metadata import MAX_HEADER_BYTES, metadata_from_json
from texvent.io.prophesee.text_header import CONTROL

METADATA = "# texvent "


@dataclass(frozen=True)
class AedatHeader:
    """The lines before the records."""

    lines: tuple[str, ...]
    """Without their line ends."""
    length: int
    """Bytes up to the first record."""

    def metadata(self, path: Path) -> dict[str, Any]:
        """Provenance of the events, or the header of another program.

        Raises:
            FileFormatError: the line of texvent is damaged.
        """
        for line in self.lines:
            if line.startswith(METADATA):
                return metadata_from_json(path, line.removeprefix(METADATA))
        return {"header": list(self.lines[1:])} if len(self.lines) > 1 else {}

    def value(self, key: str) -> str | None:
        """Value of the line `#key: ` or `# key: `, if there is one."""
        for line in self.lines:
            name, colon, value = line.removeprefix("#").partition(":")
            if colon and name.strip() == key:
                return value.strip()
        return None


def read_aedat_header(path: Path, magics: Sequence[str], end: str) -> AedatHeader:
    """The header of a file.

    Raises:
        FileFormatError: the first line is another, or the header does not end.
    """
    lines: list[str] = []
    length = 0
    with path.open("rb") as file:
        while True:
            line = file.readline(MAX_HEADER_BYTES - length + 1)
            # The first record may begin with the same byte by chance.
            if not line.startswith(b"#") or CONTROL.search(line[:64]):
                break
            if length + len(line) > MAX_HEADER_BYTES:
                raise FileFormatError(f"{path}: its header is longer than 8 MiB; it is damaged")
            if not line.endswith(b"\n"):
                raise FileFormatError(f"{path} ends inside its header; the file was cut off")
            length += len(line)
            lines.append(line.decode("latin-1").rstrip("\r\n"))
            if lines[0] not in magics:
                raise FileFormatError(
                    f"{path} begins with {lines[0][:40]!r}, not with {' or '.join(magics)}"
                )
            if lines[-1] == end:
                break
    if not lines:
        raise FileFormatError(f"{path} does not begin with {magics[-1]}")
    return AedatHeader(tuple(lines), length)
