"""Folders of numbered images and stacks of them, with a timestamp file or a frame rate."""

from __future__ import annotations

import contextlib
import itertools
import mmap
import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.exr_image import EXR, exr_frame
from texvent.capture.frame_source import FrameSource
from texvent.capture.given_times import FrameTimes, Timestamps, read_timestamps
from texvent.capture.linear_light import CODING, FULL_SCALE, LINEAR
from texvent.errors import FileFormatError, InputError, few, shown, warn
from texvent.frames import Frame, PixelArray
from texvent.options.arrays import usable_pixels
from texvent.runtime.files.file_names import (
    IMAGE_EXTENSIONS,
    in_natural_order,
    numbering_gap,
    usable_path,
)
from texvent.runtime.files.image_files import HEAD_BYTES, PHOTOMETRIC, decode_image, tiff_tags
from texvent.sensor import checked_size

TIMESTAMP_NAMES = ("timestamps.txt", "images.txt", "info.txt")
"""Names under which a timestamp file is found in the folder or beside it."""
INNER_FOLDERS = ("images", "frames", "imgs")
"""Places of images in a recording's folder."""
TIFF = (".tif", ".tiff")
NETPBM = (".pgm", ".ppm", ".pnm")
DEPTH_AND_COLOUR, TIFF_FLAGS = 6, -1
"""OpenCV's: grey stays grey, 16-bit and float stay, alpha goes, JPEG orientation is applied; and as
it is stored, since alpha would go silently, though OpenCV has multiplied a TIFF's colours by it."""
WHITE_IS_ZERO, CIELAB = 0, 8
"""Values of PhotometricInterpretation."""
STACK_BYTES = 32 * 2**20
"""Size of the images of a TIFF stack that are read at a time."""
MAX_BYTE = 255
LIGHT_EXTENSIONS = (EXR, ".hdr")
"""Images of linear light: OpenEXR, Radiance."""

# Lengths of channels, depths and times in the descriptions of ImageJ and of OME.
_AXES = re.compile(
    rb"\nchannels=(\d+)|\nslices=(\d+)|\nframes=(\d+)"
    rb"|\bSizeC=\"(\d+)\"|\bSizeZ=\"(\d+)\"|\bSizeT=\"(\d+)\""
)


_NETPBM_HEAD = re.compile(rb"(?P<kind>P[2356])\s+\d+\s+\d+\s+(?P<white>\d{1,9})")
_IMAGEJ_COUNT = re.compile(rb"ImageJ=[^\0]*?\nimages=(\d{1,9})\b")


class ImageFolder(FrameSource):
    """Images of a folder in natural order (2 before 10), or in the timestamp file's order.

    Of a TIFF stack every image is a frame.

    Args:
        folder: holds the images, or a sub-folder `images`, `frames` or `imgs` that does; or one
            TIFF stack.
        times: frame times; without them, a timestamp file in or beside the folder is used.
        timestamps: the timestamp file, where it is not `timestamps.txt` or `images.txt`.
        unit: unit of the times in that file: s, ms, us or ns; None: s, if that can be.
        white_level: the value that means white, where the type does not say it.

    Raises:
        InputError: no image, no times, or as many times as images are not given.
        FileFormatError: an image cannot be decoded.

    Warns:
        TexventWarning: a number is missing, or the names do not tell the order.
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
        images_folder = folder if folder.is_file() else find_images_folder(folder)
        file = timestamps or (None if times else find_timestamps(images_folder))
        listing = read_timestamps(file, unit) if file else None
        gap = None
        if file is not None and listing is not None and listing.names is not None:
            paths = _named_images(listing, file, images_folder)
            if timestamps is None:
                _warn_of_unnamed(file, paths, images_folder)
        elif folder.is_file():
            paths = [folder]
        else:
            paths = in_natural_order(filter(_is_image, images_folder.iterdir()))
            gap = numbering_gap(paths) if listing is None else None
        _refuse_lost(paths)
        known = times or (listing.times if listing else None)
        if known is None:
            raise InputError(
                f"{folder} has no {' or '.join(TIMESTAMP_NAMES)}, so the times of its images are "
                "unknown; give a frame rate (fps=25) or a file of times (timestamps=FILE)"
            )
        if gap is not None:
            warn(f"{folder}: images are missing between {gap}; later ones come too early")
        self._times, self._white_level = known, white_level
        self._stacks = [(path, count_images(path)) for path in paths]
        total = sum(count for _, count in self._stacks)
        self._times.check_count(total)
        first = next(read_stack(*self._stacks[0], white_level))
        metadata = {
            "source": str(folder),
            "kind": "image folder",
            "pixel_type": str(first.dtype),
            "timestamps": str(file) if file else None,
            **coding_facts(paths),
            **({} if gap is None else {"images_missing": f"between {gap}"}),
        }
        size = checked_size(first.shape[1], first.shape[0])
        super().__init__(size, self._times.fps, total, metadata)

    @property
    def times_us(self) -> Sequence[int] | None:
        """Times of all frames, µs."""
        return self._times.of(sum(count for _, count in self._stacks))

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order, read one by one.

        Raises:
            FileFormatError: an image cannot be decoded.
        """
        read = (read_stack(path, count, self._white_level) for path, count in self._stacks)
        for index, pixels in enumerate(itertools.chain.from_iterable(read)):
            yield Frame(pixels, self._times(index))


