"""What holds for every pixel model."""

import copy
import pickle

import numpy as np
import pytest
from tests.simulation.references import in_both_forms

from texvent._registry import SIMULATORS
from texvent.errors import InputError
from texvent.frames import Frame

from .pixel_frames import moving_texture, run

MODELS = {name: SIMULATORS.load(name) for name in SIMULATORS.builtin}
EVERY_PRESET = [(name, preset) for name, model in MODELS.items() for preset in model.presets]
TWO_PRESETS = [
    (name, preset)
    for name, model in MODELS.items()
    for preset in dict.fromkeys((next(iter(model.presets)), list(model.presets)[-1]))
]
"""The first and the last of each model; kernels are compared at every one."""


@pytest.fixture(params=TWO_PRESETS, ids="-".join)
def model(request):
    name, preset = request.param
    config = MODELS[name].presets[preset]
    return lambda **options: MODELS[name](config, **options)


@pytest.mark.parametrize("model", EVERY_PRESET, indirect=True, ids="-".join)
def test_kernels_give_the_events_of_their_definitions(model):
    times_us = [0, 41_667, 83_334, 83_335, 400_000, 3_000_000]
    frames = [Frame(f.pixels, t) for f, t in zip(moving_texture(), times_us, strict=True)]
    defined, events = in_both_forms(lambda: run(model(seed=4), frames))
    assert len(events) > 20
    assert events.equals(defined)


def test_a_copied_simulator_goes_on_alike(model):
    frames = moving_texture(8)
    whole = model()
    for frame in frames[:4]:
        whole.step(frame)
    twins = copy.deepcopy(whole), pickle.loads(pickle.dumps(whole))
    expected = run(whole, frames[4:])
    assert all(run(twin, frames[4:]) == expected for twin in twins)


def test_reset_forgets_everything(model):
    simulator = model()
    first = run(simulator, moving_texture())
    simulator.reset()
    assert run(simulator, moving_texture()).equals(first)
    simulator.reset()
    assert len(simulator.step(Frame(np.zeros((3, 3), np.uint8), 0))) == 0


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (5, 1)])
def test_frames_may_have_any_size(model, shape):
    events = run(model(), moving_texture(4, shape))
    assert events.size == (shape[1], shape[0])


def test_bad_frames_fail_once_and_clearly(model):
    good = Frame(np.full((2, 2), 9.0, np.float32), 1000)
    for bad, message in (
        (Frame(np.array([[np.nan, 1], [1, 1]], np.float32), 2000), "NaN"),
        (Frame(np.array([[-1.0, 1], [1, 1]], np.float32), 2000), "negative"),
        (Frame(np.zeros((2, 3), np.float32), 2000), "3x2"),
        (Frame(np.zeros((2, 2), np.float32), 1000), "strictly increase"),
    ):
        simulator, undisturbed = model(), model()
        assert len(simulator.step(good)) == len(undisturbed.step(good)) == 0
        with pytest.raises(InputError, match=message):
            simulator.step(bad)
        later = Frame(np.full((2, 2), 99.0, np.float32), 3000)
        assert simulator.step(later).equals(undisturbed.step(later))
