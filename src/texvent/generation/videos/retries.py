"""Failure filter: check a generated video, then warn, refuse or try another seed (paper 9.6)."""

from __future__ import annotations

import hashlib
from collections.abc import Callable

from texvent.errors import TexventError
from texvent.generation.video_models.config import GeneratedVideoConfig
from texvent.generation.videos.stored_video import FinishedVideo
from texvent.runtime.progress import NoProgress, Progress
from texvent.video_check.checks import check_video

RETRIES = 3
"""Further seeds with --on-failure retry."""


def generate_checked(
    make: Callable[[int, Progress], FinishedVideo],
    config: GeneratedVideoConfig,
    *,
    seed: int,
    progress: Progress | None,
    find_fault: Callable[[FinishedVideo], str | None] = lambda video: None,
) -> FinishedVideo:
    """A video that passes the failure filter, or the response of `on_failure`.

    `find_fault` names a fault that the filter does not know.

    Returns:
        The video, with the filter's findings in its metadata.

    Raises:
        TexventError: the video failed and `on_failure` is "reject", or every seed failed.
    """
    progress = progress or NoProgress()
    if config.on_failure == "ignore":
        return make(seed, progress)
    tries = RETRIES + 1 if config.on_failure == "retry" else 1
    for attempt in range(tries):
        attempt_seed = nth_seed(seed, attempt)
        video = make(attempt_seed, progress)
        report, fault = check_video(video), find_fault(video)
        faults = "; ".join(filter(None, ("" if report.is_fine else report.summary, fault)))
        if not faults or config.on_failure == "warn":
            if faults:
                progress.announce(f"warning: the generated video looks failed: {faults}")
            return video.with_metadata(check=report.as_facts())
        progress.announce(f"seed {attempt_seed} is refused: {faults}")
    raise TexventError(_refusal(faults, tries))


def nth_seed(seed: int, attempt: int) -> int:
    """The seed of an attempt: the given one first, then digests of it, below 2^31.

    Example:
        >>> nth_seed(7, 0)
        7
        >>> nth_seed(7, 1) == nth_seed(7, 1) != nth_seed(8, 1)
        True
    """
    if attempt == 0:
        return seed
    digest = hashlib.sha256(f"{seed} {attempt}".encode()).digest()
    return int.from_bytes(digest[:4], "big") >> 1


def _refusal(faults: str, tries: int) -> str:
    seeds = "the video" if tries == 1 else f"all {tries} videos, each of another seed,"
    return (
        f"{seeds} failed the check of generated videos: {faults}. Reword the prompt, try "
        "another `seed`, or accept it with on_failure='warn'"
    )
