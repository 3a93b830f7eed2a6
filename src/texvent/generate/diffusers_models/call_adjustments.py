"""What a pipeline needs changed for one call, and has back after it.

=================  ===============================================================================
progress bar       every diffusers pipeline reports its steps to one; a few have no other way
guidance           pipelines with a guider keep its scale there instead of in an argument
noise levels       few-step models have levels of their own; some pipelines take none as arguments
noise of a step    schedules that add noise in every step take the seed's generator only so
=================  ===============================================================================
"""

from __future__ import annotations

import contextlib
import functools
import inspect
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from texvent.runtime.progress import Progress

GUIDER = "guider"
SIGMAS = "sigmas"


class StepReporter:
    """Stands in for the progress bar of a pipeline, and hands its steps on.

    Args:
        progress: receives every denoising step; its exception stops the run.
        iterable: what the pipeline goes through, if it hands that to its bar.
        total: number of steps.
    """

    def __init__(
        self, progress: Progress, iterable: Iterable[Any] | None = None, total: int | None = None
    ) -> None:
        self._progress = progress
        self._items = iterable
        self._total = len(list(iterable)) if total is None and iterable is not None else total
        self._done = 0

    def __enter__(self) -> StepReporter:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def __iter__(self) -> Iterator[Any]:
        for item in self._items or ():
            yield item
            self.update()

    def update(self, steps: int = 1) -> None:
        """Count steps that are done."""
        self._done += steps
        self._progress.advance("denoise", self._done, self._total or self._done)

    def close(self) -> None:
        """Nothing is left open."""


@contextlib.contextmanager
def adjusted(
    pipe: Any,
    accepted: Mapping[str, Any],
    progress: Progress,
    *,
    guidance: float | None,
    sigmas: tuple[float, ...] | None,
    generator: Any,
) -> Iterator[None]:
    """Inside, a call of `pipe` reports its steps and uses what its arguments cannot say.

    Args:
        pipe: a diffusers pipeline.
        accepted: names of its call's arguments.
        progress: receives every denoising step.
        guidance: scale for its guider, where it has one; None leaves it.
        sigmas: noise levels, where the call takes none; None leaves its own.
        generator: source of the noise that the schedule adds, where the pipeline gives it none;
            None leaves it.
    """
    with contextlib.ExitStack() as stack:
        _replace(stack, pipe, "progress_bar", functools.partial(StepReporter, progress))
        if guidance is not None and getattr(pipe, GUIDER, None) is not None:
            stack.callback(setattr, pipe, GUIDER, pipe.guider)
            pipe.guider = pipe.guider.new(guidance_scale=guidance)
        if sigmas is not None and SIGMAS not in accepted:
            scheduler = pipe.scheduler
            timed = functools.partial(scheduler.set_timesteps, sigmas=list(sigmas))
            _replace(stack, scheduler, "set_timesteps", timed)
        if generator is not None:
            seeded = functools.partial(pipe.scheduler.step, generator=generator)
            _replace(stack, pipe.scheduler, "step", seeded)
        yield


def has_guider(pipeline_class: type) -> bool:
    """Whether guidance is a part of the pipeline, not an argument of its call."""
    return GUIDER in inspect.signature(pipeline_class).parameters


def _replace(stack: contextlib.ExitStack, owner: Any, name: str, value: Any) -> None:
    setattr(owner, name, value)
    stack.callback(delattr, owner, name)
