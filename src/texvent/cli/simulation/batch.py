"""`texvent batch SOURCES`: events for many prompts or videos, each in files of its own."""

from __future__ import annotations

import glob
import itertools
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from texvent._registry import GENERATORS
from texvent._version import full_version
from texvent.cli.command import resolve_command
from texvent.cli.dry_run import estimate_run
from texvent.cli.notices import say, say_warning, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.outputs import OutputOptions
from texvent.cli.run import print_settings
from texvent.config import check_range
from texvent.dataset.generation.event_files import BatchPlan, SampleTask
from texvent.dataset.generation.manifest import SAMPLES_FILE, Manifest
from texvent.dataset.specification.entries import Sample, are_videos, read_samples
from texvent.dataset.specification.prompts import refuse_prompts, tally_prompts
from texvent.errors import ConfigError, OutputError, TexventError
from texvent.generate.video_models.known_models import warn_low_fps
from texvent.io.files import codec_for, extension_of
from texvent.run.files import RunFiles
from texvent.run.prepare import check_run, prepare_prompt, prepare_source
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent.runtime.engines import Outcome, local_engine
from texvent.runtime.progress import Progress
from texvent.scenes.report import ReportTally
from texvent.settings.resolution import Settings
from texvent.truth.layout import check_generator

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
        "previews", "config", "overwrite",
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

    generator: str = next(iter(GENERATORS.builtin))
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
    manifest = Manifest(plan.folder, settings)
    samples = tuple(manifest.settled(samples))
    if output.dry_run:
        return _describe(plan, samples, manifest)
    if not is_of_videos:
        refuse_prompts([(sample.where, sample.subject) for sample in samples], settings)
    if isinstance(own, PromptBatchOptions):
        warn_low_fps(own.generator)
    options = _options(plan, is_of_videos)
    if not output.overwrite:
        manifest.check_options(options)
    todo = [one for one in samples if output.overwrite or not manifest.is_done(one)]
    _refuse_files_of_others(plan, [one for one in todo if not manifest.is_known(one)])
    plan.folder.mkdir(parents=True, exist_ok=True)
    manifest.begin(options, todo)
    return _make_all(plan, samples, todo, manifest, jobs=own.jobs, is_quiet=output.quiet)


def _plan(settings: Settings, own: BatchOptions, output: OutputOptions) -> BatchPlan:
    """Where and how samples are written.

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
        truth=output.truth_parts,
        overwrite=output.overwrite,
    )
    return BatchPlan(settings, folder, extension, files)


def _refuse_files_of_others(plan: BatchPlan, samples: Sequence[Sample]) -> None:
    """Refuse to replace what no batch in this folder has begun.

    Raises:
        OutputError: a file or folder of such a sample is there.
    """
    for sample in samples if not plan.files.overwrite else ():
        for path in plan.files_of(sample).outputs:
            if path.exists():
                raise OutputError(
                    f"{path} exists already, and {SAMPLES_FILE} beside it does not know it; name "
                    "another folder with -o, or replace all with --overwrite"
                )


def _options(plan: BatchPlan, is_of_videos: bool) -> Mapping[str, Any]:
    """Options that must be the same when the batch goes on."""
    truth = {"truth": list(plan.files.truth)} if plan.files.truth else {}
    return {
        **truth,
        "texvent_version": full_version(),
        "samples": "videos" if is_of_videos else "prompts",
        "settings": plan.settings.as_tables(),
        "format": plan.files.format or plan.extension,
        "previews": list(plan.files.previews),
    }


def _describe(plan: BatchPlan, samples: Sequence[Sample], manifest: Manifest) -> int:
    """Print the number of samples left and an estimate of the first."""
    todo = [sample for sample in samples if not manifest.is_done(sample)]
    write_out(f"{len(samples)} samples, {len(samples) - len(todo)} done already\n")
    if samples[0].video is None:
        tally = tally_prompts([sample.subject for sample in samples], plan.settings)
        if tally is not None:
            write_out(f"prompts  {tally.line(verb='understood word for word')}\n")
    if todo:
        first = todo[0]
        settings = plan.settings_of(first)
        if first.video is not None:
            simulation = prepare_source(first.video, settings, prompt=first.prompt)
        else:
            simulation = prepare_prompt(first.subject, settings)
        write_out(f"the first, {first.name}:\n")
        write_out(estimate_run(simulation) + "\n")
    return 0


def _make_all(
    plan: BatchPlan,
    samples: Sequence[Sample],
    todo: Sequence[Sample],
    manifest: Manifest,
    *,
    jobs: int,
    is_quiet: bool,
) -> int:
    tasks = [SampleTask(plan, sample) for sample in todo]
    done, failed = len(samples) - len(tasks), 0
    try:
        with (
            ConsoleProgress(is_quiet=is_quiet) as progress,
            closing(local_engine(min(jobs, len(tasks) or 1))) as engine,
        ):
            if done:
                progress.announce(f"kept     {done} of {len(samples)} samples, done before")
            progress.advance("samples", done, len(samples))
            for task in tasks:
                engine.submit(task)
            for _ in tasks:
                outcome = engine.next()
                if outcome.failure is None:
                    done += 1
                    _note(plan, manifest, outcome, progress)
                    progress.advance("samples", done, len(samples))
                else:
                    failed += 1
                    say(f"failed   {outcome.task.sample.where}: {outcome.failure}")
            manifest.end()
            tally = ReportTally()
            for report in filter(None, map(manifest.report_of, samples)):
                tally.add(report)
            if tally.prompts:
                progress.announce(f"prompts  {tally.line()}")
    except KeyboardInterrupt:
        say(f"kept     {done} of {len(samples)} samples; the same command goes on")
        raise
    if failed:
        raise TexventError(
            f"{failed} of {len(samples)} samples failed; the others are in {plan.folder}"
        )
    return 0


def _note(plan: BatchPlan, manifest: Manifest, outcome: Outcome, progress: Progress) -> None:
    """Note a complete sample, and say so."""
    sample, made = outcome.task.sample, outcome.result
    for text in made.warnings:
        say_warning(f"{sample.where}: {text}")
    files = plan.files_of(sample)
    beside = plan.folder.glob(f"{glob.escape(files.events.name)}.*")  # formats without metadata
    manifest.add(
        sample,
        [*files.outputs, *sorted(beside)],
        events=made.events,
        report=made.report,
        inputs=made.inputs,
    )
    progress.announce(f"made     {files.events}, {made.events:,} events")
