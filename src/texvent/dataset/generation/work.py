"""Work of a maker: complete results, tasks that make the others, and the loop over them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from texvent.runtime.engines import Engine, Outcome, Task
from texvent.runtime.progress import NO_PROGRESS, Progress


class MakerTask(Task, Protocol):
    """A task that makes results, and returns a record of each."""

    @property
    def units(self) -> Sequence[Hashable]:
        """The results that it makes, by what stands for them."""
        ...

    @property
    def after(self) -> Hashable | None:
        """A result that must be complete before; None: it needs none."""
        ...


@dataclass
class Work:
    """Results that are complete or to be made, and failures."""

    complete: dict[Any, Any] = field(default_factory=dict)
    """Complete results, each with a summary of its record."""
    todo: list[Any] = field(default_factory=list)
    """Tasks (`MakerTask`), in order."""
    failures: dict[Any, str] = field(default_factory=dict)
    """Results that could not be made."""
    summary: Callable[[Any], Any] = lambda record: None
    """What `complete` keeps of a record."""

    @property
    def to_make(self) -> int:
        """Number of results of `todo`."""
        return sum(len(task.units) for task in self.todo)

    def make(
        self, engine: Engine, progress: Progress = NO_PROGRESS, noun: str = "shards"
    ) -> Iterator[Outcome]:
        """Run all tasks; what is done is noted here.

        Args:
            engine: what runs them.
            progress: receives the number of complete results.
            noun: what they are.

        Yields:
            The outcome of every task.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all tasks would meet.
        """
        waiting = defaultdict[Hashable, list[Any]](list)
        to_make = {unit for task in self.todo for unit in task.units}
        ready = [task for task in self.todo if task.after not in to_make]
        for task in self.todo:
            if task.after in to_make:
                waiting[task.after].append(task)
        total, running = len(self.complete) + self.to_make, 0
        while True:
            progress.advance(noun, len(self.complete), total)
            for task in ready:
                engine.submit(task)
            running += len(ready)
            if not running:
                return
            outcome = engine.next()
            running -= 1
            units, ready = outcome.task.units, list[Any]()
            if outcome.failure is not None:
                self.failures.update(dict.fromkeys(units, outcome.failure))
            for unit, record in zip(units, outcome.result or (), strict=False):
                self.complete[unit] = self.summary(record)
                ready += waiting.pop(unit, ())
            yield outcome
