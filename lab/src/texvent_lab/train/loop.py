"""The training loop: epochs of a task, scored, stored, and continued after any interruption.

Everything random depends on (seed, epoch, place), and the state is stored after every epoch. A
training that was killed therefore ends with the weights of one that was not.
"""

from __future__ import annotations

import copy
import json
import time
import zipfile
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import ConfigError, FileFormatError, OutputError, TexventError, one_line
from texvent.extending import full_version, require
from texvent.io.atomic import atomic_file
from texvent.networks import DAMAGE, NOTES, TRAINING, Tensor
from texvent.run.ledger import describe_differences
from texvent.runtime.progress import Progress
from texvent_lab.train.schedule import EXTRA, Hardware, Schedule
from texvent_lab.train.task import Batches, TrainingTask

CHECKPOINT_FILE, WEIGHTS_FILE = "checkpoint.pt", "weights.pt"


@dataclass(kw_only=True)
class TrainingState:
    """All that the next epoch depends on, and what is kept of those before."""

    tables: Mapping[str, Any]
    """Options of the training, as plain values."""
    version: str = field(default_factory=full_version)
    """Version of texvent."""
    epochs: int = 0
    """Complete ones."""
    network: Mapping[str, Tensor] = field(default_factory=dict)
    optimizer: Mapping[str, Any] = field(default_factory=dict)
    best_epoch: int = 0
    """From 1."""
    best: Mapping[str, Tensor] = field(default_factory=dict)
    """The network after that epoch."""
    reduced_at: int = 0
    """Epoch after which the learning rate was reduced last."""
    rows: list[dict[str, float]] = field(default_factory=list)
    """Scores of all epochs."""


def write_state(folder: Path, state: TrainingState) -> None:
    """Write the state of a training, flushed to disk, in place of the last one."""
    values = {one.name: getattr(state, one.name) for one in fields(state)}
    save(folder / CHECKPOINT_FILE, values)


def save(path: Path, values: Mapping[str, Any]) -> None:
    """Write tensors and plain values as torch does."""
    torch = require("torch", extra=EXTRA)
    with atomic_file(path, overwrite=True) as part:
        torch.save(dict(values), part)


def read_state(folder: Path, tables: Mapping[str, Any]) -> TrainingState | None:
    """The state of a training that was begun, or None.

    Args:
        folder: of the training.
        tables: what is to be trained now.

    Raises:
        FileFormatError: the file is damaged.
        ConfigError: another training was begun there, or by another version of texvent.
    """
    torch = require("torch", extra=EXTRA)
    path = folder / CHECKPOINT_FILE
    if not path.exists():
        return None
    try:
        with zipfile.ZipFile(path) as archive:
            if archive.testzip() is not None:  # torch does not look
                raise zipfile.BadZipFile
        values = torch.load(path, map_location="cpu", weights_only=True)
        state = TrainingState(**values)
    except DAMAGE as error:
        raise FileFormatError(f"{path} is damaged; delete it to begin again") from error
    if state.version != full_version():
        raise ConfigError(
            f"{folder} was begun by texvent {state.version}, and this is {full_version()}; install "
            "that version, or name another folder with -o"
        )
    changed = describe_differences(state.tables, tables)
    if changed:
        raise ConfigError(
            f"{folder} holds another training: {changed}; name another folder with -o, or delete it"
        )
    return state


HISTORY_FILE, CURVES_FILE = "history.json", "curves.png"
Row = Mapping[str, float]
"""Name → value of one epoch; "epoch" counts from 1."""
HIDDEN = ("epoch", "seconds")
"""Columns without a curve of their own."""
LOSSES = "loss"
"""End of the names of losses, which share a plot."""
MOST_COLUMNS, WIDTH_INCHES, HEIGHT_INCHES = 3, 4.5, 3.4
COLOURS = ("#1f77b4", "#d95f02", "#2ca02c", "#7b3294")
STANDARD_ERROR = " standard error"
"""End of the names of standard errors; they are drawn around what they belong to."""
VALIDATION_SAMPLES = "validation samples"
"""End of the names of what was counted, which has no curve."""


def write_history(folder: Path, facts: Mapping[str, Any], rows: Sequence[Row]) -> None:
    """Write both files, over those of the epoch before.

    Args:
        folder: of the training.
        facts: what else the JSON says: how it was trained, and which epoch is the best.
        rows: of all epochs so far.

    Raises:
        MissingDependencyError: matplotlib is not installed.
    """
    text = json.dumps({**facts, "epochs": [*rows]}, indent=1)
    with atomic_file(folder / HISTORY_FILE, overwrite=True) as part:
        part.write_text(text + "\n", encoding="utf-8")
    figure = draw_curves(rows, best=facts.get("best_epoch"))
    with atomic_file(folder / CURVES_FILE, overwrite=True) as part:
        figure.savefig(part, format="png", dpi=120)


