"""Frames in a notebook."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

import numpy as np

from texvent.errors import TexventError
from texvent.video import (
    MICROSECONDS,
    Frame,
    FrameStream,
    RenderableStream,
    Video,
    describe_stream,
)
from texvent.view.notebook.bundle import facts_grid, framed, heading, note
from texvent.view.notebook.facts import made_by, size_text, title_text
from texvent.view.notebook.stills import frame_figure

STRIP_FRAMES = 4
MOST_RENDERED_PIXELS = 640 * 480
"""A rendered scene of more pixels is not drawn only to be shown."""


def frame_html(frame: Frame) -> str:
    """One frame with its time."""
    summary = f"{frame!r} · {size_text(frame.size)}"
    return framed(
        heading("", summary),
        f'<div class="views">{frame_figure([frame], f"{frame.t_us / MICROSECONDS:.6f} s")}</div>',
        facts_grid({"Motion vectors": "yes" if frame.motion is not None else None}),
    )


def video_html(frames: FrameStream) -> str:
    """Frames of a stream: four of those in memory, the first of those that can be read again.

    Nothing is taken from a stream that can be read once.
    """
    strip: list[Frame] = []
    why = ""
    if isinstance(frames, Video):
        chosen = np.unique(np.linspace(0, len(frames) - 1, STRIP_FRAMES).round().astype(int))
        strip = [frames[int(index)] for index in chosen]
    elif frames.is_live:
        why = "A live source can be read once; no frame was taken to show it."
    elif (
        isinstance(frames, RenderableStream)
        and frames.size.width * frames.size.height > MOST_RENDERED_PIXELS
    ):
        why = "Frames are rendered when they are asked for."
    else:
        strip, why = _first_frame(frames)
    times = ", ".join(f"{one.t_us / MICROSECONDS:.3f}" for one in strip)
    caption = f"{'Frames' if len(strip) > 1 else 'Frame'} at {times} s"
    figure = frame_figure(strip, caption) if strip else ""
    return framed(
        heading(title_text(frames.metadata), describe_stream(frames)),
        f'<div class="views">{figure}</div>' if figure else "",
        note(why) if why else "",
        facts_grid(made_by(frames.metadata) | _times(frames)),
    )


def _first_frame(frames: FrameStream) -> tuple[list[Frame], str]:
    """The first frame, or why there is none."""
    reader = iter(frames)
    try:
        return [next(reader)], ""
    except StopIteration:
        return [], "The stream has no frame."
    except (TexventError, OSError) as error:
        return [], f"No frame could be read: {error}"
    finally:
        _close(reader)


def _close(reader: Iterator[Frame]) -> None:
    """Let go of the file that the reader holds open."""
    close = getattr(reader, "close", None)
    if close is not None:
        with contextlib.suppress(TexventError):
            close()


def _times(frames: FrameStream) -> dict[str, str]:
    if frames.fps is None or not frames.frame_count:
        return {}
    return {"Duration": f"{float(frames.frame_count / frames.fps):.3f} s"}
