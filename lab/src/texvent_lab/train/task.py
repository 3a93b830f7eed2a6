"""What a task brings to the training loop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Protocol, runtime_checkable

from texvent.networks.weight_files import Tensor
from texvent_lab.train.batches import Batches
from texvent_lab.train.schedule import Schedule


class TaskConfig(Protocol):
    """What a training file may say for a task: a frozen dataclass, its tables dataclasses too."""

    @property
    def seed(self) -> int:
        """Of the initial weights, the order of samples and their augmentation."""
        ...

    @property
    def schedule(self) -> Schedule:
        """How long and how it is trained."""
        ...

    def make_task(self) -> Task:
        """The task; this imports torch, and opens the validation samples.

        Raises:
            InputError, ConfigError, FileFormatError: it cannot be trained; the message says why.
        """
        ...


@dataclass(frozen=True)
class Score:
    """The score by which the best epoch is chosen."""

    name: str
    """In what `Task.validate` gives."""
    is_higher_better: bool


class Task(Protocol):
    """A network, its samples, its loss and its scores.

    `validate` and `loss` are given the network on its device and move what they need there.
    """

    score: ClassVar[Score]

    def make_network(self) -> Any:
        """The network, a torch module, with initial weights that depend on the seed alone."""
        ...

    def batches(self, *, workers: int) -> Batches:
        """The training samples, which are opened here.

        Raises:
            InputError, ConfigError, FileFormatError: they do not fit; the message says why.
        """
        ...

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """Of a batch, a scalar; it depends on its arguments alone."""
        ...

    def validate(self, network: Any, device: Any, *, workers: int) -> dict[str, float]:
        """Scores on the validation samples by name."""
        ...

    def published(self, network: Any) -> Mapping[str, Any]:
        """The trained network as a checkpoint in its published layout."""
        ...

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """Take over the weights of a checkpoint, `published` here or elsewhere.

        Raises:
            FileFormatError: they do not fit the network or the samples.
        """
        ...


@runtime_checkable
class PredictingTask(Task, Protocol):
    """A task that says what it predicts for each validation sample."""

    def predict(self, network: Any, device: Any, *, workers: int) -> dict[str, list[Any]]:
        """Columns by name, a value per validation sample."""
        ...

    def scores(self, predictions: Mapping[str, Sequence[Any]]) -> dict[str, float]:
        """What `validate` gives, from these columns."""
        ...
