"""Scores of validation, against their definitions; scores of trained weights are the same."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import FileFormatError
from texvent.transform.edits import resize
from texvent_lab.train.classification.config import (
    ClassData,
    ClassificationConfig,
    ClassNetwork,
)
from texvent_lab.train.schedule import Hardware, Schedule

from ..written_samples import bar

COUNTS = (3, 2, 1, 1, 1, 1, 1)


@pytest.fixture(scope="module")
def task(torch):
    from texvent_lab.train.classification import task

    return task


@pytest.fixture(scope="module")
def config(tmp_path_factory):
    """Recordings of seven classes, a few samples each; batches do not divide them."""
    folder = tmp_path_factory.mktemp("recordings")
    for label, count in enumerate(COUNTS):
        place = folder / "test" / f"class{label}"
        place.mkdir(parents=True)
        for number in range(count):
            bar(label % 2, 10 * label + number).save(place / f"{number}.npz")
    return ClassificationConfig(data=ClassData(recordings=folder), schedule=Schedule(batch_size=3))


@pytest.mark.parametrize("classes", [2, 7])
@given(seed=st.integers(0, 999))
@examples(0.2)
def test_scores_are_shares_of_samples_by_the_ranks_of_their_classes(
    torch, task, config, classes, seed
):
    labels = np.repeat(np.arange(classes), COUNTS[:classes])
    table = np.random.default_rng(seed).integers(0, 4, (len(labels), classes)).astype(np.float32)
    table[seed % len(labels)] = [math.nan, 1.0][seed % 2]
    rows = iter(table)
    network = lambda images: torch.tensor(np.stack([next(rows) for _ in images]))  # noqa: E731
    opened = task.ClassificationTask(replace(config, data=replace(config.data, classes=classes)))
    found, columns = opened.validate(network, torch.device("cpu"), workers=0)
    ranks = []
    for row, right in zip(table.tolist(), labels, strict=True):
        order = sorted(range(classes), key=lambda kind: (-row[kind], kind))  # the first of equals
        ranks.append(classes if math.isnan(row[right]) else order.index(right))
    assert columns["rank"] == ranks
    assert columns["class"] == labels.tolist()
    assert all((one == kind) == (rank == 0) for one, kind, rank in
               zip(columns["predicted"], labels, ranks, strict=True) if rank < classes)  # fmt: skip
    titles = [f"class{kind}/{n}.npz" for kind in range(classes) for n in range(COUNTS[kind])]
    assert all(map(str.endswith, columns["sample"], titles))
    assert found["validation samples"] == len(labels)
    assert ("top-5 accuracy" in found) == (classes > 5)
    for name, most in (("accuracy", 1), ("top-5 accuracy", 5)):
        if name in found:
            share = np.mean(np.array(ranks) < most)
            error = math.sqrt(share * (1 - share) / len(ranks))
            assert [found[name], found[f"{name} standard error"]] == pytest.approx([share, error])
    losses = np.log(np.exp(table).sum(axis=1)) - table[np.arange(len(labels)), labels]
    assert found["validation loss"] == pytest.approx(losses.mean(), rel=1e-5, nan_ok=True)


@pytest.mark.parametrize("events", [None, 20])
@pytest.mark.parametrize("size", [None, "8x6"])
@given(seed=st.integers(0, 99))
@examples(0.2)
def test_an_example_is_an_image_of_a_run_of_the_events_in_the_size_that_is_asked_for(
    task, config, seed, events, size
):
    data = replace(config.data, slice_events=events, image_size=size)
    network = ClassNetwork(representation="histogram-2d")
    opened = task.ClassificationTask(replace(config, data=data, network=network))
    number = seed % sum(COUNTS)
    example = opened._examples(opened._validation)(number, np.random.default_rng(seed))
    whole = opened._validation.events(number)
    if events is not None:
        first = int(np.random.default_rng(seed).integers(len(whole) - events + 1))
        whole = whole[first : first + events]
    whole = whole if size is None else resize(whole, size)
    image = np.zeros((2, *whole.size.shape))
    np.add.at(image, (whole.p, whole.y, whole.x), 1)
    assert np.array_equal(example["image"], image)
    assert example["class_number"] == opened._validation.class_number[number]


@pytest.fixture
def halves(torch, task, monkeypatch):
    """In place of the small network: one score per class from events left and right."""
    from texvent_lab.networks.layers import Network

    class Halves(Network):
        def __init__(self, channels, classes, **_):
            super().__init__()
            self.weight = torch.nn.Parameter(torch.tensor(np.eye(2, classes, dtype=np.float32)))

        def forward(self, x):
            left, right = x[..., :8].mean(dim=(1, 2, 3)), x[..., 8:].mean(dim=(1, 2, 3))
            return torch.stack([left, right], dim=1) @ self.weight

    monkeypatch.setattr(task, "NETWORKS", {"small-cnn": Halves})


@pytest.mark.usefixtures("halves")
def test_stored_weights_have_the_scores_that_they_had_and_only_of_their_classes(
    torch, task, config, tmp_path
):
    from texvent_lab.train.run import evaluate

    config = replace(config, data=replace(config.data, classes=2))
    opened = task.ClassificationTask(config)
    network = opened.make_network()
    network.weight.data[...] = torch.tensor(np.array([[2, 1], [0.5, 3]], np.float32))
    path, cpu = tmp_path / "weights.pt", Hardware(device="cpu")
    torch.save(dict(opened.published(network)), path)
    with torch.inference_mode():
        scores, columns = opened.validate(network.eval(), torch.device("cpu"), workers=0)
    found = evaluate(config, path, cpu)
    assert found.scores == {name.replace("validation ", ""): one for name, one in scores.items()}
    assert found.facts["predictions"] == columns
    assert found.facts["weights"]["file"] == "weights.pt"
    assert scores["accuracy"] == 1
    torch.save({**opened.published(network), "classes": ["cat", "dog"]}, path)
    with pytest.raises(FileFormatError, match=r"tells apart the classes \['cat', 'dog'\], and the"):
        evaluate(config, path, cpu)
    begun = task.ClassificationTask(replace(config, start_from=path))
    assert begun.make_network().weight.tolist() == [[2, 1], [0.5, 3]]
    assert begun.identity != opened.identity
