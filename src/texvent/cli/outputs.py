"""Output options of `generate` and `simulate`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent._registry import suggest
from texvent.errors import ConfigError, shown
from texvent.io.atomic import check_outputs
from texvent.io.files import codec_for, extension_of
from texvent.run.files import RunFiles
from texvent.runtime.files.file_names import file_stem
from texvent.truth.layout import check_truth_folder, parse_parts
from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette

PREVIEWS = ("mp4", "png", "html")
"""Kinds of preview, by extension."""


@dataclass(frozen=True, kw_only=True)
class OutputOptions:
    """Output files and messages."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    out: Path | None = None
    """Event file; its extension decides the format. Without it: a name made from the input, in the
    current folder."""
    format: str | None = None
    """Format to write, where the extension does not say which (docs/files.md lists them)."""
    previews: str = "mp4,png,html"
    """Files beside the events: mp4, png, html or none. With commas between: a video of frames and
    events (.events.mp4), an image of the busiest moment (.events.png), a page with point cloud,
    rate and facts (.events.html)."""
    palette: str = DEFAULT_PALETTE
    """Colours of the previews, such as paper-dark (docs/views.md lists them)."""
    truth: str = ""
    """Write ground truth of the scene beside the events (out.h5: out.truth/): flow, flow-back,
    depth, ids, boxes, poses, events, with commas between, or all. See docs/truth.md."""
    overwrite: bool = False
    """Replace files that exist already."""
    config: Path | None = None
    """TOML or YAML file with options; flags override it."""
    print_config: bool = False
    """Print all resolved options as TOML, ready for --config, and stop."""
    dry_run: bool = False
    """Estimate events, time and memory, and stop. Parts of the clip are simulated, from its
    beginning to its end."""
    keep_partial: bool = False
    """If the run is stopped (Ctrl-C, SIGTERM) or the video ends in damage, keep what is done: the
    files end there and say so (complete = false). A second Ctrl-C discards them."""
    quiet: bool = False
    """No progress and no summary; only warnings and errors."""

    @property
    def preview_kinds(self) -> tuple[str, ...]:
        """Kinds of preview to write, as file extensions without the dot.

        Raises:
            ConfigError: an unknown kind, or none beside others.
        """
        given = [kind.strip() for kind in self.previews.split(",") if kind.strip()]
        if given == ["none"]:
            return ()
        for kind in given:
            if kind == "none":
                raise ConfigError(f"previews is {shown(self.previews)}; give none alone, or kinds")
            if kind not in PREVIEWS:
                raise ConfigError(
                    f"previews has {shown(kind)}; {suggest(kind, (*PREVIEWS, 'none'))}"
                )
        return tuple(kind for kind in PREVIEWS if kind in given)

    @property
    def truth_parts(self) -> tuple[str, ...]:
        """Parts of ground truth to write.

        Raises:
            ConfigError: an unknown part.
        """
        return parse_parts(self.truth)

    def files(self, subject: str) -> RunFiles:
        """The files to write, checked; without a name, one is made from a prompt or a file's name.

        Raises:
            ConfigError: an unknown format.
            OutputError: a file exists already, is an input, or its folder is missing or not
                writable.
        """
        files = RunFiles(
            events=self.out or default_event_file(subject, self.format),
            format=self.format,
            previews=self.preview_kinds,
            palette=get_palette(self.palette).name,
            truth=self.truth_parts,
            overwrite=self.overwrite,
            keep_partial=self.keep_partial,
        )
        codec_for(files.events, self.format)
        overwrite = self.overwrite or self.dry_run  # which writes nothing
        check_outputs(files.paths, overwrite=overwrite)
        if files.truth_folder is not None:
            check_truth_folder(files.truth_folder, overwrite=overwrite)
        return files


def default_event_file(subject: str, format: str | None = None) -> Path:
    """A name made of the first words of a prompt or of a file's name, in the current folder."""
    extension = extension_of(format) if format else ".h5"
    return Path(f"{file_stem(subject)}{extension}")
