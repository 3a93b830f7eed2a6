import math

import numpy as np
import pytest

from texvent._registry import SIMULATORS
from texvent.options.values import plain
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.model_options import (
    NOISE,
    contrast_threshold_of,
    draw_training_config,
    with_contrast_threshold,
)
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.random.mismatch import draw_threshold_pair, sensor_key
from texvent.simulation.texvent.simulator import TexventConfig
from texvent.simulation.v2e.config import V2eConfig
from texvent.simulation.voltmeter.config import VoltmeterConfig

SEEDS = range(400)


def test_v2v_draws_thresholds_and_ratios_over_the_stated_ranges():
    configs = [draw_training_config(PhysicalConfig(), "v2v", seed=seed) for seed in SEEDS]
    thresholds = np.array([config.contrast_threshold for config in configs])
    ratios = np.array([config.on_off_ratio for config in configs])
    assert 0.05 <= thresholds.min() < 0.1
    assert 1.9 < thresholds.max() <= 2.0
    assert thresholds.mean() == pytest.approx(1.025, abs=5 * 1.95 / math.sqrt(12 * 400))
    assert 1 / 1.5 <= ratios.min() < 0.7
    assert 1.45 < ratios.max() <= 1.5


def test_stoffregen_draws_one_threshold_near_the_other():
    configs = [draw_training_config(PhysicalConfig(), "stoffregen", seed=seed) for seed in SEEDS]
    thresholds = [config.contrast_threshold for config in configs]
    assert min(thresholds) >= 0.1
    assert max(thresholds) <= 1.5
    logs = np.log([config.on_off_ratio for config in configs])
    assert logs.mean() == pytest.approx(0, abs=0.03)
    assert logs.std() == pytest.approx(0.1, rel=0.2)


@pytest.mark.parametrize("recipe", ["stoffregen", "v2v"])
def test_each_option_varies_in_its_range_by_a_draw_of_its_own(recipe):
    drawn = [draw_training_config(PhysicalConfig(), recipe, seed=seed) for seed in SEEDS]
    noise = [name for name in NOISE if hasattr(drawn[0], name)]
    names = ("contrast_threshold", "on_off_ratio", *noise)
    values = {name: [getattr(one, name) for one in drawn] for name in names}
    for name in noise:
        assert NOISE[name].low <= min(values[name]) < max(values[name]) <= NOISE[name].high
    ranks = [np.argsort(np.argsort(one)) for one in values.values()]
    for columns in (list(values.values()), ranks):
        assert np.abs(np.corrcoef(columns) - np.eye(len(names))).max() < 4 / math.sqrt(400)


def test_the_same_seed_draws_the_same_whatever_was_set_before():
    one = draw_training_config(PhysicalConfig(), "v2v", seed=7)
    assert one == draw_training_config(one, "v2v", seed=7)
    assert one != draw_training_config(PhysicalConfig(), "v2v", seed=8)
    assert plain(one)["contrast_threshold"] == one.contrast_threshold


def test_models_share_the_draws_of_the_options_they_share():
    physical = draw_training_config(PhysicalConfig(), "v2v", seed=3)
    texvent = draw_training_config(TexventConfig(), "v2v", seed=3)
    esim = draw_training_config(EsimConfig(), "v2v", seed=3)
    assert texvent.contrast_threshold == physical.contrast_threshold
    assert contrast_threshold_of(esim) == pytest.approx(physical.contrast_threshold)
    assert texvent.noise_scale == physical.noise_scale


@pytest.mark.parametrize(
    "config",
    [
        TexventConfig(contrast_threshold=0.3),
        PhysicalConfig(contrast_threshold=0.3, on_off_ratio=1.3),
        EsimConfig(contrast_threshold_on=0.2, contrast_threshold_off=0.45),
        V2eConfig(contrast_threshold_on=0.9, contrast_threshold_off=0.1),
        VoltmeterConfig(constants=f"{1 / 0.3} 20 0 0 0 0"),
    ],
)
def test_one_number_reads_and_writes_the_threshold_of_every_model(config):
    assert contrast_threshold_of(config) == pytest.approx(0.3)
    changed = with_contrast_threshold(config, 0.15)
    assert type(changed) is type(config)
    assert contrast_threshold_of(changed) == pytest.approx(0.15)


def test_on_and_off_keep_their_ratio_unless_it_is_given():
    config = EsimConfig(contrast_threshold_on=0.2, contrast_threshold_off=0.4)
    kept = with_contrast_threshold(config, 0.6)
    assert kept.contrast_threshold_off / kept.contrast_threshold_on == pytest.approx(2)
    even = with_contrast_threshold(config, 0.6, on_off_ratio=1.0)
    assert even.contrast_threshold_off == pytest.approx(even.contrast_threshold_on)
    physical = with_contrast_threshold(PhysicalConfig(), 0.6, on_off_ratio=1.2)
    assert physical.contrast_threshold_on / physical.contrast_threshold_off == pytest.approx(1.2)


@pytest.mark.parametrize("name", SIMULATORS.builtin)
@pytest.mark.parametrize("ratio", [1.0, 2.0, 0.5])
def test_eq4_counts_with_the_smaller_threshold_whichever_it_is(name, ratio):
    model = SIMULATORS.load(name)
    even = next(iter(model.presets.values()))
    if not hasattr(even, "contrast_threshold_on"):
        return
    small, large = (with_contrast_threshold(even, one, on_off_ratio=1.0) for one in (0.2, 0.4))
    mean = 0.2 * math.sqrt(max(ratio, 1 / ratio))
    uneven = with_contrast_threshold(even, mean, on_off_ratio=ratio)
    counted = [model(one).contrast_threshold for one in (small, uneven, large)]
    assert counted == pytest.approx([counted[0], counted[0], 2.0 * counted[0]])


def test_mismatch_of_on_and_off_is_independent():
    config = EsimConfig(contrast_threshold_on=0.2, contrast_threshold_off=0.3, threshold_sigma=0.03)
    pair = np.reshape(draw_threshold_pair((60, 80), sensor_key(0), config), (2, -1))
    assert pair.mean(axis=1) == pytest.approx([0.2, 0.3], abs=5 * 0.03 / math.sqrt(4800))
    assert pair.std(axis=1) == pytest.approx([0.03, 0.03], rel=5 / math.sqrt(9600))
    assert abs(np.corrcoef(pair)[0, 1]) < 5 / math.sqrt(4800)
