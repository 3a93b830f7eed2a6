"""Networks of objects: those of torch, and stand-ins that need none."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.objects import run


class Networks:
    """Networks that name the class of the nearest mean image, and the box that it had.

    What they are shown and asked is noted.
    """

    def __init__(self):
        self.shown, self.asked = [], []

    def train(self, images, labels, **options):
        self.shown.append((images, labels, options))
        kinds = np.unique(labels)
        return kinds, np.stack([images[labels == kind].mean(axis=0) for kind in kinds])

    @property
    def of_windows(self):
        """Images and labels of the networks that name classes of windows."""
        return [(images, labels) for images, labels, _ in self.shown if images.ndim == 4]

    def predict(self, network, images):
        self.asked.append(images)
        kinds, means = network
        away = ((images[:, None] - means[None]) ** 2.0).reshape(len(images), len(kinds), -1)
        return kinds[away.sum(axis=2).argmin(axis=1)]

    def train_locator(self, frames, classes, **options):
        kinds, means = self.train(frames.images, frames.classes, classes=classes, **options)
        return kinds, means, [frames.boxes[frames.classes == kind].mean(axis=0) for kind in kinds]

    def locate(self, network, images, classes):
        kinds, means, boxes = network
        found = np.zeros(len(images), BOX_RECORD)
        found["t"], found["class_id"] = range(len(images)), self.predict((kinds, means), images)
        found["class_confidence"] = 0.5
        for place, side in enumerate("xywh"):
            found[side] = [boxes[list(kinds).index(kind)][place] for kind in found["class_id"]]
        return found


@pytest.fixture(params=["stand-in", pytest.param("torch", marks=pytest.mark.torch)])
def networks(request, monkeypatch):
    """Stand-ins in place of networks, then none: those of torch."""
    if request.param == "torch":
        pytest.importorskip("torch")
        return None
    found = Networks()
    monkeypatch.setattr(run, "require", lambda *_, **__: None)
    monkeypatch.setattr(run, "train_network", found.train)
    monkeypatch.setattr(run, "predict", found.predict)
    locator = SimpleNamespace(train_locator=found.train_locator, locate=found.locate)
    monkeypatch.setitem(sys.modules, "texvent_lab.bench.objects.locator", locator)
    return found
