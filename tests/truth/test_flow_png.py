"""Flow as DSEC's 16-bit PNG, read back by the formula that its authors give."""

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from texvent.truth.loading import decode_flow, encode_flow
from texvent.truth.writer import write_png


def dsec_decode(path):
    """As DSEC's site describes it: three channels of 16 bits; the first is x, the last validity."""
    rgb = cv2.cvtColor(cv2.imread(str(path), cv2.IMREAD_UNCHANGED), cv2.COLOR_BGR2RGB)
    assert rgb.dtype == np.uint16
    return (rgb[..., :2].astype(np.float32) - 2**15) / 128.0, rgb[..., 2] == 1


def test_an_independent_reader_gets_x_y_and_validity(tmp_path):
    flow = np.array([[[1.5, -2.25], [np.nan, 0.0]], [[300.0, 0.0], [-256.0, 255.9921875]]])
    write_png(tmp_path / "f.png", encode_flow(flow))
    read, valid = dsec_decode(tmp_path / "f.png")
    assert valid.tolist() == [[True, False], [False, True]]
    assert read[0, 0].tolist() == [1.5, -2.25]
    assert read[1, 1].tolist() == [-256.0, 255.9921875]


@given(arrays(np.float32, (3, 4, 2), elements=st.floats(-255, 255, width=32)))
def test_flow_comes_back_to_half_a_step(flow):
    assert np.abs(decode_flow(encode_flow(flow)) - flow).max() <= 0.5 / 128.0


def test_what_is_not_valid_comes_back_as_nan():
    flow = np.array([[[np.inf, 0.0], [0.0, -1e9], [0.0, 0.0]]])
    assert np.isnan(decode_flow(encode_flow(flow))).all(axis=2).tolist() == [[True, True, False]]
