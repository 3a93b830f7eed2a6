import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.calibrate.report.charts import (
    compare_values,
    distribution_chart,
    map_chart,
    noise_chart,
    rate_chart,
)


@given(
    recorded=st.lists(st.floats(1e-6, 1e6), min_size=1, max_size=30),
    simulated=st.lists(st.floats(1e-6, 1e6), min_size=1, max_size=30),
)
def test_every_value_is_in_a_bin(recorded, simulated):
    found = compare_values(np.array(recorded), np.array(simulated))
    assert found.recorded.sum() == pytest.approx(1)
    assert found.simulated.sum() == pytest.approx(1)
    chart = distribution_chart("Intervals <ON>", found, "s")
    assert "Intervals &lt;ON&gt;" in chart
    assert "nan" not in chart


def test_nothing_to_compare_says_so():
    assert compare_values(np.array([]), np.array([1.0])) is None
    assert "No values." in distribution_chart("Intervals", None, "s")


def test_the_busiest_bin_gives_the_peak_rate():
    chart = rate_chart(np.array([0, 5, 10]), np.array([2, 2, 2]), 1.5)
    assert "at most 20 events/s" in chart
    assert rate_chart(np.zeros(3, np.int64), np.zeros(3, np.int64), 1.0)


def test_points_of_the_noise_curve_stand_higher_the_more_noise_there_is():
    rates = np.array([1.0, 0.1, 0.01])
    chart = noise_chart(np.array([1.0, 10.0, 100.0]), rates, np.stack([rates / 2, rates * 2]))
    points = re.findall(r'class="point" d="M([\d.]+) ([\d.]+)h0"', chart)
    heights = [float(y) for _, y in points]
    assert heights == sorted(heights)
    assert len(points) == 3


def test_a_map_is_an_image_inside_the_page():
    values = np.array([[0.0, 1.0], [np.nan, 0.5]])
    assert 'src="data:image/png;base64,' in map_chart("Rates", values, values == 1.0)
    assert map_chart("Nothing", np.full((2, 2), np.nan))
