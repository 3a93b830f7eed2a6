"""Checks of input files: that they exist, are event files, sound, and hold valid events."""

from __future__ import annotations

import os
import re
import struct
import sys
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import (
    FileFormatError,
    InputError,
    MissingDependencyError,
    is_address,
    one_line,
    shown,
    without_password,
)
from texvent.events import OPTIONAL_COLUMNS, EventStream
from texvent.io.reading import PER_SECOND, TimeUnit
from texvent.runtime.files.file_names import IMAGE_EXTENSIONS, VIDEO_EXTENSIONS, usable_path
from texvent.runtime.memory import check_proportion
from texvent.sensor import SensorSize, checked_size

_KINDS = {
    "a video; texvent simulate makes its events": VIDEO_EXTENSIONS,
    "an image; texvent simulate takes a folder of images": IMAGE_EXTENSIONS,
    "a page, made of an event file; give that": (".html", ".htm"),
    "a file of options, for --config": (".toml", ".yaml", ".yml"),
}
_KIND_OF = {extension: kind for kind, names in _KINDS.items() for extension in names}
PICKLE = "a pickle, which could run code and is not loaded; save its arrays as .npz"
FORMS = {
    ".mat": "of MATLAB, before version 7.3; save it with -v7.3, or t, x, y, p as .csv",
    **dict.fromkeys((".feather", ".arrow", ".ipc"), "of Arrow; save its table as .parquet"),
    **dict.fromkeys((".pkl", ".pickle", ".pt", ".pth"), PICKLE),
}
"""Extension → form in which events are not read, and a way."""


class NotReadError(InputError):
    """A file may hold events, in a form that is not read; the message names a way."""


def refuse_other_kind(path: Path) -> None:
    """Refuse a path that is to be read as events and is missing, or of another kind by its name.

    Raises:
        InputError: see above; the message names the command that takes it.
    """
    refuse_missing(path)
    kind = _KIND_OF.get(path.suffix.lower())
    if kind is not None:
        raise InputError(f"{path} is no event file: it is {kind}")
    form = FORMS.get(path.suffix.lower())
    if form is not None:
        raise NotReadError(f"{path} is {form}")


def refuse_missing(path: Path, what: str = "file") -> None:
    """Refuse a path at which there is nothing.

    Raises:
        InputError: see above; a missing camera, or the first folder that is missing, is named.
    """
    if path.exists():
        return
    if is_address(str(path)):  # a path keeps one of its slashes
        raise InputError(f"{without_password(str(path))} is an address; here a {what} is read")
    if re.fullmatch(r"/dev/video\d+", path.as_posix()):
        if sys.platform != "linux":
            camera = "dshow -i video=NAME" if sys.platform == "win32" else "avfoundation -i 0"
            raise InputError(
                f"{path} is a camera's name on Linux; on this system let ffmpeg read the camera: "
                f"ffmpeg -f {camera} -f mjpeg - | texvent simulate - -o events.h5"
            )
        cameras = sorted(map(str, Path("/dev").glob("video*")))
        there = f"there is {', '.join(cameras[:8])}" if cameras else "there is none on this machine"
        raise InputError(f"no such camera: {path}; {there}")
    missing = [folder for folder in path.parents if not folder.exists()]
    if missing:
        raise InputError(f"no such folder: {missing[-1]} (of {path}); check its name")
    what = what if path.suffix else f"{what} or folder"
    is_prompt = not path.suffix and " " in path.name
    hint = "a prompt is for texvent generate" if is_prompt else "check the name and the folder"
    raise InputError(f"no such {what}: {path}; {hint}")


ZIP_DAMAGE = (
    OSError,
    ValueError,
    EOFError,
    MemoryError,
    NotImplementedError,
    RuntimeError,
    struct.error,
    zipfile.BadZipFile,
    zlib.error,
)
"""zipfile raises any of these on a damaged archive."""


TIMESTAMP_SCALE_MS = 0.001
"""Milliseconds per unit of time in files that state it."""


