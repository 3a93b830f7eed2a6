"""RIFE's network against the NumPy reference, in all three layouts."""

import numpy as np
import pytest

from . import rife_numpy
from .rife_files import random_tensors

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

from texvent.interpolate.rife.network import (  # noqa: E402
    LAYOUTS,
    RIFE_4_0,
    RIFE_4_6,
    RIFE_4_25,
    IntermediateFlow,
    RifeNetwork,
    move_motion,
    warp,
)


@pytest.mark.parametrize(
    ("layout", "tensors", "parameters", "pad_to"),
    [
        (RIFE_4_0, 128, 5_160_980, 32),
        (RIFE_4_6, 120, 5_306_256, 32),
        (RIFE_4_25, 158, 5_664_776, 64),
    ],
)
def test_layouts_have_the_published_sizes(layout, tensors, parameters, pad_to):
    with torch.device("meta"):
        state = RifeNetwork(layout).state_dict()
    assert len(state) == tensors
    assert sum(one.numel() for one in state.values()) == parameters
    assert layout.pad_to == pad_to


def narrow(layout):
    """A network of 8 channels, and its tensors; every name and relation stays."""
    tensors = random_tensors(torch, layout)
    network = RifeNetwork(layout, (8,) * len(layout.widths))
    network.load_state_dict({name: torch.from_numpy(one) for name, one in tensors.items()})
    return network.requires_grad_(False), tensors


@pytest.mark.parametrize("position", [0.5, 0.3])
@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: layout.name)
def test_the_network_gives_the_numbers_of_the_reference(layout, position):
    network, tensors = narrow(layout)
    first, second = np.random.default_rng(1).random((2, 3, 64, 128))
    expected_flow, expected_mask = rife_numpy.NumpyRife(layout, tensors).estimate(
        first, second, position
    )
    images = (torch.from_numpy(one.astype(np.float32))[None] for one in (first, second))
    motion = network(*images, position)
    # float32 through 50 layers and 4 warps of noise against float64.
    assert np.abs(motion.flow[0].numpy() - expected_flow).max() < 2e-4
    assert np.abs(motion.mask[0].numpy() - expected_mask).max() < 2e-4
    assert np.abs(expected_flow).mean() > 0.5
    assert np.std(expected_mask) > 0.05


def test_warp_looks_pixels_up_and_repeats_edges():
    image = torch.arange(12.0).reshape(1, 1, 3, 4)
    flow = torch.zeros(1, 2, 3, 4)
    assert torch.equal(warp(image, flow), image)
    flow[:, 0] = 1.5
    assert warp(image, flow)[0, 0, 0].tolist() == pytest.approx([1.5, 2.5, 3.0, 3.0], abs=1e-5)
    flow[:, 0], flow[:, 1] = 0.0, -1.0
    assert warp(image, flow)[0, 0, :, 0].tolist() == pytest.approx([0.0, 0.0, 4.0], abs=1e-5)


@pytest.mark.parametrize("position", [0.1, 0.5, 0.8])
def test_shared_motion_is_exact_for_a_steady_shift(position):
    flow = torch.tensor([-3.0, 1.0, 3.0, -1.0]).reshape(1, 4, 1, 1).expand(1, 4, 8, 9)
    moved = move_motion(IntermediateFlow(flow, torch.zeros(1, 1, 8, 9)), [position])
    expected = [-6 * position, 2 * position, 6 * (1 - position), -2 * (1 - position)]
    assert moved.flow[0, :, 4, 4].tolist() == pytest.approx(expected, abs=1e-5)
    # An even mask becomes the weights of a cross-fade.
    assert float(moved.mask.sigmoid()[0, 0, 4, 4]) == pytest.approx(1 - position, abs=1e-5)


def test_shared_motion_leaves_with_the_point():
    """A strip that moves right: later, its left edge has left where it was in the middle."""
    flow = torch.zeros(1, 4, 1, 60)
    flow[:, 0, :, 20:40], flow[:, 2, :, 20:40] = -4.0, 4.0
    late = move_motion(IntermediateFlow(flow, torch.zeros(1, 1, 1, 60)), [1.0 - 1e-6])
    assert late.flow[0, 0, 0, [10, 21, 30, 39, 50]].tolist() == pytest.approx(
        [0.0, 0.0, -8.0, -8.0, 0.0], abs=1e-3
    )
