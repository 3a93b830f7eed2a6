"""The preview video of a run: source frame on the left, events on the right."""

from __future__ import annotations

from contextlib import ExitStack
from fractions import Fraction
from pathlib import Path

from texvent.sensor import SensorSize
from texvent.video import PREVIEW_MARK
from texvent.view.atomic_output import AtomicOutput
from texvent.view.drawing.event_image import count_ceiling
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.drawing.panels import TARGET_WIDTH, PanelLayout
from texvent.view.video.encoder import VideoEncoder
from texvent.view.windows.draw_window import compose_window
from texvent.view.windows.event_window import EventWindow

GIF_WIDTH = 640.0
"""A gif compresses badly, so it is kept small."""
CEILING_MEMORY = 0.9
"""Share of the colour scale that is kept from one video frame to the next, against flicker."""


class VideoWriter(AtomicOutput):
    """Writes an mp4 or gif of windows while they come in; memory stays flat.

    Each is shown until the next one. Times are kept to the µs (gif: 1/100 s).

    Raises:
        ConfigError: the extension is not .mp4 or .gif, or the palette is unknown.
        OutputError: the file exists already or cannot be written.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        size: SensorSize,
        fps: Fraction | None,
        palette: str | Palette = DEFAULT_PALETTE,
        side_by_side: bool = True,
        overwrite: bool = False,
        title: str = "",
    ) -> None:
        """Check the path; the `with` statement opens it.

        Args:
            path: .mp4 or .gif file.
            size: sensor size, pixels.
            fps: nominal rate of the source frames, or None where it is not known.
            palette: colours, by name.
            side_by_side: whether the frames are shown, or only the events.
            overwrite: whether an existing file may be replaced.
            title: text of the caption, such as the prompt.
        """
        super().__init__()
        width = GIF_WIDTH if Path(path).suffix.lower() == ".gif" else TARGET_WIDTH
        self._layout = PanelLayout(size, get_palette(palette), side_by_side, width)
        self._encoder = VideoEncoder(
            path,
            width=self._layout.width,
            height=self._layout.height,
            fps=fps or Fraction(30),
            comment=PREVIEW_MARK,
            overwrite=overwrite,
        )
        self._title = title
        self._first_us: int | None = None
        self._stop_us: int | None = None
        self._ceiling = 1.0

    def _open(self, stack: ExitStack) -> None:
        stack.enter_context(self._encoder)

    def show(self, window: EventWindow, *, video_start_us: int | None = None) -> None:
        """Add one video frame.

        Args:
            window: what it shows.
            video_start_us: when it appears, µs from the start of the video; default: as long
                after the first window as in the recording.
        """
        if self._first_us is None:
            self._first_us = window.start_us
        start_us = window.start_us - self._first_us if video_start_us is None else video_start_us
        self._ceiling = max(count_ceiling(window.counts), CEILING_MEMORY * self._ceiling)
        image = compose_window(
            window,
            self._layout,
            title=self._title,
            facts=window.caption,
            ceiling=self._ceiling,
        )
        self._encoder.write(image, start_us)
        # With its own timing, the caller's nominal rate decides how long the last one stays.
        self._stop_us = window.stop_us - self._first_us if video_start_us is None else None

    def _complete(self) -> None:
        if self._stop_us is not None:
            self._encoder.end(self._stop_us)