def existing_file(path: str | Path) -> Path:
    """The path of a readable file.

    Raises:
        InputError: there is no such file, it is a folder, or it must not be read.
    """
    path = usable_path(path)
    if path.is_dir():
        raise InputError(f"{path} is a folder; give the name of an event file")
    refuse_missing(path)
    if not path.is_file():
        raise InputError(f"{path} is a device or a pipe; give the name of an event file")
    if not os.access(path, os.R_OK):
        raise InputError(f"{path} must not be read by this user; change its permissions")
    return path


def existing_folder(path: str | Path) -> Path:
    """The path of a readable folder.

    Raises:
        InputError: there is no such folder, it is a file, or it must not be read.
    """
    path = usable_path(path)
    if not path.exists():
        raise InputError(f"no such folder: {path}; check the name")
    if not path.is_dir():
        raise InputError(f"{path} is a file; this format is a folder of files")
    if not os.access(path, os.R_OK | os.X_OK):
        raise InputError(f"{path} must not be read by this user; change its permissions")
    return path


def begins_with(path: Path, magic: bytes) -> bool:
    """True if the file can be read and begins with these bytes."""
    try:
        with path.open("rb") as file:
            return file.read(len(magic)) == magic
    except OSError:
        return False


@contextmanager
def reporting_damage(path: Path, kind: str, damage: tuple[type[Exception], ...]) -> Iterator[None]:
    """Turn what a library raises on a damaged file into an error that names the file.

    Raises:
        FileFormatError: one of `damage` was raised inside the block.
    """
    try:
        yield
    except (InputError, MissingDependencyError):
        raise
    except damage as error:
        raise FileFormatError(f"{path} is damaged or not {kind} ({one_line(error)})") from error


def check_zip(path: Path, archive: zipfile.ZipFile) -> None:
    """Refuse an archive that claims to unpack out of proportion; see `check_proportion`."""
    check_proportion(sum(entry.file_size for entry in archive.infolist()), path)


def stated_unit(path: Path, stored: Any) -> TimeUnit | None:
    """Unit of time that a file states as milliseconds per unit; None if it states none.

    Raises:
        FileFormatError: it is not the length of a unit.
    """
    if stored is None:
        return None
    scale = np.asarray(stored)
    is_number = scale.size == 1 and scale.dtype.kind in "fiu"
    for unit, per_second in PER_SECOND.items():
        if is_number and np.isclose(float(scale.reshape(-1)[0]) * per_second, 1000):
            return unit
    raise FileFormatError(
        f"{path} counts time in units of {shown(scale)} ms; texvent reads s, ms, us and ns"
    )


def stream_from_file(
    path: Path, columns: Mapping[str, NDArray[Any]], size: SensorSize, metadata: Mapping[str, Any]
) -> EventStream:
    """Columns x, y, t, p of a file, and others it has, as a stream; what is wrong is its fault.

    Raises:
        FileFormatError: lengths, order, coordinates or polarities are wrong.
    """
    try:
        return EventStream(
            columns["x"],
            columns["y"],
            columns["t"],
            columns["p"],
            size,
            metadata,
            *(columns.get(name) for name in OPTIONAL_COLUMNS),
        )
    except (InputError, OverflowError) as error:
        raise FileFormatError(f"{path} holds wrong events: {error}") from error


def stored_or_given_size(
    path: Path, stored: tuple[int, int] | None, given: SensorSize | None
) -> SensorSize:
    """The sensor size a file states, else the one the caller gave; it is never guessed.

    Raises:
        InputError: there is neither, or they differ.
        FileFormatError: the stored size is impossible.
    """
    if stored is None:
        if given is None:
            raise InputError(
                f"{path} does not store the sensor size; give it "
                "(size='davis240c' or size='240x180' in Python, --sensor on the command line)"
            )
        return checked_size(*given)
    try:
        size = checked_size(*stored)
    except InputError as error:
        raise FileFormatError(f"{path} states an impossible {error}") from error
    if given is not None and tuple(given) != tuple(size):
        raise InputError(
            f"{path} was recorded at {size}, not {given[0]}x{given[1]}; "
            "leave the size out, or name a file of that size"
        )
    return size
