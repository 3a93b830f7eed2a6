"""OpenEXR images: linear light as frames, and the passes of a renderer.

A pixel of an EXR file is linear light, where 1 is white; nothing is clipped or rounded.

Source: OpenEXR's technical introduction.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import FileFormatError, InputError, few, one_line, shown
from texvent.runtime.memory import check_claim

EXR = ".exr"
REC709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
"""x and y of red, green, blue and white in OpenEXR's attribute chromaticities."""
CODED = ("pq", "hlg", "srgb", "g22", "g24", "g18")
"""Beginnings of the attribute colorInteropID where pixels are no linear light."""
HALF_BYTES = 2
"""Bytes of a value in most files; floats have 4."""
COLOURS = (("R", "G", "B"), ("Y",))


@dataclass(frozen=True, eq=False)
class ExrImage:
    """All channels of a file."""

    path: Path
    channels: Mapping[str, NDArray[Any]]
    """Name, such as `ViewLayer.Vector.X` → [H, W]."""
    headers: tuple[Mapping[str, Any], ...]
    """Attributes of each part."""

    def find(self, *endings: str) -> dict[str, NDArray[np.float32]]:
        """The channels that are called so, under these names; or none.

        A name with a dot may follow that of a layer: `ViewLayer.Vector.X` is `Vector.X`.

        Raises:
            FileFormatError: two layers have them.
        """
        found: dict[str, NDArray[np.float32]] = {}
        for ending in endings:
            names = [
                one
                for one in self.channels
                if one == ending or ("." in ending and one.endswith(f".{ending}"))
            ]
            if len(names) > 1:
                raise FileFormatError(
                    f"{self.path} has several channels {ending} ({few(names)}); write one view "
                    "layer into a file"
                )
            if not names:
                return {}
            found[ending] = np.asarray(self.channels[names[0]], dtype=np.float32)
        return found


def read_exr(path: Path) -> ExrImage:
    """All channels of an OpenEXR file.

    Raises:
        FileFormatError: it is damaged, or no OpenEXR file.
        MissingDependencyError: the package OpenEXR is not installed.
    """
    library = require("OpenEXR", extra="exr")
    try:
        with library.File(str(path), separate_channels=True, header_only=True) as file:
            heads = [dict(part.header) for part in file.parts]
        check_claim(sum(map(_stated_bytes, heads)), path, copies=4)
        with library.File(str(path), separate_channels=True) as file:
            parts = list(file.parts)
            channels = {
                name: np.array(channel.pixels)
                for part in parts
                for name, channel in part.channels.items()
            }
            headers = tuple(dict(part.header) for part in parts)
    except FileFormatError:
        raise
    except Exception as error:  # the library raises many types, all on damage
        raise FileFormatError(f"{path} is damaged or not OpenEXR ({one_line(error)})") from error
    if not channels or any(one.ndim != 2 or one.size == 0 for one in channels.values()):
        raise FileFormatError(f"{path} has no channel of pixels, or deep or subsampled ones")
    return ExrImage(path, channels, headers)


def _stated_bytes(header: Mapping[str, Any]) -> int:
    """Bytes of a part's pixels, by its head."""
    low, high = (np.asarray(corner).astype(int).tolist() for corner in header["dataWindow"])
    width, height = (after - before + 1 for before, after in zip(low, high, strict=True))
    return int(width * height * len(header["channels"]) * HALF_BYTES)


def exr_frame(path: Path) -> NDArray[np.float32]:
    """The colour of an OpenEXR file as a frame: see the module.

    Returns:
        [H, W] or [H, W, 3], float32, linear light, 1 is white.

    Raises:
        InputError: its pixels are coded for a display (PQ, HLG), or it has no colour.
        FileFormatError: it is damaged.
    """
    image = read_exr(path)
    for names in COLOURS:
        prefixed = [tuple(f"Combined.{name}" for name in names), names]
        for wanted in prefixed:
            found = image.find(*wanted)
            if found:
                _check_linear(image)
                planes = [found[one] for one in wanted]
                return planes[0] if len(planes) == 1 else np.stack(planes, axis=-1)
    raise InputError(
        f"{path} has no colour (R, G, B or Y); its channels: {few(sorted(image.channels))}"
    )


def _check_linear(image: ExrImage) -> None:
    for header in image.headers:
        space = str(header.get("colorInteropID", "")).lower()
        if space.startswith(CODED):
            raise InputError(
                f"{image.path} says that its pixels are coded ({shown(space)}); only linear light "
                "is read, so render or convert it to a linear space, such as lin_rec709"
            )
        primaries = header.get("chromaticities")
        if primaries is not None and not np.allclose(np.ravel(primaries), REC709, atol=0.01):
            raise InputError(
                f"{image.path} has other primaries than Rec. 709 (chromaticities "
                f"{shown(np.ravel(primaries).round(3).tolist())}); convert it to lin_rec709"
            )
