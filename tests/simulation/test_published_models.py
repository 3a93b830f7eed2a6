"""Every pixel model: copied, reset, of any size and type; frames of many blocks in threads."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest
from tests.simulation.references import in_both_forms

from texvent._registry import SIMULATORS
from texvent.errors import InputError
from texvent.frames import Frame
from texvent.simulation.physical.cameras import PRESETS
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator
from texvent.simulation.senpi.simulator import SenpiSimulator
from texvent.simulation.v2e.config import V2eConfig
from texvent.simulation.v2e.simulator import V2eSimulator
from texvent.simulation.voltmeter.config import VoltmeterConfig
from texvent.simulation.voltmeter.simulator import VoltmeterSimulator

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


shared = pytest.mark.usefixtures("small_parts")

SHAPE = (61, 83)
"""Several blocks of pixels, the last one cut short."""


def patches(dtypes, *, seed=0) -> list[Frame]:
    """A still picture, in a corner of which something moves; parts of frames rest for long."""
    random = np.random.default_rng(seed)
    still = random.integers(0, 256, SHAPE)
    frames = []
    for i, dtype in enumerate(dtypes):
        pixels = still.copy()
        pixels[:12, :20] = random.integers(0, 256, (12, 20))
        frames.append(Frame(pixels.astype(dtype), 5000 * i))
    return frames


def assert_equal_to_reference(simulator_class, config, frames, seed=3) -> int:
    reference, compiled = in_both_forms(lambda: run(simulator_class(config, seed=seed), frames))
    assert compiled.equals(reference)
    return len(compiled)


CONFIGS = [
    (PhysicalSimulator, PhysicalConfig()),
    (PhysicalSimulator, PRESETS["clean"]),
    # Leak fires pixels whose light rests, in blocks that would be skipped else.
    (PhysicalSimulator, PhysicalConfig(leak_rate_hz=20.0, noise_scale=0.0, initial_phase="zero")),
    (V2eSimulator, V2eConfig(leak_rate_hz=20.0, shot_noise_rate_hz=20.0)),
    (VoltmeterSimulator, VoltmeterSimulator.presets["davis240"]),
    (SenpiSimulator, SenpiSimulator.presets["default"]),
]


@shared
@pytest.mark.parametrize(("simulator_class", "config"), CONFIGS)
@pytest.mark.parametrize(
    "dtypes", [[np.uint8] * 8, [np.float32] * 8, [np.uint8, np.uint8, np.float32] * 3]
)
def test_blocks_of_any_type_fire_as_in_the_reference(simulator_class, config, dtypes):
    assert assert_equal_to_reference(simulator_class, config, patches(dtypes)) > 100


@shared
@pytest.mark.parametrize("leak_rate_hz", [0.0, 4.0])
def test_a_scene_that_rests_for_long_still_leaks_in_time(leak_rate_hz):
    config = dataclasses.replace(
        PRESETS["clean"], cutoff_hz=100.0, leak_rate_hz=leak_rate_hz, leak_rate_decades=0.1
    )
    still = patches([np.uint8])[0].pixels
    frames = [Frame(still, 10_000 * i) for i in range(100)]
    count = assert_equal_to_reference(PhysicalSimulator, config, frames)
    # 0.99 s at 4 per second are 3 whole events of every pixel, give or take its own rate.
    assert count == pytest.approx(3.5 * still.size, rel=0.1) if leak_rate_hz else count == 0


@shared
@pytest.mark.parametrize(
    ("simulator_class", "config"),
    [
        (V2eSimulator, V2eConfig(leak_rate_hz=4.0, cutoff_hz=30.0, shot_noise_rate_hz=0.2)),
        (V2eSimulator, V2eConfig(leak_rate_hz=0.0, cutoff_hz=30.0)),
        (VoltmeterSimulator, VoltmeterConfig(constants="5.265 20 1e-4 1e-7 0 1e-5")),
        (PhysicalSimulator, PhysicalConfig(noise_scale=0.1)),
    ],
)
def test_blocks_that_come_to_rest_and_move_again_fire_as_in_the_reference(simulator_class, config):
    still, moved = (patches([np.uint8], seed=seed)[0].pixels for seed in (0, 1))
    pictures = [still] * 2 + [moved] * 60 + [still] * 40
    frames = [Frame(pixels, 10_000 * i) for i, pixels in enumerate(pictures)]
    assert assert_equal_to_reference(simulator_class, config, frames) > 1000