def count_images(path: Path) -> int:
    """Images of a TIFF stack; 1 of any other file, damaged ones too.

    Raises:
        FileFormatError: it states more images than there are pages.
    """
    import cv2

    if path.suffix.lower() not in TIFF:
        return 1
    count = 1
    with contextlib.suppress(cv2.error):
        count = max(1, cv2.imcount(str(path), DEPTH_AND_COLOUR))
    with path.open("rb") as file:
        stated = _IMAGEJ_COUNT.search(file.read(HEAD_BYTES))
    if stated and int(stated[1]) > count:
        raise FileFormatError(
            f"{path} states {int(stated[1])} images and has {count} page, as ImageJ and tifffile "
            "write large stacks; save one file per image (ImageJ: Save As > Image Sequence), or "
            "np.save('a.npy', tifffile.imread(...))"
        )
    return count


def read_stack(path: Path, count: int, white_level: float | None) -> Iterator[PixelArray]:
    """The images of a file, a few at a time; see `read_image`.

    Raises:
        FileFormatError: one cannot be decoded, or has another size than the first, or not all
            are of other times.
    """
    import cv2

    if count == 1:
        yield read_image(path, white_level)
        return
    _check_axes(path, count)
    shape: tuple[int, ...] | None = None
    start, step = 0, 1
    while start < count:
        wanted = min(step, count - start)
        is_read, images = cv2.imreadmulti(str(path), start, wanted, flags=TIFF_FLAGS)
        if not is_read or len(images) != wanted:
            raise FileFormatError(
                f"image {start + 1} of {count} in {path} cannot be decoded; the file may be damaged"
            )
        for image in images:
            shape = shape or image.shape[:2]
            if image.shape[:2] != shape:
                raise FileFormatError(
                    f"{path} holds images of several sizes, such as a picture and its preview; "
                    "save the frames as one image per file"
                )
            yield _checked(image, path, white_level)
        start += wanted
        step = max(1, STACK_BYTES // images[0].nbytes)


def _check_axes(path: Path, count: int) -> None:
    """Refuse a stack of colours, or of depths and times, as ImageJ and OME describe it.

    Depths alone pass: ImageJ calls the images of a video slices.
    """
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        found = _AXES.findall(data[:HEAD_BYTES] + data[HEAD_BYTES:][-HEAD_BYTES:])
    axes = {"c": 1, "z": 1, "t": 1}
    for axis, lengths in zip(("c", "z", "t") * 2, zip(*found, strict=True), strict=False):
        axes[axis] = max(axes[axis], *(int(one or 1) for one in lengths))
    colours, depths, times = axes.values()
    if colours * depths * times == count and (colours > 1 or min(depths, times) > 1):
        raise FileFormatError(
            f"{path} states {colours} channels, {depths} depths and {times} times, so its {count} "
            "images are not one video; save one channel and depth of it (ImageJ: Image > Duplicate)"
        )


def read_image(path: Path, white_level: float | None = None) -> PixelArray:
    """An image at its own precision, [H, W] or [H, W, 3] RGB; see `coding_facts` for its code.

    Raises:
        InputError: it holds a pixel type that frames cannot have.
        FileFormatError: it cannot be decoded.
        MissingDependencyError: it is OpenEXR, whose reader is not installed.
    """
    if path.suffix.lower() == EXR:
        return exr_frame(path)
    flags = TIFF_FLAGS if path.suffix.lower() in TIFF else DEPTH_AND_COLOUR
    return _checked(decode_image(path, flags), path, white_level)


def _checked(image: NDArray[Any], path: Path, white_level: float | None) -> PixelArray:
    """An image of OpenCV by the meaning of its file: RGB, black is 0, and full scale is white."""
    if image.ndim == 3:
        if image.shape[2] == 4 and image.dtype == np.uint8 and (image[..., 3] < MAX_BYTE).any():
            raise FileFormatError(
                f"image {path} has transparent pixels, with which OpenCV darkens a TIFF; save it "
                "without alpha, or as PNG"
            )
        image = image[..., 2::-1]
    pixels = usable_pixels(np.ascontiguousarray(image), str(path))
    meaning = _photometric(path) if path.suffix.lower() in TIFF else None
    if meaning == CIELAB or (meaning == WHITE_IS_ZERO and image.dtype.kind == "f"):
        kind = "CIE L*a*b*" if meaning == CIELAB else "of floats whose zero is white"
        raise FileFormatError(
            f"image {path} is {kind}, which OpenCV does not read by its meaning; save it as RGB or "
            "grey whose zero is black"
        )
    if meaning == WHITE_IS_ZERO and image.dtype == np.uint16:  # OpenCV turns 8 bits round itself
        pixels = np.iinfo(np.uint16).max - pixels
    elif path.suffix.lower() in NETPBM and white_level is None:
        full = np.iinfo(pixels.dtype).max
        pixels = np.rint(pixels * (full / _netpbm_white(path, full))).astype(pixels.dtype)
    return pixels


def _photometric(path: Path) -> int | None:
    """The PhotometricInterpretation that a TIFF states."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        return tiff_tags(data).get(PHOTOMETRIC)


def _netpbm_white(path: Path, full: int) -> int:
    """The value of white that a PGM or PPM states, where OpenCV has not scaled by it."""
    with path.open("rb") as file:
        head = _NETPBM_HEAD.match(re.sub(rb"#[^\n]*", b"", file.read(HEAD_BYTES)))
    white = int(head["white"]) if head else 0
    is_scaled = head is not None and head["kind"] in (b"P2", b"P3") and white <= MAX_BYTE
    return full if is_scaled else white or full


def coding_facts(paths: Sequence[Path]) -> dict[str, Any]:
    """Coding of images, for a source's metadata: nothing where they are gamma-coded.

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
    # A link whose target is missing counts, so that it is missed.
    is_named = path.suffix.lower() in IMAGE_EXTENSIONS and not path.name.startswith(".")
    return is_named and not path.is_dir()


def _refuse_lost(paths: Sequence[Path]) -> None:
    lost = [path.name for path in paths if not path.is_file()]
    if lost:
        raise InputError(
            f"{len(lost)} of {len(paths)} images in {paths[0].parent} are links to files that are "
            f"not there ({few(lost)}); fetch them (git annex get, dvc pull), or delete the links"
        )


def _named_images(listing: Timestamps, file: Path, folder: Path) -> list[Path]:
    paths: list[Path] = []
    for name in listing.names or ():
        usable_path(name)
        candidates = (file.parent / name, folder / name, folder / Path(name).name)
        inside = (one for one in candidates if _is_below(one, file.parent, folder))
        path = next((candidate for candidate in inside if candidate.is_file()), None)
        if path is None:
            raise InputError(
                f"{file} names {shown(name)}, which is neither beside it nor in {folder}; "
                "remove the line or restore the image"
            )
        if not path.parent.resolve().is_relative_to(folder.resolve()):
            raise InputError(
                f"{file} names {path}, which is not in {folder}; give a frame rate (`fps`), or "
                "`timestamps` that name the images of this folder"
            )
        paths.append(path)
    return paths


def _warn_of_unnamed(file: Path, named: Sequence[Path], folder: Path) -> None:
    """Say that a list, found without being asked for, leaves images of the folder out."""
    known = {os.path.normpath(path) for path in named}
    others = [path for path in folder.iterdir() if _is_image(path)]
    left = sorted(path.name for path in others if os.path.normpath(path) not in known)
    if left:
        warn(
            f"{file}, found beside the images, names {len(known)} of {len(known) + len(left)} "
            f"images; {few(left)} are left out. Give `timestamps` if that is meant, or `fps` for "
            "all"
        )


def _is_below(path: Path, *folders: Path) -> bool:
    """Whether a path lies in one of the folders by its words: a list names no private files."""
    words = Path(os.path.normpath(path))
    return any(words.is_relative_to(os.path.normpath(folder)) for folder in folders)
