import math

import numpy as np
import pytest

from texvent.simulate.esim.simulator import EsimConfig
from texvent.simulate.model_options import contrast_threshold_of, with_contrast_threshold
from texvent.simulate.physical.config import PhysicalConfig
from texvent.simulate.random.mismatch import draw_threshold_pair, sensor_key
from texvent.simulate.texvent.simulator import TexventConfig
from texvent.simulate.v2e.simulator import V2eConfig
from texvent.simulate.voltmeter.simulator import VoltmeterConfig


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


def test_mismatch_of_on_and_off_is_independent():
    config = EsimConfig(contrast_threshold_on=0.2, contrast_threshold_off=0.3, threshold_sigma=0.03)
    pair = np.reshape(draw_threshold_pair((60, 80), sensor_key(0), config), (2, -1))
    assert pair.mean(axis=1) == pytest.approx([0.2, 0.3], abs=5 * 0.03 / math.sqrt(4800))
    assert pair.std(axis=1) == pytest.approx([0.03, 0.03], rel=5 / math.sqrt(9600))
    assert abs(np.corrcoef(pair)[0, 1]) < 5 / math.sqrt(4800)
