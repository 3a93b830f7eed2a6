"""The same definitions in torch: equal to NumPy, on the CPU and, where there is one, on the GPU."""

import numpy as np
import pytest

from texvent._registry import REPRESENTATIONS
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.represent.named import represent
from texvent.represent.tensors import EventTensors
from texvent.represent.voxel_grid import voxel_dsec
from texvent.sensor import SensorSize

from .definitions import SMALL, random_events

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

DEVICES = ["cpu", "cuda"] if torch.cuda.is_available() else ["cpu"]
SIZE = SensorSize(17, 11)
CASES = [(name, {}) for name in REPRESENTATIONS.names()] + [
    ("event-frame", {"kind": "binary"}),
    ("event-frame", {"kind": "count"}),
    ("event-frame", {"kind": "polarity"}),
    ("voxel-zhu", {"bins": 1, "split_polarity": True}),
    ("voxel-e2vid", {"normalise": True}),
    ("time-surface", {"decay": "linear", "at_us": 30_000}),
    ("stacked-histogram", {"cutoff": 2}),
    ("binary-event-image", {"size": (224, 224)}),
    ("histogram-2d", {"shape": (3, 5)}),
    ("histogram-3d", {"bins": 4, "start_us": 10_000, "stop_us": 20_000}),
]


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize(("name", "options"), CASES)
@pytest.mark.parametrize("count", [0, 1, 3000])
def test_torch_equals_numpy(name, options, count, device):
    events = random_events(7, count, SIZE)
    expected = represent(name, events, **options)
    found = represent(name, events, device=device, **options)
    assert found.device.type == device
    found = found.cpu().numpy()
    assert found.dtype == expected.dtype
    assert found.shape == expected.shape
    is_rounded = name in ("voxel-dsec", "time-surface") or options.get("normalise")
    # Sums are exact; only a mean, a root and an exponential may round differently.
    np.testing.assert_allclose(found, expected, rtol=2e-7 if is_rounded else 0, atol=0)


@pytest.mark.parametrize("device", DEVICES)
def test_rectified_grids_agree_to_float32(device):
    events = random_events(3, 500, SIZE)
    table = np.random.default_rng(1).uniform(-1, 18, (11, 17, 2)).astype(np.float32)
    options = {"bins": 3, "normalise": False, "rectify_map": table}
    found = voxel_dsec(EventTensors.of(events, device), **options).cpu().numpy()
    np.testing.assert_allclose(found, voxel_dsec(events, **options), rtol=1e-6, atol=1e-7)


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
