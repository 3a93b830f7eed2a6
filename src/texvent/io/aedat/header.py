"""The text at the beginning of AEDAT2 and AEDAT3.1 files: lines that start with `#`.

Nothing but the first byte of a line says whether it still is text. AEDAT3.1 closes its header by a
line of its own, jAER closes AEDAT2 by `#End Of ASCII Header`.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError
from texvent.io.metadata import MAX_HEADER_BYTES, metadata_from_json

AEDAT2_MAGIC = "#!AER-DAT2.0"
AEDAT3_MAGIC = "#!AER-DAT3.1"
AEDAT2_END = "#End Of ASCII Header"
AEDAT3_END = "#!END-HEADER"
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


def read_aedat_header(path: Path, magic: str, end: str) -> AedatHeader:
    """The header of a file.

    Args:
        path: the file.
        magic: its first line.
        end: its last line, where the format has one.

    Raises:
        FileFormatError: the first line is another, or the header does not end.
    """
    lines: list[str] = []
    length = 0
    with path.open("rb") as file:
        while True:
            line = file.readline(MAX_HEADER_BYTES - length + 1)
            if not line.startswith(b"#"):
                break
            if length + len(line) > MAX_HEADER_BYTES:
                raise FileFormatError(f"{path}: its header is longer than 8 MiB; it is damaged")
            if not line.endswith(b"\n"):
                raise FileFormatError(f"{path} ends inside its header; the file was cut off")
            length += len(line)
            lines.append(line.decode("latin-1").rstrip("\r\n"))
            if lines[0] != magic:
                raise FileFormatError(f"{path} begins with {lines[0][:40]!r}, not with {magic}")
            if lines[-1] == end:
                break
    if not lines:
        raise FileFormatError(f"{path} does not begin with {magic}")
    return AedatHeader(tuple(lines), length)
