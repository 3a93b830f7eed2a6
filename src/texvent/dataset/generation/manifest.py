"""Manifest of a batch in its folder: options in `batch.json`, samples in `samples.jsonl`.

`batch.json` holds the resolved options; a later run with others is refused. `samples.jsonl` is a
`Ledger` of the samples.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from texvent.capture.image_folder import find_timestamps
from texvent.dataset.specification.entries import ID_DIGITS, Sample
from texvent.errors import ConfigError, FileFormatError, one_line
from texvent.io.atomic import atomic_file
from texvent.run.ledger import Ledger, describe_differences
from texvent.runtime.identity import digest
from texvent.scenes.report import PromptReport
from texvent.settings.provenance import describe_state, files_read, is_replaced
from texvent.settings.resolution import Settings

OPTIONS_FILE, SAMPLES_FILE = "batch.json", "samples.jsonl"
VERSION = "texvent_version"
"""Name, in `batch.json`, of the version that made the samples."""
REMEDY = "name another folder with -o"
"""What to do about a damaged file."""


class Manifest:
    """The state of a batch folder.

    Raises:
        FileFormatError: its files are damaged.
    """

    def __init__(self, folder: Path, settings: Settings) -> None:
        """Read it; `settings` are those that all samples share."""
        self._folder, self._settings = folder, settings
        self._options = _read_options(folder / OPTIONS_FILE)
        self._ledger = Ledger(folder / SAMPLES_FILE, remedy=REMEDY)

    def check_options(self, options: Mapping[str, Any]) -> None:
        """Refuse to go on with other options.

        Raises:
            ConfigError: the folder was made with others.
        """
        wanted = json.loads(json.dumps(options))
        if self._options is not None:
            differences = describe_differences(self._options, wanted, name_of=_flag)
            if differences:
                raise ConfigError(
                    f"{self._folder} was made with other options: {differences}; name another "
                    "folder with -o, or replace all with --overwrite"
                )

    def begin(self, options: Mapping[str, Any], todo: Iterable[Sample]) -> None:
        """Note the options, and samples that are to be made; durable before it returns."""
        self._ledger.begin(sample.key for sample in todo)
        with atomic_file(self._folder / OPTIONS_FILE, overwrite=True) as part:
            part.write_text(json.dumps(options, indent=1) + "\n", encoding="utf-8")

    def end(self) -> None:
        """Leave one line for each sample."""
        self._ledger.write()

    def is_done(self, sample: Sample) -> bool:
        """True if its files are there, as they were, and so is all that it was made of."""
        if self._options is None or not self._ledger.is_complete(sample.key):
            return False
        files, states = files_of(sample, self._settings), self._ledger.row(sample.key)["inputs"]
        return len(files) == len(states) and not any(map(is_replaced, files, states))

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
        return is_elsewhere and is_replaced(sample.video, row["inputs"][0])

    def is_known(self, sample: Sample) -> bool:
        """True if the sample was begun once, so that what is left of it may be replaced."""
        return sample.key in self._ledger

    def report_of(self, sample: Sample) -> PromptReport | None:
        """The report of a complete sample's prompt; None where it has none."""
        report = self._ledger.row(sample.key).get("prompt_report")
        return None if report is None else PromptReport.from_json(report)

    def add(
        self,
        sample: Sample,
        paths: Sequence[Path],
        *,
        events: int,
        inputs: Sequence[Mapping[str, str] | None] = (),
        report: PromptReport | None = None,
    ) -> None:
        """Note that a sample is complete; durable before it returns.

        Args:
            sample: which.
            paths: its files and folders.
            events: their number.
            inputs: states of `files_of` it when they were read.
            report: of its prompt.
        """
        self._ledger.add(
            sample.key,
            paths,
            name=sample.name,
            seed=sample.seed,
            prompt=sample.prompt,
            video=None if sample.video is None else str(sample.video),
            inputs=[*inputs],
            events=events,
            prompt_report=None if report is None else report.to_json(),
        )


def files_of(sample: Sample, settings: Settings) -> list[Path]:
    """The video of a sample, and every other file that its events depend on."""
    video = [] if sample.video is None else [sample.video]
    beside = (find_timestamps(one) for one in video if one.is_dir())
    named = map(Path, files_read(settings, sample.subject))
    return [*video, *filter(None, beside), *named]


def _read_options(path: Path) -> Any:
    if not path.is_file():
        return None
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)}); {REMEDY}") from error


def _flag(name: str) -> str:
    """An option as it is given: `texvent_version` is none."""
    return "the version of texvent" if name == VERSION else f"--{name.replace('_', '-')}"
