"""`texvent convert IN OUT`: another format, a part of it, several in one, filtered."""

from __future__ import annotations

import contextlib
import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, cast

from texvent._registry import FILTERS
from texvent.cli.event_files.event_file_options import FileFactOptions, keep_time_range
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, FileFormatError, InputError, few, shown, warn
from texvent.event_packets import EventPackets
from texvent.frames import FrameStream
from texvent.io.atomic import atomic_file, check_outputs
from texvent.io.block_writer import Columns
from texvent.io.calibration import read_calibration
from texvent.io.files import codec_that_reads, open_writer, side_data
from texvent.io.pixel_mask import read_pixel_mask
from texvent.io.split_files import read_intervals, write_split
from texvent.options.values import make_part
from texvent.runtime.console_progress import ConsoleProgress
from texvent.runtime.files.file_names import usable_path
from texvent.sensor import SensorSize, parse_sensor
from texvent.transform.edits import Axes, Region, crop, flip, merge, resize, rotate, start_at_zero
from texvent.transform.filters.apply import filter_events
from texvent.transform.filters.noise_filters import MaskFilter
from texvent.transform.packets import note_edit
from texvent.transform.undistort import undistort

DESCRIPTION = """Convert an event file, or a part of it, to another format. Memory stays flat.

  texvent convert davis.aedat4 davis.h5
  texvent convert davis.h5 part.raw --time 0.5,2 --crop 100,50,128,128
  texvent convert left.h5 both.h5 --merge right.h5
  texvent convert davis.h5 clean.h5 --filter hot-pixels background-activity

Edits happen in this order: merge, mask, filter, undistort, crop,
resize, rotate, flip, from-zero, time."""

WITH_FRAMES = "event-utils"
"""Format of events and frames in one file."""
SIDE_FILES = ("triggers", "imu")
"""Options that write what a recording holds beside its events."""


@dataclass(frozen=True, kw_only=True)
class ConvertOptions(FileFactOptions):
    """Input, edits and output."""

    positional: ClassVar[tuple[str, ...]] = ("path", "to")
    short_flags: ClassVar[Mapping[str, str]] = {
        **FileFactOptions.short_flags,
        **{"out": "-o", "crop": "--roi", "quiet": "-q"},
    }
    outputs: ClassVar[tuple[str, ...]] = ("to", "out", "frames", *SIDE_FILES)
    input_texts: ClassVar[tuple[str, ...]] = ("video",)
    main_options: ClassVar[tuple[str, ...]] = (
        *("format", "sensor", "merge", "mask", "filter", "crop", "from_zero", "time", "split"),
        "overwrite",
    )

    path: Path = REQUIRED
    """Event file, or folder of one format, to read."""
    to: Path | None = None
    """Event file to write; its extension decides the format."""
    out: Path | None = None
    """The same by a flag, as other commands have it; give one of the two."""
    format: str | None = None
    """Format to write, where the extension does not say which (`docs/files.md` lists them)."""
    from_format: str | None = None
    """Format to read, where neither extension nor content says."""
    merge: tuple[Path, ...] = ()
    """More files of the same sensor, whose events are added in time order."""
    mask: Path | None = None
    """Leave out the pixels of a mask: .npy, .png (white is left out) or .txt (x y per line)."""
    filter: tuple[str, ...] = ()
    """Filters, in order: background-activity, refractory, hot-pixels, rate-limit; options follow a
    colon, as in refractory:period_us=500 (docs/toolbox.md)."""
    undistort: Path | None = None
    """Take out the lens: a text of nine numbers fx fy cx cy k1 k2 p1 p2 k3, Kalibr's yaml
    (chain.yaml:cam1), or DSEC's rectify_map.h5."""
    crop: str | None = None
    """Keep a region of the sensor: X,Y,WIDTH,HEIGHT in pixels."""
    resize: str | None = None
    """Put the events on a sensor of WIDTHxHEIGHT; none is added or lost."""
    rotate: int | None = None
    """Turn clockwise by 90, 180 or 270 degrees."""
    flip: str | None = None
    """Mirror: x exchanges left and right, y top and bottom, xy both."""
    from_zero: bool = False
    """Count time from the first event: for clock times, which many formats cannot hold."""
    time: str | None = None
    """Keep START,STOP in seconds, START included; either may be left out."""
    split: Path | None = None
    """Write a folder of files: one per interval between the times of a text, or per row of a table
    of label, start and stop."""
    video: str | None = None
    """Put the frames of a video, folder or AEDAT4 into the same file: --format event-utils."""
    frames: Path | None = None
    """Write the frames of the input, as a folder of images with timestamps.txt."""
    triggers: Path | None = None
    """Write the external triggers of the input, as CSV."""
    imu: Path | None = None
    """Write the IMU samples of the input, as CSV."""
    overwrite: bool = False
    """Replace the file if it exists already."""
    quiet: bool = False
    """Show no progress, and do not print what was written."""

    @property
    def target(self) -> Path:
        """The file to write.

        Raises:
            ConfigError: it is named twice, or not at all.
        """
        if (self.to is None) == (self.out is None):
            raise ConfigError(
                "name the file to write once: texvent convert IN OUT, or texvent convert IN -o OUT"
            )
        return Path(self.to or self.out or "")


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": ConvertOptions()}, prog="texvent convert", description=DESCRIPTION
    )
    out = options.target
    # Nothing is written until all options are accepted.
    events = edit(_open_inputs(options), options)
    side = _side_data(options)
    frames = None if options.frames is None else _open_frames(options.path)
    files = [*side] if options.split is not None else [out, *side]  # a split folder checks itself
    check_outputs(files, overwrite=options.overwrite)
    if options.frames is not None:
        from texvent.view.video_writer import check_image_output

        check_image_output(options.frames, overwrite=options.overwrite)
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        count = _write(events.reporting_to(progress), out, options)
    for path, blocks in side.items():
        _write_table(path, blocks, overwrite=options.overwrite)
    if frames is not None and options.frames is not None:
        from texvent.view.video_writer import write_images

        write_images(frames, options.frames, overwrite=options.overwrite)
    _warn_of_left_out(options)
    if not count:
        warn(f"{out} holds no event: there is none in the input, or in the part asked for")
    if not options.quiet:
        write_out(f"{out}: {count:,} events, {events.size}\n")
    return 0


