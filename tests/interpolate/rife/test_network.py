"""RIFE's network against the NumPy reference, in all three layouts."""

from dataclasses import replace

import numpy as np
import pytest

from texvent.interpolate.networks.torch_warp import warp
from texvent.interpolate.rife.layouts import LAYOUTS
from texvent.interpolate.rife.network import Motion, RifeNetwork, move_motion

from . import rife_numpy
from .rife_files import random_tensors

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")


def small(layout):
    """The layout with narrow blocks; every name and relation stays."""
    return replace(layout, widths=(8,) * len(layout.widths))


@pytest.mark.parametrize("position", [0.5, 0.3])
@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: layout.name)
def test_the_network_gives_the_numbers_of_the_reference(layout, position):
    layout = small(layout)
    tensors = random_tensors(layout)
    first, second = np.random.default_rng(1).random((2, 3, 64, 128))
    expected_flow, expected_mask = rife_numpy.NumpyRife(layout, tensors).estimate(
        first, second, position
    )
    network = RifeNetwork(layout, {name: torch.from_numpy(one) for name, one in tensors.items()})
    images = (torch.from_numpy(one.astype(np.float32))[None] for one in (first, second))
    motion = network.estimate(network.encode(*images), torch.tensor(position))
    # float32 through 50 layers and 4 warps of noise against float64.
    assert np.abs(motion.flow[0].numpy() - expected_flow).max() < 2e-4
    assert np.abs(motion.mask[0].numpy() - expected_mask).max() < 2e-4
    assert np.abs(expected_flow).mean() > 0.5
    assert np.std(expected_mask) > 0.05


def test_the_instant_changes_the_motion():
    layout = small(LAYOUTS[0])
    tensors = random_tensors(layout)
    network = RifeNetwork(layout, {name: torch.from_numpy(one) for name, one in tensors.items()})
    pair = network.encode(*torch.rand(2, 1, 3, 64, 64, generator=torch.Generator().manual_seed(0)))
    early, late = (network.estimate(pair, torch.tensor(at)) for at in (0.1, 0.9))
    assert float((early.flow - late.flow).abs().max()) > 0.01


def test_warp_looks_pixels_up_and_repeats_edges():
    image = torch.arange(12.0).reshape(1, 1, 3, 4)
    flow = torch.zeros(1, 2, 3, 4)
    assert torch.equal(warp(image, flow), image)
    flow[:, 0] = 1.5
    assert warp(image, flow)[0, 0, 0].tolist() == pytest.approx([1.5, 2.5, 3.0, 3.0], abs=1e-5)
    flow[:, 0], flow[:, 1] = 0.0, -1.0
    assert warp(image, flow)[0, 0, :, 0].tolist() == pytest.approx([0.0, 0.0, 4.0], abs=1e-5)


def test_warp_equals_the_reference_on_noise():
    random = np.random.default_rng(0)
    image, flow = random.random((3, 20, 30)), random.normal(0, 6, (2, 20, 30))
    found = warp(
        torch.from_numpy(image.astype(np.float32))[None],
        torch.from_numpy(flow.astype(np.float32))[None],
    )
    assert np.abs(found[0].numpy() - rife_numpy.warp(image, flow)).max() < 1e-4


def test_a_half_precision_image_is_warped_at_full_precision():
    """With half-precision coordinates, columns beyond 2048 could not be told apart."""
    image = (torch.arange(4001.0) % 7).half().reshape(1, 1, 1, -1)
    flow = torch.zeros(1, 2, 1, 4001, dtype=torch.float16)
    flow[:, 0] = 1.0
    moved = warp(image, flow)
    assert moved.dtype == torch.float16
    assert float((moved[..., :-1] - image[..., 1:]).abs().max()) < 0.01


@pytest.mark.parametrize("position", [0.1, 0.5, 0.8])
def test_shared_motion_is_exact_for_a_steady_shift(position):
    flow = torch.tensor([-3.0, 1.0, 3.0, -1.0]).reshape(1, 4, 1, 1).expand(1, 4, 8, 9)
    moved = move_motion(Motion(flow, torch.zeros(1, 1, 8, 9)), position)
    expected = [-6 * position, 2 * position, 6 * (1 - position), -2 * (1 - position)]
    assert moved.flow[0, :, 4, 4].tolist() == pytest.approx(expected, abs=1e-5)
    # An even mask becomes the weights of a cross-fade.
    assert float(moved.mask.sigmoid()[0, 0, 4, 4]) == pytest.approx(1 - position, abs=1e-5)


def test_shared_motion_leaves_with_the_point():
    """A strip that moves right: later, its left edge has left where it was in the middle."""
    flow = torch.zeros(1, 4, 1, 60)
    flow[:, 0, :, 20:40], flow[:, 2, :, 20:40] = -4.0, 4.0
    late = move_motion(Motion(flow, torch.zeros(1, 1, 1, 60)), 1.0 - 1e-6)
    assert late.flow[0, 0, 0, [10, 21, 30, 39, 50]].tolist() == pytest.approx(
        [0.0, 0.0, -8.0, -8.0, 0.0], abs=1e-3
    )
