"""Make the samples of a batch, one after the other or in several processes."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from texvent.batch.processes import interruptible, processes
from texvent.batch.samples import Sample
from texvent.errors import (
    ConfigError,
    FileFormatError,
    InputError,
    MissingDependencyError,
    OutputError,
    TexventError,
    warnings_to,
)
from texvent.io.files import open_events
from texvent.run.files import RunFiles, write_run
from texvent.run.prepare import is_strict, prepare_prompt, prepare_source, report_prompt
from texvent.runtime.progress import NoProgress, Progress
from texvent.scenes.report import PromptReport
from texvent.settings.resolution import Settings
from texvent.video import Frame

BATCH_KEY = "batch_key"
"""Name, in the metadata of event files, of the key of their sample."""
ENDING_ALL = (ConfigError, OutputError, MissingDependencyError)
"""Errors that every further sample would meet too."""


@dataclass(frozen=True)
class BatchPlan:
    """Settings that all samples share."""

    settings: Settings
    folder: Path
    extension: str
    """Of event files, with the dot."""
    files: RunFiles
    """Formats and previews; its event files are those of no sample."""

    def files_of(self, sample: Sample) -> RunFiles:
        """The files of a sample."""
        return replace(self.files, events=self.folder / f"{sample.name}{self.extension}")

    def settings_of(self, sample: Sample) -> Settings:
        """The options of a sample: those of the batch, with its seed."""
        return replace(self.settings, run=replace(self.settings.run, seed=sample.seed))


@dataclass(frozen=True)
class Outcome:
    """Result of a sample."""

    sample: Sample
    events: int = 0
    failure: str | None = None
    """Why there are no files; None: they are complete."""
    warnings: tuple[str, ...] = ()
    """What is hardly meant, such as words that are not understood."""
    report: PromptReport | None = None
    """What became of the prompt's words, where the generator says so."""


def run_batch(
    plan: BatchPlan, samples: Sequence[Sample], *, replaceable: set[str], jobs: int
) -> Iterator[Outcome]:
    """Make samples; an outcome for each, as they end.

    Args:
        plan: what is the same for all.
        samples: those to make.
        replaceable: keys of samples whose files may be replaced, if there are any.
        jobs: how many processes; 1: this one.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
        TexventError: a process died.
    """
    if jobs == 1:
        for sample in samples:
            yield make_sample(plan, sample, sample.key in replaceable)
        return
    with processes(jobs) as pool:
        waiting = iter(samples)
        running: set[Future[Outcome]] = set()
        while True:
            # A few more than there are processes: a list of any length stays short here.
            for sample in itertools.islice(waiting, 2 * jobs - len(running)):
                is_replaceable = sample.key in replaceable
                running.add(pool.submit(_make_in_process, plan, sample, is_replaceable))
            if not running:
                return
            done, running = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                try:
                    yield future.result()
                except BrokenProcessPool as error:
                    raise TexventError(
                        "a process of the batch died, perhaps for want of memory; what is done is "
                        "kept: run the command again, with fewer --jobs"
                    ) from error


def find_refused(plan: BatchPlan, samples: Sequence[Sample]) -> Iterator[Outcome]:
    """Prompts that `strict` refuses, before any sample is made."""
    if not is_strict(plan.settings):
        return
    for sample in samples:
        try:
            report_prompt(sample.subject, plan.settings_of(sample))
        except ENDING_ALL:
            raise
        except InputError as error:
            yield Outcome(sample, failure=str(error))


def check_scenes(plan: BatchPlan, samples: Sequence[Sample]) -> None:
    """Check the words of all scenes, before any sample is made.

    Raises:
        ConfigError, InputError: a scene cannot be shown; the message names its file.
    """
    for sample in samples:
        if sample.scene is not None:
            try:
                report_prompt(sample.scene, plan.settings, is_staged=False)
            except (ConfigError, InputError) as error:
                raise type(error)(f"{sample.where}: {error}") from error


def make_sample(
    plan: BatchPlan, sample: Sample, is_replaceable: bool, progress: Progress | None = None
) -> Outcome:
    """Make the files of a sample.

    Raises:
        ConfigError, OutputError, MissingDependencyError: what all samples would meet.
    """
    files = plan.files_of(sample)
    overwrite = plan.files.overwrite or is_replaceable or _is_own(files.events, sample)
    settings, events = plan.settings_of(sample), 0
    found: list[str] = []
    report: PromptReport | None = None

    def count(frame: Frame, packet: Any) -> None:
        nonlocal events
        events += len(packet)

    try:
        with warnings_to(found.append):
            if sample.video is not None:
                simulation = prepare_source(sample.video, settings, prompt=sample.prompt)
            else:
                simulation = prepare_prompt(sample.subject, settings, progress=progress)
            report = PromptReport.of_metadata(simulation.video.metadata)
            facts = {**simulation.provenance, BATCH_KEY: sample.key}
            files = replace(files, overwrite=overwrite)
            write_run(simulation, files, metadata=facts, on_step=count)
    except ENDING_ALL:
        raise
    except TexventError as error:
        # One prompt that a guardrail refuses, or one damaged video, must not end the others.
        return Outcome(sample, failure=" ".join(str(error).split()))
    return Outcome(sample, events, warnings=tuple(found), report=report)


def _is_own(path: Path, sample: Sample) -> bool:
    """True if an event file is what a batch that was killed made of the same sample."""
    if not path.exists():
        return False
    try:
        return open_events(path).metadata.get(BATCH_KEY) == sample.key
    except (InputError, FileFormatError, ConfigError):
        return False


def _make_in_process(plan: BatchPlan, sample: Sample, is_replaceable: bool) -> Outcome:
    with interruptible():
        return make_sample(plan, sample, is_replaceable, NoProgress())