def _write(events: EventPackets, out: Path, options: ConvertOptions) -> int:
    """Write the events as one file, with frames, or as a folder of files; returns their number."""
    format, overwrite = options.format, options.overwrite
    if options.split is not None:
        return write_split(
            events, read_intervals(options.split), out, format=format or "npz", overwrite=overwrite
        )
    if options.video is not None:
        if format != WITH_FRAMES:
            raise ConfigError(f"video is for --format {WITH_FRAMES}; leave it out")
        from texvent.io.hdf5.event_utils import save_with_frames
        from texvent.view.drawing.event_image import frame_image

        frames = _open_frames(options.video, size=events.size)
        images = ((frame.t_us, frame_image(frame)) for frame in frames)
        save_with_frames(out, events, images, overwrite=overwrite)
        return sum(map(len, events))
    writer = open_writer(
        out, size=events.size, metadata=events.metadata, format=format, overwrite=overwrite
    )
    count = 0
    with writer:
        for packet in events:
            writer.append(packet)
            count += len(packet)
    return count


def _open_frames(source: Path | str, size: SensorSize | None = None) -> FrameStream:
    """Frames of a source; imported here, as reading images costs more start-up than events."""
    from texvent.capture.open import open_frames

    return open_frames(source, CaptureConfig(), size=size)


def _side_data(options: ConvertOptions) -> dict[Path, Iterator[Columns]]:
    """Path → columns of what is asked for beside the events.

    Raises:
        InputError: the input holds none.
    """
    asked = {name: path for name in SIDE_FILES if (path := getattr(options, name)) is not None}
    held = side_data(options.path, options.from_format) if asked else {}
    for name in asked:
        if name not in held:
            raise InputError(f"{options.path} holds no {name}; leave out --{name}")
    return {path: held[name]() for name, path in asked.items()}


