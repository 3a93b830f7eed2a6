"""The physical model: ideal pixels against closed forms, and any options at all."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.simulation.references import in_both_forms

from texvent.sensor import SENSORS
from texvent.simulation.physical.cameras import CAMERAS, PRESETS
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator

from ..pixel_frames import frames_of, moving_texture, run
from .physical_pixels import clean, intensity

# One pixel, closed forms.


def test_a_slow_ramp_is_summed_over_frames_and_keeps_the_rest():
    # Ramp B' of docs/equations.md: 0.055 per frame.
    frames = frames_of([intensity(4 + 0.055 * i) for i in range(21)], range(0, 21_000, 1000))
    events = run(clean(), frames)
    assert events.t == pytest.approx([k * 0.2 / 0.055 * 1000 for k in range(1, 6)], abs=1)


def test_gamma_makes_video_linear():
    levels = [255 * (linear / 255) ** (1 / 2.2) for linear in (50, 120)]
    coded = run(clean(gamma=2.2), frames_of(levels, [0, 100_000]))
    linear = run(clean(), frames_of([50, 120], [0, 100_000]))
    assert len(coded) == 3  # ln(130 / 60) = 0.773
    assert coded.t == pytest.approx(linear.t, abs=2)


def test_on_and_off_have_their_own_thresholds():
    simulator = clean(contrast_threshold=0.2, on_off_ratio=1.44)
    assert simulator.config.contrast_threshold_on == pytest.approx(0.24)
    assert simulator.config.contrast_threshold_off == pytest.approx(0.2 / 1.2)
    events = run(
        simulator, frames_of([intensity(v) for v in (4, 5, 5.1, 4)], [0, 10**6, 2 * 10**6, 10**7])
    )
    # Up by 1.1: 4 at 0.24 (the rest, 0.14, stays). Down by 1.1: 0.14 + 5 at 0.1667.
    assert int(events.p.sum()) == 4
    assert int((events.p == 0).sum()) == 5


def test_refractory_time_adds_to_the_time_between_events():
    # 1 log unit per second, threshold 0.2: 200 ms to charge after each 50 ms in reset.
    frames = frames_of([intensity(4), intensity(5)], [0, 1_000_000])
    events = run(clean(refractory_period_us=50_000), frames)
    # Times are rounded down, and the next period starts from the rounded one.
    assert events.t == pytest.approx([200_000, 450_000, 700_000, 950_000], abs=6)


def test_a_change_in_the_refractory_period_is_lost():
    values, times = [intensity(v) for v in (4, 4.25, 4.25, 4.45, 4.45)], [0, 10, 20, 30, 10**6]
    kept = run(clean(), frames_of(values, times))
    lost = run(clean(refractory_period_us=1000), frames_of(values, times))
    assert len(kept) == 2
    assert len(lost) == 1


# Everything at once.


CONFIGS = st.builds(
    PhysicalConfig,
    gamma=st.sampled_from([1.0, 2.2]),
    balance=st.floats(0.5, 40),
    contrast_threshold=st.floats(0.03, 0.6),
    on_off_ratio=st.floats(0.6, 1.6),
    threshold_sigma=st.sampled_from([0.0, 0.05]),
    initial_phase=st.sampled_from(["zero", "random"]),
    cutoff_hz=st.sampled_from([0.0, 5.0, 250.0]),
    refractory_period_us=st.sampled_from([0, 1, 300, 60_000]),
    leak_rate_hz=st.sampled_from([0.0, 0.1, 30.0]),
    noise_scale=st.sampled_from([0.0, 1.0, 300.0]),
    hot_pixel_fraction=st.sampled_from([0.0, 0.2]),
    scan_period_ns=st.sampled_from([0, 30_000_000]),
)


@examples(60)
@given(CONFIGS, st.integers(0, 2**63 - 1), st.integers(0, 99))
def test_backends_agree_and_packets_are_sound_for_any_options(config, seed, scene):
    frames = moving_texture(5, (4, 6), step_us=41_667, seed=scene)

    def packets_of() -> list:
        simulator = PhysicalSimulator(config, seed=seed)
        last = frames[0].t_us
        packets = []
        for frame in frames:
            packets.append(simulator.step(frame))
            assert not len(packets[-1]) or last <= packets[-1].t[0]
            assert not len(packets[-1]) or packets[-1].t[-1] < frame.t_us
            last = frame.t_us
        return packets

    assert all(one.equals(two) for one, two in zip(*in_both_forms(packets_of), strict=True))


def test_eq4_counts_in_the_gamma_coded_scale():
    simulator = PhysicalSimulator(
        PhysicalConfig(contrast_threshold=0.22, on_off_ratio=1.21, balance=100.0)
    )
    assert simulator.contrast_threshold == pytest.approx(0.2 / 2.2)
    assert simulator.balance == pytest.approx(255 * (100 / 255) ** (1 / 2.2))


@pytest.mark.parametrize("name", CAMERAS)
def test_a_preset_is_the_constants_that_have_a_source(name: str) -> None:
    camera = CAMERAS[name]
    assert SENSORS[name].description.split()[0] in camera.description
    assert all(len(one.reference) > 20 for one in camera.constants)
    values = {one.option: one.value for one in camera.constants}
    assert PRESETS[name] == dataclasses.replace(PhysicalConfig(), **values)
