"""`texvent batch SOURCES`: events for many prompts or videos, each in files of its own."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent._registry import DEFAULT_GENERATOR
from texvent.cli.command import resolve_command
from texvent.cli.notices import say, say_warning, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.outputs import OutputOptions
from texvent.cli.run import estimate_run, print_settings
from texvent.config import check_range
from texvent.dataset.generation.event_files import WARNINGS, BatchPlan, EventFiles
from texvent.dataset.specification.entries import Sample, are_videos, read_samples
from texvent.dataset.specification.prompts import refuse_prompts, tally_prompts
from texvent.errors import ConfigError, OutputError, TexventError
from texvent.generation.video_models.named_models import warn_low_fps
from texvent.io.files import codec_for, extension_of
from texvent.run.files import RunFiles
from texvent.run.prepare import check_run
from texvent.runtime.console_progress import ConsoleProgress
from texvent.runtime.work.engines import Work, local_engine
from texvent.settings.resolution import Settings
from texvent.truth.layout import check_generator
from texvent.view.drawing.palettes import get_palette

DESCRIPTION = """Events for many prompts, scene files or videos. A list is a .txt (one prompt or
scene file per line, # begins a comment), .csv or .jsonl (prompt, scene or video, and perhaps name
and seed). Each sample has a seed of its own, derived from --seed and its text. What is done is
noted in the folder: the same command resumes where it was stopped.

  texvent batch prompts.csv --generator wan-1.3b -o events
  texvent batch clips/ --simulator v2e --jobs 4 -o events"""


@dataclass(frozen=True, kw_only=True)
class BatchOptions:
    """Samples, and processes that make them."""

    input_texts: ClassVar[tuple[str, ...]] = ("sources", "generator")
    positional: ClassVar[tuple[str, ...]] = ("sources",)
    main_options: ClassVar[tuple[str, ...]] = (
        "jobs", "out", "generator", "duration", "fps", "sensor", "simulator", "preset", "seed",
        "device", "previews", "config", "overwrite",
    )  # fmt: skip

    sources: tuple[str, ...] = REQUIRED
    """Lists (.txt, .csv, .jsonl), scene files, videos, folders of videos, patterns such as
    'clips/*.mp4'; with --camera, images and folders of images."""
    jobs: int = 1
    """Samples made at once, each in a process of its own; they share the cores. A learned model is
    loaded once per process."""

    def __post_init__(self) -> None:
        check_range("jobs", self.jobs, 1, 256)


@dataclass(frozen=True, kw_only=True)
class PromptBatchOptions(BatchOptions):
    """Samples, and processes that make them."""

    generator: str = DEFAULT_GENERATOR
    """Text-to-video generator, as in texvent generate."""


@dataclass(frozen=True, kw_only=True)
class BatchOutputOptions(OutputOptions):
    """Output folder, formats and messages."""

    out: Path | None = None
    """Folder for the event files, previews and batch.json. Without it: a name made from the first
    source, in the current folder."""
    format: str | None = None
    """Format of the event files (docs/files.md lists them); default: HDF5 (.h5)."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0, or raises if a sample failed."""
    leading = list(itertools.takewhile(lambda word: not word.startswith("-"), arguments))
    is_of_videos = are_videos(leading)
    settings, own, output = resolve_command(
        "simulate" if is_of_videos else "generate",
        arguments,
        BatchOptions() if is_of_videos else PromptBatchOptions(),
        description=DESCRIPTION,
        prog="texvent batch",
        output=BatchOutputOptions(),
    )
    if output.print_config:
        return print_settings(settings)
    check_run(settings)
    has_camera = getattr(settings.source, "camera", None) is not None
    samples = read_samples(own.sources, seed=settings.run.seed, of_stills=has_camera)
    if (samples[0].video is not None) != is_of_videos:
        raise ConfigError("name the videos first: texvent batch VIDEOS ... [OPTIONS]")
    plan = _plan(settings, own, output)
    folder = EventFiles(plan)
    samples = tuple(folder.settled(samples))
    if output.dry_run:
        return _describe(plan, samples, folder.find_work(samples))
    if not is_of_videos:
        refuse_prompts([(sample.where, sample.subject) for sample in samples], settings)
    if isinstance(own, PromptBatchOptions):
        warn_low_fps(own.generator)
    return _make_all(plan, samples, folder, jobs=own.jobs, is_quiet=output.quiet)


def _plan(settings: Settings, own: BatchOptions, output: OutputOptions) -> BatchPlan:
    """Place and kind of the files of samples.

    Raises:
        ConfigError: an option that batches do not have, or an unknown format.
        OutputError: the folder is a file.
    """
    if output.keep_partial:
        raise ConfigError(
            "a batch has no --keep-partial: complete samples are kept, and the next run goes on"
        )
    folder = output.out or Path(Path(own.sources[0]).stem or "events")
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder} is a file; -o names the folder for the results of a batch")
    extension = extension_of(output.format) if output.format else ".h5"
    codec_for(f"events{extension}", output.format)
    if output.truth_parts and isinstance(own, PromptBatchOptions):
        check_generator(own.generator)
    files = RunFiles(
        events=folder,
        format=output.format,
        previews=output.preview_kinds,
        palette=get_palette(output.palette).name,
        truth=output.truth_parts,
        overwrite=output.overwrite,
    )
    return BatchPlan(settings, extension, files)


def _describe(plan: BatchPlan, samples: Sequence[Sample], work: Work) -> int:
    """Print the number of samples left and an estimate of the first."""
    write_out(f"{len(samples)} samples, {len(work.complete)} done already\n")
    if samples[0].video is None:
        tally = tally_prompts([sample.subject for sample in samples], plan.settings)
        if tally is not None:
            write_out(f"prompts  {tally.line(verb='understood word for word')}\n")
    if work.todo:
        first = work.todo[0].sample
        write_out(f"the first, {first.name}:\n{estimate_run(plan.prepare(first))}\n")
    return 0


def _make_all(
    plan: BatchPlan, samples: Sequence[Sample], folder: EventFiles, *, jobs: int, is_quiet: bool
) -> int:
    work = folder.begin(samples)
    jobs = min(jobs, work.to_make or 1)
    try:
        with (
            ConsoleProgress(is_quiet=is_quiet) as progress,
            closing(local_engine(jobs)) as engine,
        ):
            if work.complete:
                done = f"{len(work.complete)} of {len(samples)} samples"
                progress.announce(f"kept     {done}, done before")
            for outcome in work.make(engine, progress, "samples"):
                sample = outcome.task.sample
                if outcome.failure is not None:
                    say(f"failed   {sample.where}: {outcome.failure}")
                for made in outcome.result or ():
                    for text in made[WARNINGS]:
                        say_warning(f"{sample.where}: {text}")
                    folder.add(sample, made)
                    events = f"{made['events']:,} events"
                    progress.announce(f"made     {plan.files_of(sample).events}, {events}")
            tally = folder.end(samples)
            if tally.prompts:
                progress.announce(f"prompts  {tally.line()}")
    except KeyboardInterrupt:
        done = f"{len(work.complete)} of {len(samples)} samples"
        say(f"kept     {done}; the same command goes on")
        raise
    if work.failures:
        raise TexventError(
            f"{len(work.failures)} of {len(samples)} samples failed; the others are in "
            f"{plan.folder}"
        )
    return 0
