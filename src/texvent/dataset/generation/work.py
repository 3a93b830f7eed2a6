"""Work of a maker: complete results, tasks that make the others, and the loop over them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from texvent.runtime.progress import NO_PROGRESS, Progress
from texvent.runtime.work.engines import Engine, Outcome


@dataclass
class Work:
    """Results that are complete or to be made, and failures.

    Beside what an engine asks of a task, each has `units`, which stand for the results that it
    makes, and `after`, a result that must be complete before, or None; `run` returns a record of
    each result.
    """

    complete: dict[Any, Any] = field(default_factory=dict)
    """Complete results, each with a summary of its record."""
    todo: list[Any] = field(default_factory=list)
    """Tasks, in order."""
    failures: dict[Any, str] = field(default_factory=dict)
    """Results that could not be made."""
    summary: Callable[[Any], Any] = lambda record: None
    """Part of a record that `complete` keeps."""

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
        to_make = {unit for task in self.todo for unit in task.units}
        waiting = defaultdict[Any, list[Any]](list)
        for task in self.todo:
            waiting[task.after if task.after in to_make else None].append(task)
        ready = waiting.pop(None, [])
        total, running = len(self.complete) + len(to_make), 0
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
            for unit, record in zip(units, outcome.result or (), strict=outcome.failure is None):
                self.complete[unit] = self.summary(record)
                ready += waiting.pop(unit, ())
            yield outcome
