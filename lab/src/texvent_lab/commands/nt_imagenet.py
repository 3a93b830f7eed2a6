"""`texvent nt-imagenet`: recorded streams of N-ImageNet with captions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError, InputError, TexventError, few, shown, warn
from texvent.extending import full_version, suggest
from texvent.metrics.compare import load_metric, plain_values, score_text
from texvent.metrics.controls import CONTROLLED, run_controls
from texvent.metrics.latent_similarity import load_eqs
from texvent.metrics.protocol import Metric
from texvent.runtime.console_progress import ConsoleProgress
from texvent_lab.alignment.pairs import OTHER, score_pairs
from texvent_lab.alignment.recordings import ids_of_clips, list_samples, list_streams
from texvent_lab.bench.document import markdown_table
from texvent_lab.bench.uncertainty import Mean
from texvent_lab.nt_imagenet import files
from texvent_lab.nt_imagenet.captions import CHECKS, check_captions, read_captions
from texvent_lab.nt_imagenet.files import Captioned
from texvent_lab.nt_imagenet.images import find_images, make_captions, mean_levels
from texvent_lab.nt_imagenet.report import Report
from texvent_lab.nt_imagenet.selection import (
    CLASSES,
    PER_CLASS,
    STREAM_EXTENSION,
    Selection,
    choose_classes,
    select_streams,
    validation_folder,
)

DESCRIPTION = """The paper's NT-ImageNet from your copies of N-ImageNet and ImageNet: streams are
chosen, their captions made by LLaVA or read, checked, and written as prompts; then simulated events
are scored beside the recorded ones.

  texvent nt-imagenet --n-imagenet N_Imagenet --imagenet val -o nt \\
      --model hub:llava-hf/llava-1.5-13b-hf
  texvent dataset make nt/specification.toml -o nt-events
  texvent nt-imagenet --n-imagenet N_Imagenet -o nt --events nt-events \\
      --rvt-weights rvt-t.ckpt

docs/datasets.md explains it."""


@dataclass(frozen=True, kw_only=True)
class NtImagenetOptions:
    """Streams, and the source of their captions."""

    input_texts: ClassVar[tuple[str, ...]] = ("model",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}
    main_options: ClassVar[tuple[str, ...]] = (
        *("n_imagenet", "imagenet", "model", "captions", "out", "events", "rvt_weights"),
    )

    n_imagenet: Path = REQUIRED
    """Folder of N-ImageNet (with extracted_val), or of its classes."""
    out: Path = REQUIRED
    """Folder for captions, report and specification."""
    captions: Path | None = None
    """Captions: .csv or .jsonl with id (name of the image without extension) and caption."""
    imagenet: Path | None = None
    """Folder of ImageNet's validation images, for --model and for the report's light."""
    model: str | None = None
    """LLaVA, or another model that makes the captions that are missing: folder saved by
    transformers, or hub:org/name."""
    device: str = "auto"
    """Device of the model: auto, cpu, cuda, cuda:1."""
    events: Path | None = None
    """Data set made from the captions in --out: score its samples beside the recorded streams."""
    rvt_weights: Path | None = None
    """With --events: weights for EQS, as texvent compare takes them."""
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

    def check(self) -> None:
        """Refuse options that lack others, and captions in the folder that is written.

        Raises:
            ConfigError: see above.
        """
        if self.events and (self.captions or self.model):
            raise ConfigError("events are scored by the captions in --out; name no others")
        if self.rvt_weights and not self.events:
            raise ConfigError("rvt_weights score events; name the data set with --events")
        if not (self.events or self.captions or self.model):
            raise ConfigError("no captions; give --captions, or --imagenet and --model")
        if self.model and not self.imagenet:
            raise ConfigError("the model describes images; give their folder with --imagenet")
        if self.captions and self.captions.resolve().parent == self.out.resolve():
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
        ConfigError: options lack each other, or captions lie in the folder that is written.
        TexventError: some streams have no caption; all else is written.
    """
    (options,) = parse_configs(
        arguments,
        {"data set": NtImagenetOptions()},
        prog="texvent nt-imagenet",
        description=DESCRIPTION,
    )
    options.check()
    if options.events is not None:
        return _score(options, options.events)
    root = validation_folder(options.n_imagenet)
    given = {} if options.captions is None else read_captions(options.captions)
    strange = sorted(set(given) - {one.stem for one in root.glob(f"*/*{STREAM_EXTENSION}")})
    if strange:
        warn(f"{options.captions} has captions of no stream in {root}: {few(strange)}")
    classes = choose_classes(options.n_imagenet, options.class_count, options.classes)
    files.prepare_folder(options.out)
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        selection = select_streams(
            options.n_imagenet,
            classes,
            per_class=options.per_class,
            progress=lambda done, total: progress.advance("reading streams", done, total),
        )
        ids, folder = [stream.id for stream in selection.streams], options.imagenet
        images = {} if folder is None else find_images(folder, ids)
        captions, failures = _captions(options, ids, given, images, progress)
    report = _report(options, selection, captions, failures, mean_levels(images))
    _write(options, report, root)
    if failures:
        raise TexventError(
            f"{len(failures)} of {len(selection.streams)} streams have no caption, such as "
            f"{next(iter(failures.values()))}; all else is written, {files.REPORT} names them"
        )
    return 0


