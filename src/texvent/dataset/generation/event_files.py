"""One sample of a batch made: its event file, previews and truth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from texvent.dataset.generation.manifest import files_of
from texvent.dataset.specification.entries import Sample
from texvent.errors import warnings_to
from texvent.run.files import RunFiles, write_run
from texvent.run.prepare import prepare_prompt, prepare_source
from texvent.scenes.report import PromptReport
from texvent.settings.provenance import describe_state
from texvent.settings.resolution import Settings
from texvent.video import Frame


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
class MadeSample:
    """Result of a sample whose files are complete."""

    events: int
    warnings: tuple[str, ...]
    """Doubts, such as words that are not understood."""
    report: PromptReport | None
    """Report on the words of its prompt; None where the generator gives none."""
    inputs: tuple[Mapping[str, str] | None, ...] = ()
    """States of the files that it was made of, when they were read."""


@dataclass(frozen=True, eq=False)
class SampleTask:
    """A sample to make, for an engine."""

    plan: BatchPlan
    sample: Sample
    is_video = False

    def run(self) -> MadeSample:
        """Make the files.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all samples would meet.
            TexventError: this one cannot be made.
        """
        plan, sample = self.plan, self.sample
        settings, files = plan.settings_of(sample), plan.files_of(sample)
        events = 0
        found: list[str] = []

        def count(frame: Frame, packet: Any) -> None:
            nonlocal events
            events += len(packet)

        inputs = tuple(map(describe_state, files_of(sample, settings)))
        with warnings_to(found.append):
            if sample.video is not None:
                simulation = prepare_source(sample.video, settings, prompt=sample.prompt)
            else:
                simulation = prepare_prompt(sample.subject, settings)
            write_run(
                simulation,
                replace(files, overwrite=True),  # the manifest knows them as its own
                on_step=count,
            )
        report = PromptReport.of_metadata(simulation.video.metadata)
        return MadeSample(events, tuple(found), report, inputs)
