"""Training configuration: schedule, hardware, and the fields of every task."""

from __future__ import annotations

import math
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError
from texvent.extending import load_object, require
from texvent.runtime.devices import say_no_gpu
from texvent.simulation.random.draws import frame_key, frame_keys

if TYPE_CHECKING:
    from texvent_lab.train.task import TrainingTask

EXTRA = "texvent-lab[train]"
"""Extra that brings torch and matplotlib."""


@dataclass(frozen=True, kw_only=True)
class Schedule:
    """Options of a training beside the network and its data.

    Raises:
        ConfigError: a value out of range.
    """

    epochs: int = 15
    """Passes over the training samples."""
    batch_size: int = 128
    """Samples per step."""
    optimizer: Literal["adam", "adamw"] = "adam"
    """Adam, or Adam with decoupled weight decay."""
    learning_rate: float = 1e-3
    """Step size of the optimiser."""
    weight_decay: float = 0.0
    """Weight decay of the optimiser."""
    amsgrad: bool = False
    """Whether the optimiser keeps the largest second moment."""
    patience: int | None = None
    """Epochs without a better score after which the learning rate is multiplied by
    `reduction`; None: it stays."""
    reduction: float = 0.1
    """See `patience`."""
    stop_after: int | None = None
    """Epochs without a better score after which training ends; None: all epochs."""
    clip_gradient: float | None = None
    """Largest norm of the gradient; None: any."""
    decay: Literal["none", "cosine"] = "none"
    """Fall of the learning rate from epoch to epoch: half a cosine, which ends near 0."""
    keep: Literal["best", "last"] = "best"
    """Epoch whose network is kept: that of the best score, or the last."""

    def __post_init__(self) -> None:
        check_choices(self)
        check_range("epochs", self.epochs, 1, 1_000_000)
        check_range("batch_size", self.batch_size, 1, 1_000_000)
        check_range("learning_rate", self.learning_rate, 1e-12, 1e3)
        check_range("weight_decay", self.weight_decay, 0.0, 1e3)
        check_range("patience", self.patience, 1, 1_000_000)
        check_range("reduction", self.reduction, 1e-6, 1.0)
        check_range("stop_after", self.stop_after, 1, 1_000_000)
        check_range("clip_gradient", self.clip_gradient, 1e-9, 1e9)

    def factor(self, epoch: int) -> float:
        """Share of the learning rate that the decay leaves in an epoch, 0 or more."""
        return 1.0 if self.decay == "none" else 0.5 + 0.5 * math.cos(math.pi * epoch / self.epochs)

    def make_optimizer(self, network: Any) -> Any:
        """The optimiser of a network's parameters."""
        torch = require("torch", extra=EXTRA)
        kinds = {"adam": torch.optim.Adam, "adamw": torch.optim.AdamW}
        return kinds[self.optimizer](
            network.parameters(),
            lr=self.learning_rate,
            weight_decay=self.weight_decay,
            amsgrad=self.amsgrad,
        )


@dataclass(frozen=True, kw_only=True)
class Hardware:
    """Hardware of the training.

    On one kind of CPU, with as many threads, equal runs give equal weights.
    """

    device: Literal["auto", "cpu", "cuda"] = "auto"
    """auto is the GPU if torch finds one."""
    precision: Literal["float32", "bfloat16"] = "float32"
    """Number type of the network's computation; bfloat16 (mixed precision) is for GPUs, and for
    CPUs with AMX."""
    workers: int = 0
    """Processes that make batches; 0: this one."""

    def __post_init__(self) -> None:
        check_choices(self)
        check_range("workers", self.workers, 0, 1024)

    def find_device(self) -> Any:
        """The torch device.

        Raises:
            MissingDependencyError: torch is not installed.
            ConfigError: "cuda" without a GPU that torch can use.
        """
        torch = require("torch", extra=EXTRA)
        has_gpu = torch.cuda.is_available()
        if self.device == "cuda" and not has_gpu:
            raise ConfigError(f"device is cuda, and {say_no_gpu(torch)}; use cpu or auto")
        return torch.device("cuda" if has_gpu and self.device != "cpu" else "cpu")

    def autocast(self, device: Any) -> AbstractContextManager[Any]:
        """Precision that the network is computed in, a context."""
        if self.precision == "float32":
            return nullcontext()
        torch = require("torch", extra=EXTRA)
        context: AbstractContextManager[Any] = torch.autocast(device.type, torch.bfloat16)
        return context


@dataclass(frozen=True, kw_only=True)
class TrainingConfig:
    """The contents of a training file; tasks add tables, which are dataclasses too.

    Raises:
        ConfigError: a value out of range.
    """

    packages: ClassVar[str] = EXTRA
    """The extra that brings those of the task."""
    task: ClassVar[str]
    """`"module:name"` of the task: a class, or a function, that is given the config."""

    seed: int = 0
    """Seed of the initial weights, the order of samples and their augmentation."""
    schedule: Schedule = field(default_factory=Schedule)

    def __post_init__(self) -> None:
        check_range("seed", self.seed, 0, 2**63 - 1)

    def make_task(self) -> TrainingTask:
        """The task; this imports torch, and opens the validation samples.

        Raises:
            InputError, ConfigError, FileFormatError: it cannot be trained; the message says why.
        """
        task: TrainingTask = load_object(self.task)(self)
        return task


def epoch_order(count: int, *, seed: int, epoch: int) -> NDArray[np.int64]:
    """The numbers 0..count−1 once, shuffled: a function of the arguments alone.

    Args:
        count: number of samples.
        seed: 0..2⁶³−1.
        epoch: 0 or more.

    Returns:
        [count] numbers of samples; every order is as likely.
    """
    places = 1  # the purpose of the draws; another one gives other orders
    key = int(frame_key(int(frame_key(seed, epoch)) >> 1, places)) >> 1
    return np.argsort(frame_keys(key, np.arange(count)), kind="stable")
