"""What a path is that is not what a command reads: missing, a video, an image, a page."""

from __future__ import annotations

import re
import sys
from pathlib import Path

from texvent.errors import InputError
from texvent.runtime.file_names import IMAGE_EXTENSIONS, VIDEO_EXTENSIONS

_KINDS = {
    "a video; texvent simulate makes its events": VIDEO_EXTENSIONS,
    "an image; texvent simulate takes a folder of images": IMAGE_EXTENSIONS,
    "a page, made of an event file; give that": (".html", ".htm"),
    "a file of options, for --config": (".toml", ".yaml", ".yml"),
}
_KIND_OF = {extension: kind for kind, names in _KINDS.items() for extension in names}


def refuse_other_kind(path: Path) -> None:
    """Refuse a path that is to be read as events and is missing, or of another kind by its name.

    Raises:
        InputError: see above; the message names the command that takes it.
    """
    refuse_missing(path)
    kind = _KIND_OF.get(path.suffix.lower())
    if kind is not None:
        raise InputError(f"{path} is no event file: it is {kind}")


def refuse_missing(path: Path, what: str = "file") -> None:
    """Refuse a path at which there is nothing.

    Args:
        path: a file, folder or camera.
        what: what a path without a folder's or a camera's name should be.

    Raises:
        InputError: see above; a missing camera, or the first folder that is missing, is named.
    """
    if path.exists():
        return
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
    raise InputError(f"no such {what}: {path}; check the name and the folder")
