"""Trainings of one weight: rates, best and last networks by definition, whatever stops them."""

import dataclasses
import json
import math
from contextlib import nullcontext
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import ConfigError, TexventError
from texvent.runtime.progress import NO_PROGRESS
from texvent_lab.registries import TASKS
from texvent_lab.train.schedule import Hardware, Schedule

SAMPLES, BATCH = 7, 3
CPU = Hardware(device="cpu")


class Draws:
    """Samples that tell their number and the chance of their epoch."""

    identity = "draws"

    def __call__(self, number, chance):
        return {"number": number, "drawn": np.float32(number + chance.random())}


class StoppedError(Exception):
    """What ends a training from outside."""


class Task:
    """Weights that follow what is drawn; what happens is noted, and a place may stop it."""

    score, identity = "score", "validated"

    def __init__(self, torch, scores=None, stop=None):
        self._torch, self._scores, self._stop = torch, scores, stop
        self.optimizer, self.rates, self.weights, self.drawn = None, [], [], []

    def _reach(self, *place):
        if place == self._stop:
            raise StoppedError

    def make_network(self):
        network = self._torch.nn.Module()
        network.weight = self._torch.nn.Parameter(self._torch.tensor([0.5, 1.0]))
        return network

    def batches(self, *, workers):
        from texvent_lab.train.task import Batches

        return Batches(Draws(), SAMPLES, BATCH, seed=1, workers=workers)

    def loss(self, network, batch, device):
        assert network.training
        self._reach("loss", len(self.drawn) // 3)
        self.drawn.append(batch["drawn"].tolist())
        if self.optimizer is not None:
            self.rates.append(self.optimizer.param_groups[0]["lr"])
        return ((network.weight - batch["drawn"].mean()) ** 2).sum()

    def validate(self, network, device, *, workers):
        assert not network.training
        self._reach("score", len(self.weights))
        self.weights.append(network.weight.detach().numpy().copy())
        score = self._scores[len(self.weights) - 1] if self._scores else None
        return {"score": math.sin(1e4 * self.weights[-1][0]) if score is None else score}, {}

    def published(self, network):
        return {"state_dict": {"weight": network.weight.detach()}}


@pytest.fixture(scope="module")
def train(torch, tmp_path_factory):
    """A training in a folder, whose curves are not drawn."""
    from texvent_lab.train import loop

    def run(task, schedule, folder=None, progress=NO_PROGRESS):
        folder = folder or tmp_path_factory.mktemp("training")
        make = Schedule.make_optimizer

        def noted(own, network):
            task.optimizer = make(own, network)
            return task.optimizer

        with pytest.MonkeyPatch.context() as patch:
            blank = SimpleNamespace(savefig=lambda path, **_: path.write_bytes(b""))
            patch.setattr(loop, "draw_curves", lambda *_, **__: blank)
            patch.setattr(Schedule, "make_optimizer", noted)
            tables = {"epochs": schedule.epochs}
            state = loop.train(
                task, schedule, folder, tables=tables, hardware=CPU, progress=progress
            )
        weights = torch.load(folder / "weights.pt", weights_only=True)["state_dict"]["weight"]
        told = json.loads((folder / "history.json").read_text())
        return state, weights.numpy(), told

    return run


def by_definition(schedule, scores):
    """Rates of the epochs, then that of the next; the best epoch."""
    rate, reduced, rates, known = schedule.learning_rate, 0, [], []
    for epoch, score in enumerate(scores, 1):
        rates.append(rate * schedule.factor(epoch - 1))
        known.append(-math.inf if math.isnan(score) else score)
        best = known.index(max(known)) + 1
        if schedule.patience and epoch - max(best, reduced) > schedule.patience:
            rate, reduced = rate * schedule.reduction, epoch
        if schedule.stop_after and epoch - best >= schedule.stop_after:
            break
    return [*rates, rate * schedule.factor(epoch - 1)], best


@pytest.mark.parametrize(("keep", "decay"), [("best", "cosine"), ("last", "none")])
@given(
    scores=st.lists(st.sampled_from([0.1, 0.2, 0.3, math.nan]), min_size=3, max_size=9),
    patience=st.sampled_from([None, 1, 2]),
    stop_after=st.sampled_from([None, 2, 4]),
)
@examples(0.4)
def test_rates_and_kept_networks_follow_the_scores(
    torch, train, scores, patience, stop_after, keep, decay
):
    schedule = Schedule(
        epochs=len(scores), learning_rate=1e-3, patience=patience, reduction=0.5,
        stop_after=stop_after, keep=keep, decay=decay, batch_size=BATCH,
    )  # fmt: skip
    task = Task(torch, scores)
    state, weights, told = train(task, schedule)
    rates, best = by_definition(schedule, scores)
    assert task.rates == pytest.approx(np.repeat(rates[:-1], 3))
    assert state.optimizer["param_groups"][0]["lr"] == pytest.approx(rates[-1])
    epochs = len(rates) - 1
    kept = epochs if keep == "last" else best
    assert (state.epochs, state.best_epoch, told["best_epoch"]) == (epochs, best, best)
    assert (told["kept_epoch"], told["chosen_by"]) == (kept, "score")
    assert weights.tolist() == task.weights[kept - 1].tolist()
    assert state.best["weight"].tolist() == task.weights[best - 1].tolist()
    assert state.network["weight"].tolist() == task.weights[-1].tolist()
    assert [row["epoch"] for row in told["epochs"]] == [*range(1, epochs + 1)]
    drawn = np.reshape([x for one in task.drawn for x in one], (epochs, SAMPLES))
    assert (np.sort(np.floor(drawn), axis=1) == np.arange(SAMPLES)).all()
    for epoch, row in enumerate(drawn):  # the chance of a sample in an epoch
        chances = {n: np.random.default_rng((1, 1, epoch, n)).random() for n in range(SAMPLES)}
        assert [x - math.floor(x) for x in row] == pytest.approx(
            [chances[math.floor(x)] for x in row], abs=1e-5
        )
    assert len({tuple(np.floor(row)) for row in drawn}) > len(drawn) // 2


KINDS = {
    "best": {},
    "falling": {"decay": "cosine", "weight_decay": 0.1},
    "patient": {"patience": 1, "reduction": 0.5, "keep": "last"},
    "clipped": {"clip_gradient": 0.1, "optimizer": "adamw"},
}


@pytest.mark.parametrize("stop", [("loss", 0), ("loss", 2), ("score", 1), ("told", 1), ("told", 3)])
@pytest.mark.parametrize("kind", KINDS)
def test_a_training_that_is_stopped_anywhere_ends_as_one_that_was_not(
    torch, train, kind, stop, tmp_path
):
    schedule = Schedule(epochs=4, learning_rate=1e-3, batch_size=BATCH, **KINDS[kind])
    stopped = Task(torch, stop=stop)
    progress = SimpleNamespace(
        advance=lambda *_: None, announce=lambda _: stopped._reach("told", len(stopped.weights) - 1)
    )
    with pytest.raises(StoppedError):
        train(stopped, schedule, tmp_path, progress)
    found, expected = (train(Task(torch), schedule, one) for one in (tmp_path, None))
    for state, _, told in (found, expected):
        for row in (*state.rows, *told["epochs"]):
            row.pop("seconds", None)
    assert found[0].rows == expected[0].rows
    assert str(found[0]) == str(expected[0])
    assert found[1].tolist() == expected[1].tolist()
    assert found[2] == expected[2]


@pytest.mark.parametrize("other", ["identity", "samples", "schedule", "nothing"])
def test_a_training_goes_on_with_the_same_samples_scores_and_options_alone(
    torch, train, monkeypatch, other, tmp_path
):
    schedule = Schedule(epochs=1, batch_size=BATCH)
    train(Task(torch), schedule, tmp_path)
    if other == "schedule":
        schedule = Schedule(epochs=2, batch_size=BATCH)
    elif other != "nothing":
        monkeypatch.setattr({"identity": Task, "samples": Draws}[other], "identity", "changed")
    with pytest.raises(ConfigError) if other != "nothing" else nullcontext():
        train(Task(torch), schedule, tmp_path)


PATHS = [
    (task, table, one.name)
    for task in TASKS.builtin
    for table, own in {"": TASKS.load(task)(), **vars(TASKS.load(task)())}.items()
    if dataclasses.is_dataclass(own)
    for one in dataclasses.fields(own)
    if "Path" in str(one.type)
]


@pytest.mark.parametrize(("task", "table", "name"), PATHS)
def test_paths_count_from_the_folder_of_the_training_file(torch, task, table, name, tmp_path):
    from texvent_lab.train.run import read_training

    path = tmp_path / "there" / "training.toml"
    path.parent.mkdir()
    path.write_text(f"{f'{table}.' if table else ''}{name} = 'deeper/one'\n")
    found = read_training(path, TASKS.load(task)())
    assert getattr(getattr(found, table) if table else found, name) == path.parent / "deeper/one"


@pytest.mark.parametrize("given", ['"bar"', '["bar", "slider_depth"]'])
def test_recordings_are_names_or_count_from_the_training_file(torch, tmp_path, given):
    from texvent_lab.train.run import read_training

    (tmp_path / "bar").mkdir()
    (tmp_path / "training.toml").write_text(f"data = {{recordings = {given}}}\n")
    found = read_training(tmp_path / "training.toml", TASKS.load("reconstruction")()).data
    assert found.recordings in [(str(tmp_path / "bar"), *more) for more in ((), ("slider_depth",))]


@pytest.mark.parametrize("kind", ["adam", "adamw"])
def test_options_of_the_schedule_reach_the_optimiser(torch, kind):
    options = {"weight_decay": 0.2, "amsgrad": True}
    network = Task(torch).make_network()
    made = Schedule(optimizer=kind, learning_rate=0.1, **options).make_optimizer(network)
    assert type(made).__name__.lower() == kind
    (group,) = made.param_groups
    assert group.items() >= {"lr": 0.1, **options}.items()
    assert [one is network.weight for one in group["params"]] == [True]


class Even(Task):
    """Losses of 1 with a gradient of 1; the gradient of the step before is noted."""

    gradients = ()

    def loss(self, network, batch, device):
        if network.weight.grad is not None:
            self.gradients += tuple(network.weight.grad.tolist())
        return network.weight.sum() - network.weight.detach().sum() + 1.0


@pytest.mark.parametrize(("most", "gradient"), [(None, 1), (0.5, 0.5 / 2**0.5), (2.0, 1)])
def test_a_step_follows_the_gradient_of_its_loss_alone_which_is_cut(torch, train, most, gradient):
    task = Even(torch)
    state, *_ = train(task, Schedule(epochs=2, clip_gradient=most, batch_size=BATCH))
    assert task.gradients == pytest.approx([gradient] * 10, rel=1e-4)
    assert [row["training loss"] for row in state.rows] == [1.0, 1.0]


def test_the_loss_of_an_epoch_is_the_mean_of_its_batches_all_of_them_numbers(torch, train):
    values = iter([1.0, 2.0, 6.0, 4.0, math.nan])
    task = Task(torch)
    task.loss = lambda network, *_: 0 * network.weight.sum() + next(values)
    with pytest.raises(TexventError, match=r"the loss is nan in epoch 2, batch 2; give a smaller"):
        train(task, Schedule(epochs=2, batch_size=BATCH))
    values = iter([1.0, 2.0, 6.0])
    assert train(task, Schedule(epochs=1, batch_size=BATCH))[0].rows[0]["training loss"] == 3.0