def _captions(
    options: NtImagenetOptions,
    ids: Sequence[str],
    given: Mapping[str, str],
    images: Mapping[str, Path],
    progress: ConsoleProgress,
) -> tuple[dict[str, str], dict[str, str]]:
    """Captions by id, and why others are missing."""
    failures = {id: f"{id} is not in {options.captions}" for id in ids if id not in given}
    found = dict(given)
    if options.model is not None:
        made, failures = make_captions(
            {id: images[id] for id in failures},
            options.model,
            options.out / files.MADE,
            device=options.device,
            progress=progress.advance,
        )
        found |= made
    if len(failures) == len(ids):
        raise InputError(f"no stream has a caption: {failures[ids[0]]}")
    return {id: found[id] for id in ids if id in found}, failures


def _report(
    options: NtImagenetOptions,
    selection: Selection,
    captions: Mapping[str, str],
    failures: Mapping[str, str],
    levels: Sequence[float],
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
        levels=levels,
        captions_file=None if options.captions is None else str(options.captions),
        captions_model=options.model,
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
    files.write_facts(out / files.REPORT, report.facts)
    is_new = files.write_specification(out)
    write_out(report.text)
    write_out(f"{out}: {len(captioned):,} captions in {files.CAPTIONS}\n")
    if not is_new:
        write_out(f"{files.SPECIFICATION} was there already and is kept\n")


def _score(options: NtImagenetOptions, events: Path) -> int:
    """Score a data set of the captions beside the recorded streams, id by id."""
    out = options.out
    captioned = files.read_captioned(out / files.CAPTIONS)
    metrics = [load_metric("stpp")]
    if options.rvt_weights is not None:
        metrics.append(load_eqs(options.rvt_weights))
    samples = list_samples(events, ids=ids_of_clips(events, captioned))
    streams = list_streams(options.n_imagenet, captioned)
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        rows = score_pairs(samples, streams, metrics, progress.advance)
    recorded = streams[0]
    controls = {
        one.name: run_controls(one, recorded.load()) for one in metrics if one.name in CONTROLLED
    }
    facts = {"texvent_version": full_version(), "pairs": rows, "controls": controls}
    files.write_facts(out / files.PAIRS, plain_values(facts))
    write_out(pairs_table(rows, metrics))
    for name, found in controls.items():
        values = ", ".join(f"{control} {score_text(value)}" for control, value in found.items())
        write_out(f"{name} of {recorded.id}'s own events: {values}\n")
    write_out(f"{out}: {len(rows):,} pairs in {files.PAIRS}\n")
    return 0


def pairs_table(rows: Sequence[Mapping[str, Any]], metrics: Sequence[Metric]) -> str:
    """Markdown: a row per variant, means over its pairs with 95 % intervals."""
    columns = [f"{one.name}{kind}" for one in metrics for kind in ("", OTHER)]
    body = []
    for variant in dict.fromkeys(row["variant"] for row in rows):
        own = [row for row in rows if row["variant"] == variant]
        means = [
            Mean.of([row.get(c, np.nan) for row in own], is_in_sequence=False) for c in columns
        ]
        ends = (f"{m.mean:.4f} [{m.interval.low:.4f}, {m.interval.high:.4f}]" for m in means)
        body.append([variant, str(len(own)), *ends])
    return markdown_table(["variant", "pairs", *columns], body)
