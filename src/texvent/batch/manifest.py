"""Manifest of a batch in its folder: options in `batch.json`, samples in `samples.jsonl`.

`batch.json` holds the resolved options; a later run with others is refused. `samples.jsonl` gets a
line when all files of a sample are complete, with their sizes.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from texvent.batch.identity import digest
from texvent.batch.samples import ID_DIGITS, Sample
from texvent.errors import ConfigError, FileFormatError, one_line
from texvent.io.atomic import atomic_file
from texvent.runtime.file_names import inside
from texvent.scenes.report import PromptReport
from texvent.settings.provenance import describe_state, is_replaced

OPTIONS_FILE, SAMPLES_FILE = "batch.json", "samples.jsonl"
VERSION = "texvent_version"
"""Name, in `batch.json`, of the version that made the samples."""
MOST_DIFFERENCES, MAX_VALUE = 3, 40
"""Differences that an error names, and characters of a value."""


class Manifest:
    """The state of a batch folder.

    Raises:
        FileFormatError: its files are damaged.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._options = _read_options(folder / OPTIONS_FILE)
        self._done = {row["key"]: row for row in _read_rows(folder / SAMPLES_FILE)}

    def begin(self, options: Mapping[str, Any], *, overwrite: bool) -> None:
        """Note what is asked for; with `overwrite` nothing counts as done.

        Raises:
            ConfigError: the folder was made with other options.
        """
        wanted = json.loads(json.dumps(options))
        if self._options is not None and not overwrite:
            differences = describe_differences(self._options, wanted, name_of=_flag)
            if differences:
                raise ConfigError(
                    f"{self._folder} was made with other options: {differences}; name another "
                    "folder with -o, or replace all with --overwrite"
                )
        if self._options != wanted:
            with atomic_file(self._folder / OPTIONS_FILE, overwrite=True) as part:
                part.write_text(json.dumps(wanted, indent=1) + "\n", encoding="utf-8")
        if overwrite:
            self._done = {}
        # Written anew: a line that was cut off by a power failure goes.
        with atomic_file(self._folder / SAMPLES_FILE, overwrite=True) as part:
            text = "".join(f"{json.dumps(row)}\n" for row in self._done.values())
            part.write_text(text, encoding="utf-8")

    def is_done(self, sample: Sample) -> bool:
        """True if all its files are there, as large as they were, and its video is the same."""
        row = self._done.get(sample.key)
        if row is None or self._is_other_video(sample):
            return False
        return all(_size(self._folder / name) == size for name, size in row["files"].items())

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
        other = self._done.get(sample.key, {}).get("video") != str(sample.video)
        return other and self._is_other_video(sample)

    def _is_other_video(self, sample: Sample) -> bool:
        state = self._done.get(sample.key, {}).get("video_state")
        return sample.video is not None and is_replaced(sample.video, state)

    def is_known(self, sample: Sample) -> bool:
        """True if the sample was complete once, so that what is left of it may be replaced."""
        return sample.key in self._done

    def report_of(self, sample: Sample) -> PromptReport | None:
        """The report of a complete sample's prompt; None where it has none."""
        report = self._done.get(sample.key, {}).get("prompt_report")
        return None if report is None else PromptReport.from_json(report)

    def add(
        self,
        sample: Sample,
        paths: Sequence[Path],
        *,
        events: int,
        report: PromptReport | None = None,
        video_state: Mapping[str, str] | None = None,
    ) -> None:
        """Note that a sample is complete; durable before it returns.

        Args:
            sample: which.
            paths: its files and folders.
            events: their number.
            report: of its prompt.
            video_state: as `describe_state` gives it.
        """
        row = {
            "key": sample.key,
            "name": sample.name,
            "seed": sample.seed,
            "prompt": sample.prompt,
            "video": None if sample.video is None else str(sample.video),
            "video_state": video_state,
            "events": events,
            "files": {path.name: _size(path) for path in paths},
            "prompt_report": None if report is None else report.to_json(),
        }
        self._done[sample.key] = row
        with (self._folder / SAMPLES_FILE).open("a", encoding="utf-8") as file:
            file.write(f"{json.dumps(row)}\n")
            file.flush()
            os.fsync(file.fileno())


def _read_options(path: Path) -> Any:
    if not path.is_file():
        return None
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise FileFormatError(
            f"{path} is damaged ({one_line(error)}); name another folder with -o"
        ) from error


def _read_rows(path: Path) -> Iterator[dict[str, Any]]:
    """Complete lines; a last one that was cut off by a power failure is not complete."""
    lines = path.read_bytes().split(b"\n") if path.is_file() else []
    for number, line in enumerate(lines[:-1], start=1):
        try:
            row = json.loads(line)
            files = {
                str(inside(path.parent, name).name): size for name, size in row["files"].items()
            }
            yield {**row, "key": str(row["key"]), "name": row["name"], "files": files}
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
            if number < len(lines) - 1:
                raise FileFormatError(
                    f"{path} line {number} is damaged; name another folder with -o"
                ) from None


def _flag(name: str) -> str:
    """An option as it is given: `texvent_version` is none."""
    return "the version of texvent" if name == VERSION else f"--{name.replace('_', '-')}"


def describe_differences(old: Any, new: Any, *, name_of: Callable[[str], str] = str) -> str:
    """Differences between two trees of options, at most three; empty if they are equal.

    `name_of` gives an option's name from that in the tree.
    """
    found = list(_differences(old, new, name_of))
    more = len(found) - MOST_DIFFERENCES
    return "; ".join(found[:MOST_DIFFERENCES]) + (f" and {more} more" if more > 0 else "")


def _differences(
    old: Any, new: Any, name_of: Callable[[str], str], name: str = ""
) -> Iterator[str]:
    """Differences between two trees of options, as `name was this, is that`, leaf by leaf."""
    if isinstance(old, Mapping) or isinstance(new, Mapping):
        before, now = (one if isinstance(one, Mapping) else {} for one in (old, new))
        for key in dict.fromkeys((*before, *now)):
            yield from _differences(before.get(key), now.get(key), name_of, str(key))
    elif old != new:
        yield f"{name_of(name)[:40]} was {_value(old)}, is {_value(new)}"


def _value(value: Any) -> str:
    if value is None:
        return "not set"
    text = ", ".join(map(str, value)) if isinstance(value, list) else str(value)
    return text if len(text) <= MAX_VALUE else f"{text[: MAX_VALUE - 3]}..."


def _size(path: Path) -> int | None:
    """Bytes of a file, or of all files of a folder format; None if there is none."""
    if path.is_dir():
        return sum(one.stat().st_size for one in path.rglob("*") if one.is_file())
    return path.stat().st_size if path.is_file() else None
