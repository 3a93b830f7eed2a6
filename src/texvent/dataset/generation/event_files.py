"""Event files of a batch: one for each prompt or video, with previews and truth beside it.

In their folder `batch.json` holds the resolved options; a later run with others is refused.
`samples.jsonl` is a `Ledger` of the samples.
"""

from __future__ import annotations

import glob
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from texvent._version import full_version
from texvent.capture.image_folder import find_timestamps
from texvent.dataset.specification.entries import ID_DIGITS, Sample
from texvent.errors import ConfigError, OutputError, warnings_to
from texvent.frames import Frame
from texvent.pipeline import Simulation
from texvent.prompt_report import REPORT_KEY, PromptReport, ReportTally
from texvent.run.files import RunFiles, write_run
from texvent.run.ledger import FILES, Ledger, describe_differences, read_note, write_note
from texvent.run.prepare import prepare_prompt, prepare_source
from texvent.runtime.identity import digest
from texvent.runtime.work.engines import Work
from texvent.settings.provenance import describe_state, files_read, is_replaced
from texvent.settings.resolution import Settings

OPTIONS_FILE, SAMPLES_FILE = "batch.json", "samples.jsonl"
VERSION = "texvent_version"
"""Name, in `batch.json`, of the version that made the samples."""
WARNINGS = "warnings"
"""Name, in what a task returns of a sample, of doubts such as words that are not understood."""
REMEDY = "name another folder with -o"
"""Advice about a damaged file."""


@dataclass(frozen=True)
class BatchPlan:
    """Settings and kinds of files that all samples share."""

    settings: Settings
    extension: str
    """Ending of event files, with the dot."""
    files: RunFiles
    """Formats and previews; in place of an event file, the folder."""

    @property
    def folder(self) -> Path:
        """Folder of all files."""
        return self.files.events

    def files_of(self, sample: Sample) -> RunFiles:
        """The files of a sample."""
        return replace(self.files, events=self.folder / f"{sample.name}{self.extension}")

    def inputs_of(self, sample: Sample) -> list[Path]:
        """The video of a sample, and every other file that its events depend on."""
        video = [] if sample.video is None else [sample.video]
        beside = (find_timestamps(one) for one in video if one.is_dir())
        named = map(Path, files_read(self.settings, sample.subject))
        return [*video, *filter(None, beside), *named]

    def prepare(self, sample: Sample) -> Simulation:
        """The run of a sample: its seed, else the options of the batch."""
        settings = replace(self.settings, run=replace(self.settings.run, seed=sample.seed))
        if sample.video is not None:
            return prepare_source(sample.video, settings, prompt=sample.prompt)
        return prepare_prompt(sample.subject, settings)

    def options(self, sample: Sample) -> dict[str, Any]:
        """Options that must be the same when the batch of a sample goes on."""
        return {
            **({"truth": list(self.files.truth)} if self.files.truth else {}),
            VERSION: full_version(),
            "samples": "prompts" if sample.video is None else "videos",
            "settings": self.settings.as_tables(),
            "format": self.files.format or self.extension,
            "previews": list(self.files.previews),
            "palette": self.files.palette,
        }


@dataclass(frozen=True, eq=False)
class SampleTask:
    """A sample to make, for an engine."""

    plan: BatchPlan
    sample: Sample
    is_video, after = False, None

    @property
    def units(self) -> tuple[str]:
        """The key of the sample."""
        return (self.sample.key,)

    def run(self) -> list[dict[str, Any]]:
        """Make the files; facts of them, with the warnings.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all samples would meet.
            TexventError: this one cannot be made.
        """
        plan, sample = self.plan, self.sample
        events, found = 0, list[str]()

        def count(frame: Frame, packet: Any) -> None:
            nonlocal events
            events += len(packet)

        inputs = [*map(describe_state, plan.inputs_of(sample))]
        files = replace(plan.files_of(sample), overwrite=True)  # the ledger knows them as its own
        with warnings_to(found.append):
            simulation = plan.prepare(sample)
            write_run(simulation, files, on_step=count)
        made = {
            "name": sample.name,
            "seed": sample.seed,
            "prompt": sample.prompt,
            "video": None if sample.video is None else str(sample.video),
            "inputs": inputs,
            "events": events,
            REPORT_KEY: simulation.video.metadata.get(REPORT_KEY),
        }
        return [{**made, WARNINGS: found}]


