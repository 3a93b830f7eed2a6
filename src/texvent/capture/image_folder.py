"""Folders of numbered images, with a timestamp file or a frame rate."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from texvent.capture.frame_source import FrameSource, SourceFacts
from texvent.capture.frame_times import FrameTimes, Timestamps, read_timestamps
from texvent.capture.intensity_scale import usable_pixels, warn_of_few_bits
from texvent.capture.linear_light import CODING, FULL_SCALE, LINEAR
from texvent.capture.motion_vectors.exr_image import EXR, exr_frame
from texvent.errors import InputError, shown
from texvent.runtime.file_names import IMAGE_EXTENSIONS, natural_key, usable_path
from texvent.runtime.image_files import decode_image
from texvent.sensor import checked_size
from texvent.video import Frame, PixelArray

TIMESTAMP_NAMES = ("timestamps.txt", "images.txt", "info.txt")
"""Names under which a timestamp file is found in the folder or beside it."""
INNER_FOLDERS = ("images", "frames", "imgs")
"""Where a recording's folder keeps its images."""
LIGHT_EXTENSIONS = (EXR, ".hdr")
"""Images of linear light: OpenEXR, Radiance."""


class ImageFolder(FrameSource):
    """Images of a folder in natural order (2 before 10), or in the timestamp file's order.

    Args:
        folder: holds the images, or a sub-folder `images`, `frames` or `imgs` that does.
        times: frame times; without them, a timestamp file in or beside the folder is used.
        timestamps: the timestamp file, where it is not `timestamps.txt` or `images.txt`.
        unit: unit of the times in that file: s, ms, us or ns; None: s, if that can be.
        white_level: the value that means white, where the type does not say it.

    Raises:
        InputError: no image, no times, or as many times as images are not given.
        FileFormatError: an image cannot be decoded.
    """

    def __init__(
        self,
        folder: Path,
        times: FrameTimes | None = None,
        *,
        timestamps: Path | None = None,
        unit: str | None = None,
        white_level: float | None = None,
    ) -> None:
        images_folder = find_images_folder(folder)
        file = timestamps or (None if times else find_timestamps(images_folder))
        listing = read_timestamps(file, unit) if file else None
        if file is not None and listing is not None and listing.names is not None:
            self._paths = _named_images(listing, file, images_folder)
        else:
            self._paths = sorted(filter(_is_image, images_folder.iterdir()), key=natural_key)
        known = times or (listing.times if listing else None)
        if known is None:
            raise InputError(
                f"{folder} has no {' or '.join(TIMESTAMP_NAMES)}, so the times of its images are "
                "unknown; give a frame rate (fps=25) or a file of times (timestamps=FILE)"
            )
        self._times = known
        self._times.check_count(len(self._paths))
        first = read_image(self._paths[0])
        if white_level is None:
            warn_of_few_bits(first, str(folder))
        metadata = {
            "source": str(folder),
            "kind": "image folder",
            "pixel_type": str(first.dtype),
            "timestamps": str(file) if file else None,
            **coding_facts(self._paths),
        }
        size = checked_size(first.shape[1], first.shape[0])
        self._facts = SourceFacts(size, self._times.fps, len(self._paths), metadata)

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order, read one by one.

        Raises:
            FileFormatError: an image cannot be decoded.
        """
        for index, path in enumerate(self._paths):
            yield Frame(read_image(path), self._times(index))


def read_image(path: Path) -> PixelArray:
    """An image at its own precision, [H, W] or [H, W, 3] RGB; see `coding_facts` for its code.

    Raises:
        InputError: it holds a pixel type that frames cannot have.
        FileFormatError: it cannot be decoded.
        MissingDependencyError: it is OpenEXR, whose reader is not installed.
    """
    if path.suffix.lower() == EXR:
        return exr_frame(path)
    import cv2  # only image folders need it here

    # Grey stays grey, 16-bit and float stay, alpha goes, and JPEG orientation is applied.
    image = decode_image(path, cv2.IMREAD_ANYCOLOR | cv2.IMREAD_ANYDEPTH)
    if image.ndim == 3:
        image = cv2.cvtColor(image, cv2.COLOR_BGR2RGB)
    return usable_pixels(np.asarray(image), str(path))


def coding_facts(paths: Sequence[Path]) -> dict[str, Any]:
    """How images are coded, for a source's metadata: nothing where they are gamma-coded.

    Raises:
        InputError: some are linear light and some are not.
    """
    linear = [path for path in paths if path.suffix.lower() in LIGHT_EXTENSIONS]
    if not linear:
        return {}
    other = next((path for path in paths if path.suffix.lower() not in LIGHT_EXTENSIONS), None)
    if other is not None:
        raise InputError(
            f"{linear[0].name} is linear light and {other.name} is gamma-coded; frames must be one "
            f"or the other, so move one kind out of {linear[0].parent}"
        )
    return {CODING: LINEAR, FULL_SCALE: 1.0}


def find_images_folder(folder: Path) -> Path:
    """The folder itself if it holds images, else its first usual sub-folder that does.

    Raises:
        InputError: there is no image in any of them.
    """
    for candidate in (folder, *(folder / name for name in INNER_FOLDERS)):
        if candidate.is_dir() and any(_is_image(path) for path in candidate.iterdir()):
            return candidate
    raise InputError(
        f"{folder} holds no image; looked for {', '.join(sorted(IMAGE_EXTENSIONS))} in it and in "
        f"its sub-folders {', '.join(INNER_FOLDERS)}"
    )


def find_timestamps(folder: Path) -> Path | None:
    """A timestamp file in the folder of the images or beside it, or None."""
    candidates = (place / name for place in (folder, folder.parent) for name in TIMESTAMP_NAMES)
    return next((path for path in candidates if path.is_file()), None)


def _is_image(path: Path) -> bool:
    return (
        path.suffix.lower() in IMAGE_EXTENSIONS and not path.name.startswith(".") and path.is_file()
    )


def _named_images(listing: Timestamps, file: Path, folder: Path) -> list[Path]:
    paths: list[Path] = []
    for name in listing.names or ():
        usable_path(name)
        candidates = (file.parent / name, folder / name, folder / Path(name).name)
        path = next((candidate for candidate in candidates if candidate.is_file()), None)
        if path is None:
            raise InputError(
                f"{file} names {shown(name)}, which is neither beside it nor in {folder}; "
                "remove the line or restore the image"
            )
        paths.append(path)
    return paths
