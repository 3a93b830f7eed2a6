"""`texvent nt-imagenet`: recorded streams of N-ImageNet with captions."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError, InputError, TexventError, shown
from texvent.extending import suggest
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent_lab.nt_imagenet import files
from texvent_lab.nt_imagenet.captioner import INSTRUCTION, Captioner
from texvent_lab.nt_imagenet.captions import (
    CHECKS,
    FILE,
    CaptionStore,
    check_captions,
    read_captions,
)
from texvent_lab.nt_imagenet.files import Captioned, find_image
from texvent_lab.nt_imagenet.report import Report
from texvent_lab.nt_imagenet.selection import (
    CLASSES,
    PER_CLASS,
    Selection,
    choose_classes,
    select_streams,
    validation_folder,
)

DESCRIPTION = """The paper's NT-ImageNet from your copies of N-ImageNet and ImageNet: streams are
chosen, captions of their images made by LLaVA-1.5 or taken from a file, checked, and written as
prompts.

  texvent nt-imagenet --n-imagenet N_Imagenet --imagenet ImageNet \\
      --model hub:llava-hf/llava-1.5-13b-hf -o nt
  texvent dataset make nt/specification.toml -o nt-events

The same command goes on where it was stopped. docs/datasets.md explains it."""


@dataclass(frozen=True, kw_only=True)
class NtImagenetOptions:
    """Which streams, and where their captions come from."""

    input_texts: ClassVar[tuple[str, ...]] = ("model",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    n_imagenet: Path = REQUIRED
    """Folder of N-ImageNet (with extracted_val), or of its classes."""
    imagenet: Path | None = None
    """Folder of ImageNet's validation images, all in one folder or by class; needed for --model."""
    out: Path = REQUIRED
    """Folder for captions, report and specification."""
    model: str | None = None
    """LLaVA that makes captions: folder saved by transformers, or hub:org/name."""
    captions: Path | None = None
    """Captions made elsewhere: .csv or .jsonl with id (name of the image without extension) and
    caption."""
    classes: Path | None = None
    """Text file with one WordNet id per line; without it, the first --class-count classes."""
    class_count: int = CLASSES
    """Classes, in order of their ids; the paper does not say which."""
    per_class: int = PER_CLASS
    """Streams of each class."""
    leave_out: str | None = None
    """Leave out captions with these problems, separated by commas: length, refusal, duplicate;
    without it they are only reported."""
    longest: int = 200
    """Most tokens of a caption."""
    device: str = "auto"
    """Where models run: auto, cpu, cuda, cuda:1."""
    quiet: bool = False
    """No progress."""

    def __post_init__(self) -> None:
        check_range("class_count", self.class_count, 1)
        check_range("per_class", self.per_class, 1)
        check_range("longest", self.longest, 1, 4096)
        for name in self.leaving_out:
            if name not in CHECKS:
                raise ConfigError(f"leave_out names {shown(name)}; {suggest(name, CHECKS)}")

    def check_sources(self) -> None:
        """Refuse to begin without what is needed.

        Raises:
            ConfigError: captions or images are not named, or captions twice.
        """
        if (self.model is None) == (self.captions is None):
            raise ConfigError("give captions by --model, or a file of them by --captions")
        if self.model is not None and self.imagenet is None:
            raise ConfigError("the model describes images; give their folder with --imagenet")
        if self.captions is not None and self.captions.resolve().parent == self.out.resolve():
            raise ConfigError(
                f"{self.captions} lies in the folder that is written; name another folder with -o"
            )

    @property
    def leaving_out(self) -> tuple[str, ...]:
        """Names of checks."""
        return tuple(name.strip() for name in (self.leave_out or "").split(",") if name.strip())


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0.

    Raises:
        TexventError: some streams have no caption; all else is written.
    """
    (options,) = parse_configs(
        arguments,
        {"data set": NtImagenetOptions()},
        prog="texvent nt-imagenet",
        description=DESCRIPTION,
    )
    options.check_sources()
    classes = choose_classes(options.n_imagenet, options.class_count, options.classes)
    files.prepare_folder(options.out)
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        selection = select_streams(
            options.n_imagenet,
            classes,
            per_class=options.per_class,
            progress=lambda done, total: progress.advance("reading streams", done, total),
        )
        captions, failures, made_by = _captions(options, selection, progress)
    report = _report(options, selection, captions, failures, made_by)
    _write(options, report, validation_folder(options.n_imagenet))
    if failures:
        raise TexventError(
            f"{len(failures)} of {len(selection.streams)} streams have no caption, such as "
            f"{next(iter(failures.values()))}; all else is written, {files.REPORT} names them"
        )
    return 0


def _captions(
    options: NtImagenetOptions, selection: Selection, progress: ConsoleProgress
) -> tuple[dict[str, str], dict[str, str], dict[str, Any]]:
    """Captions by id, why others are missing, and what made them."""
    ids, path = [stream.id for stream in selection.streams], options.captions
    if path is None:
        return _make_captions(options, selection, progress)
    found = read_captions(path)
    captions = {id: found[id] for id in ids if id in found}
    if not captions:
        raise InputError(f"{path} has no caption of these streams, such as {ids[0]}")
    failures = {id: f"{id} is not in {path}" for id in ids if id not in captions}
    return captions, failures, {"file": str(path)}


def _make_captions(
    options: NtImagenetOptions, selection: Selection, progress: ConsoleProgress
) -> tuple[dict[str, str], dict[str, str], dict[str, Any]]:
    model, folder = str(options.model), options.imagenet or Path()
    wnids = {stream.id: stream.wnid for stream in selection.streams}
    place = {id: number for number, id in enumerate(wnids)}
    facts = {"model": model, "instruction": INSTRUCTION, "longest": options.longest}

    @functools.cache
    def captioner() -> Captioner:
        return Captioner(model, device=options.device)

    def make(id: str) -> str:
        progress.advance("captions", place[id], len(place))
        image = find_image(folder, wnids[id], id)
        if image is None:
            raise InputError(f"{folder} has no image {id}")
        return captioner().caption(image, longest=options.longest)

    if not any(find_image(folder, wnid, id) for id, wnid in wnids.items()):
        raise InputError(
            f"{folder} has none of the images, such as {next(iter(wnids))}.JPEG; give the folder "
            "of ImageNet's validation images"
        )
    made, failures = CaptionStore(options.out / FILE, facts).fill(list(wnids), make)
    return made, failures, facts


def _report(
    options: NtImagenetOptions,
    selection: Selection,
    captions: Mapping[str, str],
    failures: Mapping[str, str],
    made_by: Mapping[str, Any],
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
        made_by=made_by,
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
