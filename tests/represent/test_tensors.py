"""The same definitions in torch: equal to NumPy, on the CPU and, where there is one, on the GPU."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent._registry import REPRESENTATIONS
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.represent.named import represent
from texvent.represent.tensors import EventTensors
from texvent.sensor import SensorSize

from .definitions import DEFINITIONS, SMALL, from_first, random_events

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

DEVICES = ["cpu", "cuda"] if torch.cuda.is_available() else ["cpu"]


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("name", REPRESENTATIONS.names())
@given(data=st.data())
@examples(15)
def test_torch_equals_numpy_with_any_options(name, device, data):
    events = random_events(7, data.draw(st.sampled_from([0, 1, 3000])), SMALL)
    drawn = data.draw(st.fixed_dictionaries({}, optional=DEFINITIONS[name][1]))
    options = from_first(drawn, events)
    if "rectify_map" in options:
        options["normalise"] = False
    expected = represent(name, events, **options)
    found = represent(name, events, device=device, **options)
    assert found.device.type == device
    found = found.cpu().numpy()
    assert (found.dtype, found.shape) == (expected.dtype, expected.shape)
    is_summed = "rectify_map" in options
    is_rounded = name in ("voxel-dsec", "time-surface") or options.get("normalise")
    # Sums are exact; only weights, a mean, a root and an exponential may round differently.
    rtol = 1e-6 if is_summed else 2e-7 if is_rounded else 0
    np.testing.assert_allclose(found, expected, rtol=rtol, atol=1e-5 if is_summed else 0)


@pytest.mark.parametrize("name", REPRESENTATIONS.names())
def test_convention_the_callers_tensors_stay_as_they_are(name):
    columns = [torch.tensor(one) for one in ([1, 2], [0, 1], [5, 9], [0, 1])]
    before = [column.clone() for column in columns]
    result = represent(name, EventTensors(*columns, SMALL))
    result.fill_(1)
    assert all(torch.equal(*pair) for pair in zip(columns, before, strict=True))


def test_tensors_go_to_the_device_that_is_asked_for():
    events = EventTensors.of(random_events(2, 20, SMALL))
    for device in DEVICES:
        assert represent("event-frame", events, device=device).device.type == device
    with pytest.raises(ConfigError, match="torch cannot put events on device 'gpu'"):
        represent("event-frame", events, device="gpu")


def test_tensors_have_types_that_torch_can_index_with():
    events = EventStream([3, 4], [0, 2], [10, 2**40], [1, 0], SensorSize(65_535, 3), label=[0, 1])
    events = EventStream(**{**events.columns(), "x": np.array([3, 65_534])}, size=events.size)
    tensors = events.to_torch()
    assert {name: str(one.dtype) for name, one in tensors.items()} == {
        "x": "torch.int32",
        "y": "torch.int32",
        "t": "torch.int64",
        "p": "torch.int8",
        "label": "torch.int8",
    }
    assert tensors["x"].tolist() == [3, 65_534]
    assert tensors["t"].tolist() == [10, 2**40]
    tensors["p"].fill_(0)
    assert events.p.tolist() == [1, 0]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x": [0, 4]}, r"x runs from 0 to 4; allowed: 0\.\.3"),
        ({"p": [-1, 1]}, r"p runs from -1 to 1; allowed: 0\.\.1"),
        ({"t": [5, 4]}, "time decreases"),
        ({"t": [5]}, "equally long"),
        ({"t": [0.5, 1.5]}, "t must hold integers"),
    ],
)
def test_wrong_tensors_fail_with_the_value_and_what_is_allowed(change, message):
    columns = {"x": [0, 1], "y": [0, 1], "t": [0, 1], "p": [0, 1], **change}
    tensors = {name: torch.tensor(one) for name, one in columns.items()}
    with pytest.raises(InputError, match=message):
        EventTensors(**tensors, size=SMALL)
