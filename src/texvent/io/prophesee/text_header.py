"""Text before the binary events of Prophesee files: lines `% key value`, in RAW up to `% end`.

texvent writes how the events were made as one line `% texvent {JSON}`, which other software
skips like any key it does not know. Headers of other software become `metadata["header"]`.

Source: Prophesee, RAW and DAT file format pages of the Metavision documentation.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from texvent.errors import FileFormatError
from texvent.io.metadata import MAX_HEADER_BYTES, header_metadata, metadata_from_json

END = "end"
HD, VGA = (1280, 720), (640, 480)
EVK_PROXY = 0x80
"""Bit of `system_ID` of a sensor behind another board."""
SYSTEMS: Mapping[tuple[int, int], tuple[int, ...]] = {
    VGA: (0x14, 0x15, 0x17, 0x19, 0x1C, 0x1D, 0x21, 0x22, 0x23, 0x28, 0x29),
    HD: (0x1A, 0x1E, 0x1F, 0x20, 0x27, 0x2E, 0x30, 0x31, 0x32, 0x35, 0x3A, 0x42),
    (640, 512): (0x34, 0x36),
    (320, 320): (0x37, 0x3B, 0x40),
}
"""Sensor size → numbers of systems, from OpenEB's list of them."""
CHIPS: Mapping[str, tuple[int, int]] = {
    "genx320": (320, 320),
    "imx636": HD,
    "imx646": HD,
    "imx637": (640, 512),
    "imx647": (640, 512),
    "320": (320, 320),
    "4": HD,
    "3": VGA,
}
"""Chip in the name of a plug-in or sensor, or generation of the sensor → its size."""
METADATA = "texvent"
CONTROL = re.compile(rb"[\x00-\x08\x0b\x0c\x0e-\x1f]")
"""Bytes that no line of a header has."""


@dataclass(frozen=True)
class TextHeader:
    """The lines before the events."""

    fields: Mapping[str, str]
    """Value of each key; of repeated keys the last."""
    length: int
    """Bytes up to the first one that belongs to the data."""
    has_end: bool
    """True if the line `% end` closes it."""

    def options(self) -> tuple[str, dict[str, str]]:
        """The `format` line, taken apart: `EVT3;height=720;width=1280` → EVT3 and a dictionary."""
        name, *pairs = self.fields.get("format", "").split(";")
        parts = (pair.partition("=") for pair in pairs)
        return name.strip(), {key.strip(): value.strip() for key, _, value in parts}

    def stored_size(self, path: Path) -> tuple[int, int] | None:
        """Width and height, pixels: from `format`, `geometry`, `Width` and `Height`, or the camera.

        Raises:
            FileFormatError: they are no numbers.
        """
        options = self.options()[1]
        for source in (options, self.fields):
            for width, height in (("width", "height"), ("Width", "Height")):
                if width in source and height in source:
                    return _whole(path, source[width]), _whole(path, source[height])
        if "geometry" in self.fields:
            width, _, height = self.fields["geometry"].partition("x")
            return _whole(path, width), _whole(path, height)
        return self._camera_size()

    def _camera_size(self) -> tuple[int, int] | None:
        """Size of the sensor that older headers name by a number, a plug-in or a generation."""
        maker = self.fields.get("plugin_integrator_name", self.fields.get("integrator_name"))
        system = self.fields.get("system_ID", "")
        if maker in (None, "Prophesee") and system.isdecimal() and len(system) < 9:
            number = int(system) & ~EVK_PROXY
            found = [size for size, systems in SYSTEMS.items() if number in systems]
            if found:
                return found[0]
        named = " ".join(self.fields.get(key, "") for key in ("plugin_name", "sensor_name")).lower()
        generation = self.fields.get("sensor_generation", "").partition(".")[0]
        for word, size in CHIPS.items():
            is_generation = word.isdecimal()
            if word == generation or (f"gen{word}" if is_generation else word) in named:
                return size
        return None

    def metadata(self, path: Path) -> dict[str, Any]:
        """Provenance of the events, or the header of another program.

        Raises:
            FileFormatError: the line of texvent is damaged.
        """
        if METADATA in self.fields:
            return metadata_from_json(path, self.fields[METADATA])
        return {"header": dict(self.fields)} if self.fields else {}


def read_text_header(file: BinaryIO, path: Path) -> TextHeader:
    """The header at the start of a file; the file is left at its first byte of data.

    Raises:
        FileFormatError: the file ends inside the header, or the header does not end.
    """
    fields: dict[str, str] = {}
    start = 0
    while True:
        line = file.readline(MAX_HEADER_BYTES - start + 1)
        if line == b"%":
            raise FileFormatError(f"{path} ends inside its header; the file was cut off")
        # Without `% end` the data may begin with the same two bytes by chance.
        if not line.startswith(b"% ") or CONTROL.search(line[:64]):
            file.seek(start)
            return TextHeader(fields, start, False)
        if start + len(line) > MAX_HEADER_BYTES:
            raise FileFormatError(f"{path} has a header of more than {MAX_HEADER_BYTES} bytes")
        if not line.endswith(b"\n"):
            raise FileFormatError(f"{path} ends inside its header; the file was cut off")
        start += len(line)
        key, _, value = line[2:].decode("utf-8", errors="replace").strip().partition(" ")
        if key == END:
            return TextHeader(fields, start, True)
        fields[key] = value.strip()


def make_text_header(fields: Mapping[str, str], metadata: Mapping[str, Any], *, end: bool) -> bytes:
    """Header lines in order of their keys, as Prophesee's software writes them.

    Raises:
        InputError: the metadata is not JSON-serialisable or too long.
    """
    text = header_metadata(metadata)
    lines = [f"% {key} {value}" for key, value in sorted({**fields, METADATA: text}.items())]
    lines += [f"% {END}"] if end else []
    return "".join(f"{line}\n" for line in lines).encode("ascii")


def _whole(path: Path, text: str) -> int:
    if not re.fullmatch(r"\s*[0-9]{1,9}\s*", text):
        raise FileFormatError(f"{path}: its header states a size of {text[:40]!r}, not a number")
    return int(text)