def _warn_of_left_out(options: ConvertOptions) -> None:
    """Warn of what the inputs hold beside their events, which no event file keeps."""
    asked = {name for name in (*SIDE_FILES, "frames") if getattr(options, name) is not None}
    asked |= {"frames"} if options.video is not None else set()
    writable = {*SIDE_FILES, "frames"}
    for path in (options.path, *options.merge):
        held: list[str] = []
        with contextlib.suppress(FileFormatError):  # damage of the events is said before
            held += codec_that_reads(path, options.from_format).beside(path)
        if path is not options.path:  # of files that are merged nothing else is written
            asked, writable = set(), set()
        left = [one for one in dict.fromkeys(held) if one not in asked]
        flags = [f"--{one}" for one in left if one in writable]
        if left:
            writes = f"; {', '.join(flags)} PATH writes them" if flags else ""
            warn(f"{path} also holds {few(left)}, which the event file does not keep{writes}")


def _write_table(path: Path, blocks: Iterator[Columns], *, overwrite: bool) -> None:
    with (
        atomic_file(path, overwrite=overwrite) as part,
        part.open("w", encoding="utf-8", newline="") as file,
    ):
        table, is_begun = csv.writer(file), False
        for block in blocks:
            if not is_begun:
                table.writerow(["t_us" if name == "t" else name for name in block])
            is_begun = True
            table.writerows(zip(*(column.tolist() for column in block.values()), strict=True))


def edit(given: EventPackets, options: ConvertOptions) -> EventPackets:
    """The recording after all edits that were asked for; they are noted in it."""
    events = given
    if options.mask is not None:
        mask = read_pixel_mask(options.mask, events.size)
        events = filter_events(events, MaskFilter(mask))
    for chosen in [make_part(FILTERS, text) for text in options.filter]:
        events = filter_events(events, chosen)
    if options.undistort is not None:
        events = undistort(events, read_calibration(options.undistort))
    if options.crop is not None:
        events = crop(events, parse_region(options.crop))
    if options.resize is not None:
        events = resize(events, parse_sensor(options.resize))
    if options.rotate is not None:
        events = rotate(events, options.rotate)
    if options.flip is not None:
        events = flip(events, cast(Axes, options.flip))
    if options.from_zero:
        events = start_at_zero(events)
    events = keep_time_range(events, options.time)
    edits = _edits(options)
    return note_edit(events, given, **edits) if edits else events


def parse_region(text: str) -> Region:
    """`X,Y,WIDTH,HEIGHT` as a region.

    Raises:
        ConfigError: it is not four whole numbers.
    """
    words = text.split(",")
    if len(words) != 4 or not all(word.strip().isdecimal() for word in words):
        raise ConfigError(
            f"crop is {shown(text)}; give X,Y,WIDTH,HEIGHT in pixels, such as 100,50,128,128"
        )
    return Region(*(int(word) for word in words))


def _open_inputs(options: ConvertOptions) -> EventPackets:
    first = options.open_file(options.path, options.from_format)
    if not options.merge:
        return first
    _refuse_same_files([options.path, *options.merge])
    more = [options.open_file(path, options.from_format) for path in options.merge]
    return merge([first, *more])


def _refuse_same_files(paths: Sequence[Path]) -> None:
    """Refuse a file that is merged with itself, which would double every event.

    Files are compared by identity, so that links and other spellings of a name count.

    Raises:
        ConfigError: two paths are one file.
    """
    seen: dict[tuple[int, int], Path] = {}
    for path in paths:
        status = usable_path(path).stat()
        other = seen.setdefault((status.st_dev, status.st_ino), path)
        if other is not path:
            raise ConfigError(
                f"--merge: {path} and {other} are the same file, whose events would be doubled; "
                "name each file once"
            )


def _edits(options: ConvertOptions) -> dict[str, Any]:
    """The edits that were asked for, as they are noted in the file."""
    asked: dict[str, Any] = {
        "merge": [path.name for path in options.merge],
        "mask": options.mask.name if options.mask else None,
        "filter": list(options.filter),
        "undistort": options.undistort.name if options.undistort else None,
        "crop": options.crop,
        "resize": options.resize,
        "rotate": options.rotate,
        "flip": options.flip,
        "from_zero": options.from_zero,
        "time": options.time,
    }
    return {name: value for name, value in asked.items() if value}
