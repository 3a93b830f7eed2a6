"""`texvent nt-imagenet`: recorded streams of N-ImageNet with captions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError, InputError, TexventError, shown
from texvent.extending import suggest
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent_lab.nt_imagenet import files
from texvent_lab.nt_imagenet.captions import CHECKS, check_captions, read_captions
from texvent_lab.nt_imagenet.files import Captioned
from texvent_lab.nt_imagenet.report import Report
from texvent_lab.nt_imagenet.selection import (
    CLASSES,
    PER_CLASS,
    Selection,
    choose_classes,
    select_streams,
    validation_folder,
)

DESCRIPTION = """The paper's NT-ImageNet from your copy of N-ImageNet and captions of ImageNet's
images: streams are chosen, their captions checked, and written as prompts.

  texvent nt-imagenet --n-imagenet N_Imagenet --captions captions.csv -o nt
  texvent dataset make nt/specification.toml -o nt-events

docs/datasets.md explains it."""


@dataclass(frozen=True, kw_only=True)
class NtImagenetOptions:
    """Which streams, and where their captions come from."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    n_imagenet: Path = REQUIRED
    """Folder of N-ImageNet (with extracted_val), or of its classes."""
    out: Path = REQUIRED
    """Folder for captions, report and specification."""
    captions: Path = REQUIRED
    """Captions: .csv or .jsonl with id (name of the image without extension) and caption."""
    classes: Path | None = None
    """Text file with one WordNet id per line; without it, the first --class-count classes."""
    class_count: int = CLASSES
    """Classes, in order of their ids; the paper does not say which."""
    per_class: int = PER_CLASS
    """Streams of each class."""
    leave_out: str | None = None
    """Leave out captions with these problems, separated by commas: length, refusal, duplicate;
    without it they are only reported."""
    quiet: bool = False
    """No progress."""

    def __post_init__(self) -> None:
        check_range("class_count", self.class_count, 1)
        check_range("per_class", self.per_class, 1)
        for name in self.leaving_out:
            if name not in CHECKS:
                raise ConfigError(f"leave_out names {shown(name)}; {suggest(name, CHECKS)}")

    @property
    def leaving_out(self) -> tuple[str, ...]:
        """Names of checks."""
        return tuple(name.strip() for name in (self.leave_out or "").split(",") if name.strip())


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0.

    Raises:
        ConfigError: the captions lie in the folder that is written.
        TexventError: some streams have no caption; all else is written.
    """
    (options,) = parse_configs(
        arguments,
        {"data set": NtImagenetOptions()},
        prog="texvent nt-imagenet",
        description=DESCRIPTION,
    )
    if options.captions.resolve().parent == options.out.resolve():
        raise ConfigError(
            f"{options.captions} lies in the folder that is written; name another folder with -o"
        )
    classes = choose_classes(options.n_imagenet, options.class_count, options.classes)
    files.prepare_folder(options.out)
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        selection = select_streams(
            options.n_imagenet,
            classes,
            per_class=options.per_class,
            progress=lambda done, total: progress.advance("reading streams", done, total),
        )
    captions, failures = _captions(options, selection)
    report = _report(options, selection, captions, failures)
    _write(options, report, validation_folder(options.n_imagenet))
    if failures:
        raise TexventError(
            f"{len(failures)} of {len(selection.streams)} streams have no caption, such as "
            f"{next(iter(failures.values()))}; all else is written, {files.REPORT} names them"
        )
    return 0


def _captions(
    options: NtImagenetOptions, selection: Selection
) -> tuple[dict[str, str], dict[str, str]]:
    """Captions by id, and why others are missing."""
    ids, path = [stream.id for stream in selection.streams], options.captions
    found = read_captions(path)
    captions = {id: found[id] for id in ids if id in found}
    if not captions:
        raise InputError(f"{path} has no caption of these streams, such as {ids[0]}")
    return captions, {id: f"{id} is not in {path}" for id in ids if id not in captions}


def _report(
    options: NtImagenetOptions,
    selection: Selection,
    captions: Mapping[str, str],
    failures: Mapping[str, str],
) -> Report:
    checks = check_captions(captions)
    left_out = [
        id for id, check in checks.items() if set(check.problems) & set(options.leaving_out)
    ]
    return Report(
        selection=selection,
        per_class=options.per_class,
        captions=captions,
        checks=checks,
        failures=failures,
        left_out=left_out,
        captions_file=str(options.captions),
    )


def _write(options: NtImagenetOptions, report: Report, root: Path) -> None:
    out, streams = options.out, report.selection.streams
    captioned = [
        Captioned.of(stream, report.captions[stream.id])
        for stream in streams
        if stream.id in report.captions and stream.id not in report.left_out
    ]
    if not captioned:
        raise InputError("every caption is left out; name fewer problems with --leave-out")
    files.write_streams(out, streams, root)
    files.write_captions(out, captioned)
    files.write_report(out, report.facts)
    is_new = files.write_specification(out)
    write_out(report.text)
    write_out(f"{out}: {len(captioned):,} captions in {files.CAPTIONS}\n")
    if not is_new:
        write_out(f"{files.SPECIFICATION} was there already and is kept\n")