def draw_curves(rows: Sequence[Row], *, best: int | None = None) -> Any:
    """A matplotlib figure: all losses in one plot, then a plot per score.

    Args:
        rows: of all epochs so far, at least one.
        best: the epoch to mark.
    """
    figure_module = require("matplotlib.figure", extra=EXTRA)
    plots: dict[str, list[str]] = {}
    for name in rows[0]:
        if name not in HIDDEN and not name.endswith((STANDARD_ERROR, VALIDATION_SAMPLES)):
            plots.setdefault(LOSSES if name.endswith(LOSSES) else name, []).append(name)
    columns = min(len(plots), MOST_COLUMNS)
    lines = -(-len(plots) // columns)
    size = (WIDTH_INCHES * columns, HEIGHT_INCHES * lines)
    figure = figure_module.Figure(figsize=size, layout="constrained", facecolor="white")
    places = figure.subplots(lines, columns, squeeze=False).ravel()
    for axes, (title, names) in zip(places, plots.items(), strict=False):
        _draw_plot(axes, rows, names, best)
        axes.set_title(title)
    for axes in places[len(plots) :]:
        axes.remove()
    return figure


def _draw_plot(axes: Any, rows: Sequence[Row], names: Sequence[str], best: int | None) -> None:
    """Scores over epochs, with their standard errors if they are known."""
    epochs = [row["epoch"] for row in rows]
    if best is not None:
        axes.axvline(best, color="0.6", linestyle="--", linewidth=1, label=f"best epoch {best}")
    for name, colour in zip(names, COLOURS, strict=False):
        values = np.array([row[name] for row in rows])
        axes.plot(epochs, values, color=colour, marker=".", label=name)
        if name + STANDARD_ERROR in rows[0]:
            error = np.array([row[name + STANDARD_ERROR] for row in rows])
            axes.fill_between(
                epochs, values - error, values + error, color=colour, alpha=0.2, linewidth=0,
                label="± standard error",
            )  # fmt: skip
    axes.set_facecolor("white")
    axes.set_xlabel("epoch")
    axes.set_xlim(0.5, max(epochs[-1], 2) + 0.5)
    axes.xaxis.get_major_locator().set_params(integer=True)
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    axes.legend(fontsize="small", framealpha=0.8)


LOSS = "training loss"


def train(
    task: TrainingTask,
    schedule: Schedule,
    folder: Path,
    *,
    tables: Mapping[str, Any],
    hardware: Hardware,
    progress: Progress,
) -> TrainingState:
    """Train a task, or go on where a training of it stopped.

    The folder gets `checkpoint.pt` (the whole state), `weights.pt` (the network that
    `Schedule.keep` names, in its published layout), `history.json` and `curves.png` after every
    epoch.

    Args:
        task: what to train.
        schedule: how long and how.
        folder: of the training; made if it is missing.
        tables: what is trained and how, as plain values; another training is not continued.
        hardware: what trains.
        progress: told of batches, and of the scores of epochs.

    Returns:
        The state after the last epoch.

    Raises:
        InputError, ConfigError, FileFormatError: the training samples do not fit, or another
            training was begun in the folder.
        OutputError: the folder cannot be made.
        TexventError: the loss is no longer a number.
    """
    torch = require("torch", extra=EXTRA)
    device = hardware.find_device()
    batches = task.batches(workers=hardware.workers)
    _make_folder(folder)
    tables = {**tables, "samples": batches.make.identity, "validation": task.identity}
    state = read_state(folder, tables) or TrainingState(tables=tables)
    network = task.make_network().to(device)
    optimizer = schedule.make_optimizer(network)
    if state.epochs:
        network.load_state_dict(state.network)
        optimizer.load_state_dict(state.optimizer)
        # They may be gone, or ahead of the state.
        _write_results(folder, state, task, schedule, network)
    while not _is_over(state, schedule):
        started = time.perf_counter()
        _decay(optimizer, schedule, state.epochs)
        loss = _train_epoch(
            task, batches, network, optimizer, schedule, state.epochs, hardware, progress
        )
        with torch.inference_mode(), hardware.autocast(device):
            network.eval()
            scores, _ = task.validate(network, device, workers=hardware.workers)
        row = {"epoch": state.epochs + 1, LOSS: loss, **scores}
        state.rows.append({**row, "seconds": round(time.perf_counter() - started, 3)})
        _note_epoch(state, task, schedule, network, optimizer)
        # The state is written last: killed before, the epoch is made again with all its files.
        _write_results(folder, state, task, schedule, network)
        write_state(folder, state)
        progress.announce(_row_text(row, schedule.epochs))
    return state


def _decay(optimizer: Any, schedule: Schedule, epoch: int) -> None:
    """Bring the learning rate of the epoch before to this one; `patience` reduces it besides."""
    if epoch:
        for group in optimizer.param_groups:
            group["lr"] *= schedule.factor(epoch) / schedule.factor(epoch - 1)


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make {folder}: {one_line(error)}") from error


def _train_epoch(
    task: TrainingTask,
    batches: Batches,
    network: Any,
    optimizer: Any,
    schedule: Schedule,
    epoch: int,
    hardware: Hardware,
    progress: Progress,
) -> float:
    """Mean loss of the batches of an epoch."""
    device = hardware.find_device()
    network.train()

    def losses() -> Iterator[Tensor]:
        for number, batch in enumerate(batches.epoch(epoch)):
            with hardware.autocast(device):
                loss = task.loss(network, batch, device)
            yield loss
            progress.advance(f"epoch {epoch + 1} of {schedule.epochs}", number + 1, len(batches))

    return descend(losses(), optimizer, network, where=f"epoch {epoch + 1}", schedule=schedule)


def descend(
    losses: Iterable[Tensor], optimizer: Any, network: Any, *, where: str, schedule: Schedule
) -> float:
    """One step of the optimiser for each loss; returns their mean.

    Args:
        losses: scalars; each is computed after the step for the one before.
        optimizer: of the network's parameters.
        network: what is trained.
        where: part of the training, for the message.
        schedule: whether gradients are clipped.

    Raises:
        TexventError: a loss is no number.
    """
    torch = require("torch", extra=EXTRA)
    total, number = 0.0, 0
    for number, loss in enumerate(losses, start=1):
        value = float(loss.detach())
        if not np.isfinite(value):
            raise TexventError(
                f"the loss is {value} in {where}, batch {number}; give a smaller "
                "learning_rate, or clip_gradient = 1"
            )
        optimizer.zero_grad()
        loss.backward()
        if schedule.clip_gradient is not None:
            torch.nn.utils.clip_grad_norm_(network.parameters(), schedule.clip_gradient)
        optimizer.step()
        total += value
    return total / max(number, 1)


def _note_epoch(
    state: TrainingState, task: TrainingTask, schedule: Schedule, network: Any, optimizer: Any
) -> None:
    """Keep the network and its optimiser, the best network, and reduce the learning rate."""
    state.epochs += 1
    weights = {name: one.detach().cpu().clone() for name, one in network.state_dict().items()}
    state.network = weights
    epochs = state.epochs, state.best_epoch
    now, best = (state.rows[number - 1][task.score] for number in epochs)
    if not state.best_epoch or now > best or (np.isnan(best) and not np.isnan(now)):
        state.best_epoch, state.best = state.epochs, weights
    waited = state.epochs - max(state.best_epoch, state.reduced_at)
    if schedule.patience is not None and waited > schedule.patience:
        state.reduced_at = state.epochs
        for group in optimizer.param_groups:
            group["lr"] *= schedule.reduction
    state.optimizer = optimizer.state_dict()


def _is_over(state: TrainingState, schedule: Schedule) -> bool:
    waited = state.epochs - state.best_epoch
    is_stopped = schedule.stop_after is not None and waited >= schedule.stop_after
    return is_stopped or state.epochs >= schedule.epochs


def _write_results(
    folder: Path, state: TrainingState, task: TrainingTask, schedule: Schedule, network: Any
) -> None:
    """The weights that are kept, scores and curves."""
    torch, is_last = require("torch", extra=EXTRA), schedule.keep == "last"
    facts = {
        "texvent_version": full_version(),
        "torch_version": str(torch.__version__),
        "best_epoch": state.best_epoch,
        "chosen_by": task.score,
        "kept_epoch": state.epochs if is_last else state.best_epoch,
        TRAINING: state.tables,
    }
    write_history(folder, facts, state.rows)
    kept = copy.deepcopy(network)
    kept.load_state_dict(state.network if is_last else state.best)
    save(folder / WEIGHTS_FILE, {**task.published(kept), NOTES: facts})


def _row_text(row: Row, epochs: int) -> str:
    return f"epoch {row['epoch']} of {epochs}: {score_text(row, hidden=('epoch',))}"


def score_text(row: Row, hidden: Container[str] = HIDDEN) -> str:
    """The scores of an epoch in a line: counts in full, others to four digits."""
    shown = {name: value for name, value in row.items() if name not in hidden}
    return ", ".join(
        f"{name} {value:,}" if isinstance(value, int) else f"{name} {value:.4g}"
        for name, value in shown.items()
    )
