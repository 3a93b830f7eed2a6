"""libav with limits: the files that it may open, the frames that it may make, and its refusals."""

from __future__ import annotations

import errno
import functools
import os

SCARCE = frozenset((errno.EAGAIN, errno.ENOMEM, errno.EMFILE, errno.ENFILE))
"""Errors of the system where threads, memory or open files have run out."""
LEADING_ELSEWHERE = frozenset(
    (
        *("hls", "concat", "dash", "imf", "webm_dash_manifest", "sdp", "rtsp", "rtp", "sap"),
        *("avisynth", "vapoursynth", "lavfi"),
    )
)
"""Formats whose files name other files and addresses, or are programs."""


@functools.cache
def only_self_contained() -> dict[str, str]:
    """The option of `av.open` that refuses playlists and scripts by format, before they are read.

    A video from someone else could otherwise show any file of this machine.
    """
    import av  # brings 40 MB of libraries

    return {"format_whitelist": ",".join(sorted(av.formats_available - LEADING_ELSEWHERE))}


def raise_scarcity(error: BaseException, name: object) -> None:
    """Pass on what is no fault of a file: threads, memory or open files have run out.

    Raises:
        OSError: `error` says so.
    """
    number = getattr(error, "errno", None)
    if number in SCARCE:
        reason = f"{os.strerror(number)}; decoding needs a higher limit of processes or memory"
        raise OSError(number, reason, str(name)) from error
