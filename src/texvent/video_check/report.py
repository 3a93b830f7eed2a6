"""What the measures of a video amount to."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from texvent.video import Frame
from texvent.video_check.checks import CHECKS, Check
from texvent.video_check.measurer import VideoMeasurer, measure_video


@dataclass(frozen=True)
class Finding:
    """One check of one video."""

    check: Check
    value: str
    """What was measured, with its unit."""
    is_found: bool

    def as_facts(self) -> dict[str, Any]:
        """JSON-ready."""
        check = self.check
        return {
            "check": check.name, "is_found": self.is_found, "measured": self.value,
            "limit": check.limit, "effect": check.effect, "help": check.help,
        }  # fmt: skip


@dataclass(frozen=True)
class VideoReport:
    """What the checks found."""

    problems: tuple[str, ...]
    """Of a failed video: frozen, no motion, flicker, flash, cut, dark, saturated, noise."""
    measures: Mapping[str, float]
    remarks: tuple[str, ...] = ()
    """Of the other checks: the video is what it should be, and events suffer."""

    @property
    def is_fine(self) -> bool:
        """True if the video has not failed."""
        return not self.problems

    @property
    def summary(self) -> str:
        """The problems in one line."""
        return ", ".join(self.problems) if self.problems else "nothing found"

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Every check that was made, found or not."""
        made = [check for check in CHECKS if check.needs in self.measures]
        return tuple(
            Finding(check, check.value(self.measures), check.is_found(self.measures))
            for check in made
        )

    def as_facts(self) -> dict[str, Any]:
        """JSON-ready, for metadata."""
        rounded = {name: round(value, 4) for name, value in self.measures.items()}
        return {"problems": list(self.problems), "remarks": list(self.remarks), **rounded}


def check_video(frames: Iterable[Frame]) -> VideoReport:
    """Look through a clip once.

    Args:
        frames: a video; at least two frames, else it has no motion.
    """
    return judge_measures(measure_video(frames))


def judge_measures(measures: Mapping[str, float]) -> VideoReport:
    """The report of the numbers of `VideoMeasurer`, with or without those of motion and rate."""
    found = [check for check in CHECKS if check.needs in measures and check.is_found(measures)]
    return VideoReport(
        problems=tuple(check.name for check in found if check.is_failure),
        measures=dict(measures),
        remarks=tuple(check.name for check in found if not check.is_failure),
    )


def has_all_measures(measures: Mapping[str, float]) -> bool:
    """Whether the numbers are those that a pass takes today: those of a cache may be older."""
    return set(VideoMeasurer().measures()) <= set(measures)
