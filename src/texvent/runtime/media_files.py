"""Opening of video files, alike with every version of PyAV."""

from __future__ import annotations

from typing import Any

import av
from av.container import InputContainer

# Titles and comments need not be UTF-8. Up to PyAV 18 they then end the opening; later versions
# take them, and have no such option.
_TOLERANT: dict[str, Any] = (
    {"metadata_errors": "replace"} if int(av.__version__.partition(".")[0]) < 19 else {}
)


def open_media(address: Any, **options: Any) -> InputContainer:
    """Container of a video file, a stream or a device, whatever its titles are coded in.

    Args:
        address: as for `av.open`: a path, an address, or a file object.
        **options: others of `av.open`.

    Raises:
        FFmpegError: it cannot be opened.
    """
    container: InputContainer = av.open(address, mode="r", **_TOLERANT, **options)
    return container
