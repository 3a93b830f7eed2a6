"""Jobs for a worker process and its answers, as lines of JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Literal, TypeAlias

from texvent.errors import InputError, one_line, shown
from texvent.web.limits import Limits


@dataclass(frozen=True, kw_only=True)
class SimulateJob:
    """Events, preview video and page of a prompt or of a video."""

    folder: str
    """Where the results go; it exists and is empty."""
    prompt: str | None = None
    """What to show; or ..."""
    video: str | None = None
    """... the path of a video file."""
    options: Mapping[str, Any] = field(default_factory=dict)
    """Options as in `texvent generate --help`, None meaning "as the preset has it"."""
    limits: Limits = field(default_factory=Limits)


@dataclass(frozen=True, kw_only=True)
class ConvertJob:
    """The events of an earlier job in another format."""

    source: str
    """Event file."""
    folder: str
    """Where the result goes."""
    format: str
    """Name of a codec."""


Job: TypeAlias = SimulateJob | ConvertJob
KINDS: dict[str, type[Job]] = {"simulate": SimulateJob, "convert": ConvertJob}


@dataclass(frozen=True, kw_only=True)
class Answer:
    """One line from a worker."""

    kind: Literal["progress", "done", "failed", "stopped"]
    share: float | None = None
    """Of a progress line: how much is done, 0..1, or None where it is unknown."""
    text: str = ""
    """What the page shows."""
    files: Mapping[str, str] = field(default_factory=dict)
    """Of a done line: name → path, such as video, page, events, download."""


def job_line(job: Job) -> str:
    """The job as one line of JSON."""
    kind = next(name for name, one in KINDS.items() if isinstance(job, one))
    return json.dumps({"kind": kind, **asdict(job)})


def read_job(line: str) -> Job:
    """The job in a line that `job_line` wrote.

    Raises:
        InputError: it is no such line.
    """
    try:
        values = json.loads(line)
        kind = KINDS[values.pop("kind")]
        if "limits" in values:
            values["limits"] = Limits(**values["limits"])
        return kind(**values)
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"not a job: {shown(line[:100])} ({one_line(error)})") from error


def answer_line(answer: Answer) -> str:
    """The answer as one line of JSON."""
    return json.dumps(asdict(answer))


def read_answer(line: str) -> Answer | None:
    """The answer in a line; None where something else was printed."""
    try:
        return Answer(**json.loads(line))
    except (ValueError, TypeError):
        return None