class EventFiles:
    """A folder of event files: what is complete there, and what is noted when more is.

    Raises:
        FileFormatError: its notes are damaged.
    """

    def __init__(self, plan: BatchPlan) -> None:
        self._plan = plan
        self._noted = read_note(plan.folder / OPTIONS_FILE, remedy=REMEDY)
        self._ledger = Ledger(plan.folder / SAMPLES_FILE, remedy=REMEDY)

    def settled(self, samples: Iterable[Sample]) -> Iterator[Sample]:
        """The samples, of which those get other keys that stand for videos of other folders."""
        taken: dict[str, Path | None] = {}
        for sample in samples:
            while self._is_taken(sample, taken.get(sample.key)):
                contents = describe_state(sample.video or "") or {}
                key = digest([sample.key, contents.get("contents")])
                made = f"-{sample.key[:ID_DIGITS]}"
                end = f"-{key[:ID_DIGITS]}" if sample.name.endswith(made) else ""
                sample = replace(sample, key=key, name=f"{sample.name.removesuffix(made)}{end}")
            taken[sample.key] = sample.video
            yield sample

    def _is_taken(self, sample: Sample, taken: Path | None) -> bool:
        """Whether the key of a video is that of another: in this list, or in what is done."""
        if sample.video is None or taken is not None:
            return taken is not None
        row = self._ledger.row(sample.key)
        is_elsewhere = row.get("video") not in (None, str(sample.video))
        return is_elsewhere and any(is_replaced(sample.video, one) for one in _inputs_of(row)[:1])

    def find_work(self, samples: Iterable[Sample]) -> Work:
        """Complete samples, by their keys, and tasks that make the others.

        With `overwrite` none is complete.
        """
        work = Work()
        for sample in samples:
            if not self._plan.files.overwrite and self._is_complete(sample):
                work.complete[sample.key] = None
            else:
                work.todo.append(SampleTask(self._plan, sample))
        return work

    def _is_complete(self, sample: Sample) -> bool:
        """True if its files are there, as they were, and so is all that it was made of."""
        if self._noted is None or not self._ledger.is_complete(sample.key):
            return False
        files, states = self._plan.inputs_of(sample), _inputs_of(self._ledger.row(sample.key))
        return len(files) == len(states) and not any(map(is_replaced, files, states))

    def begin(self, samples: Sequence[Sample]) -> Work:
        """Find what is to do, and note it; durable before it returns.

        Raises:
            ConfigError: samples of the folder were made with other options.
            OutputError: a file of a sample is there that no batch in this folder has begun.
        """
        plan = self._plan
        options = plan.options(samples[0])
        work = self.find_work(samples)
        if not plan.files.overwrite:
            self._refuse(json.loads(json.dumps(options)), work)
        plan.folder.mkdir(parents=True, exist_ok=True)
        self._ledger.begin(task.sample.key for task in work.todo)
        write_note(plan.folder / OPTIONS_FILE, options)
        return work

    def _refuse(self, options: Mapping[str, Any], work: Work) -> None:
        is_made = any(FILES in self._ledger.row(key) for key in self._ledger)
        known = self._noted if is_made and self._noted is not None else options
        differences = describe_differences(known, options, name_of=_flag)
        if differences:
            raise ConfigError(
                f"{self._plan.folder} was made with other options: {differences}; name another "
                "folder with -o, or replace all with --overwrite"
            )
        new = (task.sample for task in work.todo if task.sample.key not in self._ledger)
        for path in (path for one in new for path in self._plan.files_of(one).outputs):
            if path.exists():
                raise OutputError(
                    f"{path} exists already, and {SAMPLES_FILE} beside it does not know it; name "
                    "another folder with -o, or replace all with --overwrite"
                )

    def add(self, sample: Sample, made: Mapping[str, Any]) -> None:
        """Note that a sample is complete; durable before it returns."""
        facts = {name: one for name, one in made.items() if name != WARNINGS}
        files = self._plan.files_of(sample)
        beside = self._plan.folder.glob(f"{glob.escape(files.events.name)}.*")  # their metadata
        self._ledger.add(sample.key, [*files.outputs, *sorted(beside)], **facts)

    def end(self, samples: Iterable[Sample]) -> ReportTally:
        """Leave one line for each sample; counts of the prompts of those that are complete."""
        self._ledger.write()
        tally = ReportTally()
        for report in (self._ledger.row(sample.key).get(REPORT_KEY) for sample in samples):
            if report is not None:
                tally.add(PromptReport.from_json(report))
        return tally


def _inputs_of(row: Mapping[str, Any]) -> list[Any]:
    """States of the files that a sample was made of; none in a row of another version."""
    return [*(row.get("inputs") or ())]


def _flag(name: str) -> str:
    """An option as it is given: `texvent_version` is none."""
    return "the version of texvent" if name == VERSION else f"--{name.replace('_', '-')}"
