"""The training loop: epochs of a task, scored, stored, and continued after any interruption.

Everything random depends on (seed, epoch, place), and the state is stored after every epoch. A
training that was killed therefore ends with the weights of one that was not.
"""

from __future__ import annotations

import copy
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import OutputError, TexventError, one_line
from texvent.extending import full_version, require
from texvent.networks.weight_files import NOTES, TRAINING
from texvent.runtime.progress import Progress
from texvent_lab.train.batches import Batches
from texvent_lab.train.checkpoint import WEIGHTS_FILE, TrainingState, read_state, save, write_state
from texvent_lab.train.history import write_history
from texvent_lab.train.schedule import EXTRA, Hardware, Schedule
from texvent_lab.train.task import Task

LOSS = "training loss"


def train(
    task: Task,
    schedule: Schedule,
    folder: Path,
    *,
    tables: Mapping[str, Any],
    hardware: Hardware,
    progress: Progress,
) -> TrainingState:
    """Train a task, or go on where a training of it stopped.

    The folder gets `checkpoint.pt` (the whole state), `weights.pt` (the best network, in its
    published layout), `history.json` and `curves.png` after every epoch.

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
    tables = {**tables, "samples": batches.make.identity}
    state = read_state(folder, tables) or TrainingState(tables=tables)
    network = task.make_network().to(device)
    optimizer = schedule.make_optimizer(network)
    _take_up(state, network, optimizer)
    computed = torch.compile(network) if hardware.compile else network
    while not _is_over(state, schedule):
        started = time.perf_counter()
        loss = _train_epoch(
            task, batches, computed, optimizer, schedule, state.epochs, hardware, progress
        )
        with torch.inference_mode(), hardware.autocast(device):
            network.eval()
            scores = task.validate(computed, device, workers=hardware.workers)
        row = {"epoch": state.epochs + 1, LOSS: loss, **scores}
        state.rows.append({**row, "seconds": round(time.perf_counter() - started, 3)})
        _note_epoch(state, task, schedule, network, optimizer)
        # The state is written last: killed before, the epoch is made again with all its files.
        _write_results(folder, state, task, network)
        write_state(folder, state)
        progress.announce(_row_text(row, schedule.epochs))
    return state


def _take_up(state: TrainingState, network: Any, optimizer: Any) -> None:
    """Give network and optimizer what they were when the state was stored, if it was."""
    if state.epochs:
        network.load_state_dict(state.network)
        optimizer.load_state_dict(state.optimizer)


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make {folder}: {one_line(error)}") from error


def _train_epoch(
    task: Task,
    batches: Batches,
    network: Any,
    optimizer: Any,
    schedule: Schedule,
    epoch: int,
    hardware: Hardware,
    progress: Progress,
) -> float:
    """Mean loss of the batches of an epoch."""
    torch = require("torch", extra=EXTRA)
    device = hardware.find_device()
    network.train()
    total = 0.0
    for number, batch in enumerate(batches.epoch(epoch)):
        with hardware.autocast(device):
            loss = task.loss(network, batch, device)
        value = float(loss.detach())
        if not np.isfinite(value):
            raise TexventError(
                f"the loss is {value} in epoch {epoch + 1}, batch {number + 1}; give a smaller "
                "learning_rate, or clip_gradient = 1"
            )
        optimizer.zero_grad()
        loss.backward()
        if schedule.clip_gradient is not None:
            torch.nn.utils.clip_grad_norm_(network.parameters(), schedule.clip_gradient)
        optimizer.step()
        total += value
        progress.advance(f"epoch {epoch + 1} of {schedule.epochs}", number + 1, len(batches))
    return total / len(batches)


def _note_epoch(
    state: TrainingState, task: Task, schedule: Schedule, network: Any, optimizer: Any
) -> None:
    """Keep the network and its optimiser, the best network, and reduce the learning rate."""
    state.epochs += 1
    weights = {name: one.detach().cpu().clone() for name, one in network.state_dict().items()}
    state.network = weights
    name, sign = task.score.name, 1 if task.score.is_higher_better else -1
    now, best = (sign * state.rows[number - 1][name] for number in (state.epochs, state.best_epoch))
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


def _write_results(folder: Path, state: TrainingState, task: Task, network: Any) -> None:
    """The best weights, scores and curves."""
    torch = require("torch", extra=EXTRA)
    facts = {
        "texvent_version": full_version(),
        "torch_version": str(torch.__version__),
        "best_epoch": state.best_epoch,
        "chosen_by": task.score.name,
        TRAINING: state.tables,
    }
    write_history(folder, facts, state.rows)
    best = copy.deepcopy(network)
    best.load_state_dict(state.best)
    save(folder / WEIGHTS_FILE, {**task.published(best), NOTES: facts})


def _row_text(row: Mapping[str, float], epochs: int) -> str:
    scores = ", ".join(f"{name} {value:.4g}" for name, value in row.items() if name != "epoch")
    return f"epoch {row['epoch']} of {epochs}: {scores}"
