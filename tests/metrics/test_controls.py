"""The controls that a similarity score is reported with."""

import pytest

from texvent.events import EventStream
from texvent.metrics.controls import CONTROLS, run_controls
from texvent.metrics.latent_similarity import LatentSimilarity
from texvent.metrics.spike_trains import VanRossum
from texvent.metrics.stpp import Stpp
from texvent.sensor import SensorSize

from .recordings import random_events


@pytest.fixture(scope="module")
def events():
    t = range(0, 100_000, 100)
    x = [n // 10 % 12 for n in range(1000)]
    return EventStream(x, [0] * 1000, t, [n % 2 for n in range(1000)], SensorSize(12, 9))


def test_controls_are_what_their_names_say(events):
    controls = run_controls(Stpp(), events)
    assert set(controls) == set(CONTROLS)
    assert controls["identity"] == 1.0
    assert 0.5 < controls["noise 30 %"] < 1.0
    assert controls["shuffle all times"] < controls["noise 30 %"]


def test_halves_are_a_partition_of_the_events(events):
    first, second = CONTROLS["split half"](events)
    assert len(first) + len(second) == len(events)
    assert set(first.t.tolist()).isdisjoint(second.t.tolist())
    assert len(first) == pytest.approx(500, abs=60)


def test_identity_scores_best_of_all_controls_of_lfs(events):
    controls = run_controls(LatentSimilarity(), events)
    assert max(controls, key=lambda name: controls[name]) == "identity"


def test_controls_of_a_recording_are_those_of_the_release():
    """Values of two recordings can be compared, also across releases."""
    found = run_controls(VanRossum(), random_events(3, 400))
    assert {name: round(value, 6) for name, value in found.items()} == {
        "identity": 0.0,
        "split half": 0.962123,
        "shuffle all times": 0.866458,
        "shuffle all pixels": 0.9122,
        "flip 100 %": 0.954709,
        "noise 30 %": 0.123944,
    }
