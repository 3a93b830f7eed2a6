"""Opening of video files and streams by libav, alike with every version of PyAV."""

from __future__ import annotations

import errno
import functools
import os
from pathlib import Path
from typing import Any

import av
from av.container import InputContainer

# Titles and comments need not be UTF-8. Up to PyAV 18 they then end the opening; later versions
# take them, and have no such option.
_TOLERANT: dict[str, Any] = (
    {"metadata_errors": "replace"} if int(av.__version__.partition(".")[0]) < 19 else {}
)
SCARCE = frozenset((errno.EAGAIN, errno.ENOMEM, errno.EMFILE, errno.ENFILE))
"""Errors of the system where threads, memory or open files have run out."""
LEADING_ELSEWHERE = frozenset(
    (
        *("hls", "concat", "dash", "imf", "webm_dash_manifest", "sdp", "rtsp", "rtp", "sap"),
        *("avisynth", "vapoursynth", "lavfi"),
    )
)
"""Formats whose files name other files and addresses, or are programs."""

NO_TIMESTAMPS = 0x80
"""libav's AVFMT_NOTIMESTAMPS."""

NO_DELAY = {"default_fps": "10"}
"""Frames of an animated PNG without a delay take 0.1 s, as those of a GIF do and in browsers."""


def open_media(address: Any, **options: Any) -> InputContainer:
    """Container of a stream or a device, whatever its titles are coded in.

    Args:
        address: as for `av.open`: an address or a file object.
        **options: others of `av.open`.

    Raises:
        FFmpegError: it cannot be opened.
    """
    container: InputContainer = av.open(address, mode="r", **_TOLERANT, **options)
    return container


def open_media_file(path: Path) -> InputContainer:
    """Container of a video file that leads to no other file; see `open_media`."""
    # With the protocol named, a colon in the path is not taken for one.
    return open_media(f"file:{path}", options={**only_self_contained(), **NO_DELAY})


@functools.cache
def only_self_contained() -> dict[str, str]:
    """The option of `av.open` that refuses playlists and scripts by format, before they are read.

    A video from someone else could otherwise show any file of this machine.
    """
    return {"format_whitelist": ",".join(sorted(av.formats_available - LEADING_ELSEWHERE))}


def is_timeless(container: InputContainer) -> bool:
    """Whether a format holds images without times, for which libav invents 25 per second."""
    return bool(container.format.flags & NO_TIMESTAMPS) or "_pipe" in container.format.name


def raise_scarcity(error: BaseException, name: object) -> None:
    """Pass on what is no fault of a file: threads, memory or open files have run out.

    Raises:
        OSError: `error` says so.
    """
    number = getattr(error, "errno", None)
    if number in SCARCE:
        reason = f"{os.strerror(number)}; decoding needs a higher limit of processes or memory"
        raise OSError(number, reason, str(name)) from error
