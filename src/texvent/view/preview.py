"""Previews of a run: video, still image and page, written in one pass."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent._registry import suggest
from texvent.errors import ConfigError, InputError, shown
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.io.atomic import AtomicOutput, atomic_file, check_output
from texvent.sensor import SensorSize
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.drawing.panels import title_of
from texvent.view.page.writer import PageWriter
from texvent.view.stills import BusiestWindow
from texvent.view.video_writer import VideoWriter
from texvent.view.windows import EventWindow, WindowCollector

PREVIEW_KINDS = ("mp4", "gif", "png", "html")


class Preview(AtomicOutput):
    """Writes `out.mp4`, `out.png` and `out.html` while a run goes on; memory stays flat.

    The files appear when the `with` block ends; an exception inside it leaves none.

    Raises:
        InputError: the `with` block ends without a frame.
        ConfigError: an unknown kind or palette.
        OutputError: a file exists already or cannot be written.
    """

    def __init__(
        self,
        stem: str | Path,
        *,
        size: SensorSize,
        fps: Fraction | None,
        kinds: tuple[str, ...] = ("mp4", "png", "html"),
        palette: str | Palette = DEFAULT_PALETTE,
        overwrite: bool = False,
        metadata: Mapping[str, Any] | None = None,
    ) -> None:
        """Check every path; the `with` statement opens them.

        Args:
            stem: path without extension: `runs/car` gives `runs/car.mp4` and so on.
            size: sensor size, pixels.
            fps: nominal rate of the source frames, or None where it is not known.
            kinds: which files, by extension.
            palette: colours, by name.
            overwrite: whether existing files may be replaced.
            metadata: facts of the run; a prompt becomes the title.
        """
        super().__init__()
        unknown = [kind for kind in kinds if kind not in PREVIEW_KINDS]
        if unknown:
            raise ConfigError(
                f"unknown preview {shown(unknown[0])}; {suggest(unknown[0], PREVIEW_KINDS)}"
            )
        self._paths = {kind: preview_path(stem, kind) for kind in kinds}
        for path in self._paths.values():
            check_output(path, overwrite=overwrite)
        self._overwrite = overwrite
        facts = dict(metadata or {})
        colours, title = get_palette(palette), title_of(facts)
        self._collector = WindowCollector(size)
        self._still = BusiestWindow(size=size, palette=colours, title=title)
        self._videos = [
            VideoWriter(path, size=size, fps=fps, palette=colours, overwrite=overwrite, title=title)
            for kind, path in self._paths.items()
            if kind in ("mp4", "gif")
        ]
        self._page: PageWriter | None = None
        if "html" in self._paths:
            self._page = PageWriter(
                self._paths["html"],
                size=size,
                metadata=facts,
                palette=colours,
                overwrite=overwrite,
            )
        self._png_part: Path | None = None
        self._shown = 0

    @property
    def paths(self) -> tuple[Path, ...]:
        """The files it writes."""
        return tuple(self._paths.values())

    def _open(self, stack: ExitStack) -> None:
        for video in self._videos:
            stack.enter_context(video)
        if self._page is not None:
            stack.enter_context(self._page)
        if "png" in self._paths:
            part = atomic_file(self._paths["png"], overwrite=self._overwrite)
            self._png_part = stack.enter_context(part)

    def append(self, frame: Frame, packet: EventStream) -> None:
        """Add a dense frame and the events before it, `[time of the frame before, frame.t_us)`.

        Only source frames are shown; events of the intermediate ones count for the next.
        """
        if self._page is not None:
            self._page.append(packet)
            self._page.append_frame(frame)
        window = self._collector.append(frame, packet)
        if window is not None:
            self._show(window)

    def add_metadata(self, facts: Mapping[str, Any]) -> None:
        """Show more facts of the run on the page, known only now."""
        if self._page is not None:
            self._page.add_metadata(facts)

    def _complete(self) -> None:
        only = self._collector.single_frame()
        if self._shown == 0 and only is not None:
            self._show(only)
        png = self._still.png()
        if png is None:
            raise InputError("no frame was given, so there is nothing to show")
        if self._page is not None:
            self._page.still = png
        if self._png_part is not None:
            self._png_part.write_bytes(png)

    def _show(self, window: EventWindow) -> None:
        self._shown += 1
        for video in self._videos:
            video.show(window)
        self._still.consider(window)


def preview_path(stem: str | Path, kind: str) -> Path:
    """Path of one preview: dots in the stem stay.

    Example:
        >>> preview_path("runs/v1.2", "png").as_posix()
        'runs/v1.2.png'
    """
    stem = Path(stem)
    return stem.with_name(f"{stem.name}.{kind}")
