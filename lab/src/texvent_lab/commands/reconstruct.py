"""`texvent reconstruct EVENTS -o out.mp4`: images from events alone, by a published network."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any, ClassVar

from texvent.cli.event_files.event_file_options import EventRangeOptions
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.extending import full_version
from texvent.frames import MICROSECONDS
from texvent.represent.slices import slice_by_count, slice_regularly
from texvent.runtime.console_progress import ConsoleProgress
from texvent.view.video_writer import check_image_output, open_image_sink
from texvent_lab.reconstruct.reconstructor import (
    ReconstructConfig,
    Reconstructor,
    load_reconstructor,
)

DESCRIPTION = """Reconstruct intensity images from events by a published network: pie-net, whose
package brings its weights, or one whose weights you provide (docs/reconstruction.md); or depth.

  texvent reconstruct out.h5 -o out.mp4
  texvent reconstruct out.h5 -o frames/ --network e2vid --weights e2vid.pth
  texvent reconstruct out.h5 -o d.mp4 --network e2depth --weights e2depth.pth"""


@dataclass(frozen=True, kw_only=True)
class ReconstructOptions(EventRangeOptions):
    """Events to reconstruct, and files of the images."""

    short_flags: ClassVar[Mapping[str, str]] = {
        **EventRangeOptions.short_flags,
        **{"out": "-o", "quiet": "-q"},
    }
    main_options: ClassVar[tuple[str, ...]] = (
        *("out", "network", "weights", "fps", "events_per_image", "time", "sensor", "device"),
        "overwrite",
    )

    out: Path = REQUIRED
    """Video (.mp4 or .gif), or a folder of PNG files and their times, which texvent simulate reads
    again."""
    fps: Fraction = Fraction(30)
    """Images per second of the recording; each is made from the events since the one before."""
    events_per_image: int | None = None
    """Events per image, instead of a fixed time."""
    overwrite: bool = False
    """Replace the file or folder if it exists already."""
    quiet: bool = False
    """No progress and no summary."""

    def __post_init__(self) -> None:
        if not 0 < self.fps <= MICROSECONDS:
            raise ConfigError(f"fps is {self.fps}; it must be above 0, at most {MICROSECONDS}")
        check_range("events_per_image", self.events_per_image, 1)

    def slices(self, events: EventPackets) -> Iterator[tuple[int, EventStream]]:
        """The events of each image, and its time."""
        if self.events_per_image is not None:
            return slice_by_count(events, count=self.events_per_image, size=events.size)
        return slice_regularly(events, step_us=MICROSECONDS / self.fps)


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    options, network = parse_configs(
        arguments,
        {"input": ReconstructOptions(), "network": ReconstructConfig()},
        prog="texvent reconstruct",
        description=DESCRIPTION,
    )
    check_image_output(options.out, overwrite=options.overwrite)
    events = options.open()
    reconstructor = load_reconstructor(network.network, network.weights, device=network.device)
    images = reconstructor.reconstruct_all(options.slices(events))
    facts = _provenance(reconstructor, options, events)
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        opened = open_image_sink(
            options.out, size=events.size, fps=options.fps, facts=facts, overwrite=options.overwrite
        )
        with opened as sink:
            for number, (t_us, image) in enumerate(images, start=1):
                sink.add(t_us, reconstructor.picture(image))
                progress.advance("reconstructing", number, None)
    if not options.quiet:
        write_out(f"{options.out}\n")
    return 0


def _provenance(
    reconstructor: Reconstructor, options: ReconstructOptions, events: EventPackets
) -> dict[str, Any]:
    """Provenance of the images, ready for JSON."""
    return {
        "events": {"source": str(options.path), **events.metadata},
        "network": reconstructor.name,
        "weights_sha256": reconstructor.sha256,
        "fps": str(options.fps),
        "events_per_image": options.events_per_image,
        "time": options.time,
        "texvent_version": full_version(),
    }
