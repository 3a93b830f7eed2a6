"""What a run writes and how it talks: options that `generate` and `simulate` share."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.io.atomic import check_output
from texvent.options.fields import renamed


@dataclass(frozen=True, kw_only=True)
class OutputOptions:
    """What is written, and where."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    out: Path | None = None
    """Event file to write; its extension decides the format. Without it: a name made from the
    input, ending in .h5, in the current folder."""
    video: bool = renamed(True, was="film")
    """Write a preview video (.mp4): source frames on the left, events on the right."""
    still: bool = True
    """Write an image of the busiest moment (.png)."""
    page: bool = True
    """Write a page (.html): x-y-t point cloud, event rate, facts of the run."""
    events_only: bool = False
    """Write the event file only: no video, image or page."""
    palette: str = "paper"
    """Colours of events in video, image and page."""
    overwrite: bool = False
    """Replace files that exist already."""
    config: Path | None = None
    """TOML or YAML file with options; flags override it."""
    print_config: bool = False
    """Print all resolved options as TOML, ready for --config, and stop."""
    dry_run: bool = False
    """Try a few frames, estimate events, time and memory of the whole run, and stop."""
    quiet: bool = False
    """No progress and no summary; only errors."""

    @property
    def previews(self) -> tuple[str, ...]:
        """Kinds of preview to write, as file extensions without the dot."""
        if self.events_only:
            return ()
        wanted = {"mp4": self.video, "png": self.still, "html": self.page}
        return tuple(kind for kind, is_wanted in wanted.items() if is_wanted)

    def check(self, subject: str) -> None:
        """Refuse outputs that cannot be written, before minutes of work.

        Raises:
            OutputError: a file exists already, or its folder is missing or not writable.
        """
        path = self.event_file(subject)
        if not self.dry_run:
            for one in (path, *(path.with_suffix(f".{kind}") for kind in self.previews)):
                check_output(one, overwrite=self.overwrite)

    def event_file(self, subject: str) -> Path:
        """The event file: the one asked for, or a name made from a prompt or a file's name."""
        if self.out is not None:
            return self.out
        words = re.findall(r"[a-z0-9]+", subject.lower())[:8]
        return Path(f"{'-'.join(words) or 'events'}.h5")
