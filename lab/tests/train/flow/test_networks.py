"""EV-FlowNet and E-RAFT: sizes, layouts, look-up of correlations against a slow reference."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent.networks.weight_files import shapes_of  # noqa: E402
from texvent_lab.train.flow.e_raft import (  # noqa: E402
    CorrelationPyramid,
    make_e_raft,
)
from texvent_lab.train.flow.task import make_ev_flow_net  # noqa: E402

pytestmark = pytest.mark.torch


def slow_look_up(
    first: NDArray[np.float64], second: NDArray[np.float64], places: NDArray[np.float64],
    levels: int, radius: int,
) -> NDArray[np.float64]:  # fmt: skip
    """[levels · side², h, w] of one pair of images, number by number."""
    channels, height, width = first.shape
    side = 2 * radius + 1
    found = np.zeros((levels, side, side, height, width))
    for y in range(height):
        for x in range(width):
            image = np.einsum("c,chw->hw", first[:, y, x], second) / math.sqrt(channels)
            for level in range(levels):
                centre = places[:, y, x] / 2**level
                for i in range(side):
                    for j in range(side):
                        at_x, at_y = centre[0] + i - radius, centre[1] + j - radius
                        found[level, i, j, y, x] = bilinear(image, at_x, at_y)
                rows, columns = image.shape[0] // 2, image.shape[1] // 2
                image = image[: 2 * rows, : 2 * columns]
                image = image.reshape(rows, 2, columns, 2).mean(axis=(1, 3))
    return found.reshape(-1, height, width)


def bilinear(image: NDArray[np.float64], x: float, y: float) -> float:
    left, top = math.floor(x), math.floor(y)
    value = 0.0
    for row in (top, top + 1):
        for column in (left, left + 1):
            if 0 <= row < image.shape[0] and 0 <= column < image.shape[1]:
                value += (1 - abs(x - column)) * (1 - abs(y - row)) * image[row, column]
    return value


def test_correlations_are_those_of_the_slow_reference() -> None:
    chance = np.random.default_rng(0)
    first, second = chance.normal(size=(2, 2, 3, 5, 6))
    places = chance.uniform(-3, 8, (2, 2, 5, 6))
    pyramid = CorrelationPyramid(torch.from_numpy(first), torch.from_numpy(second), levels=3)
    found = pyramid.look_up(torch.from_numpy(places), 2).numpy()
    for number in range(2):
        expected = slow_look_up(first[number], second[number], places[number], 3, 2)
        np.testing.assert_allclose(found[number], expected, atol=1e-12)


def test_a_size_of_one_pixel_is_looked_up_too() -> None:
    ones = torch.ones(1, 4, 2, 2)
    found = CorrelationPyramid(ones, ones, levels=2).look_up(torch.zeros(1, 2, 2, 2), 0)
    assert found[:, 1].tolist() == [[[2, 2], [2, 2]]]


def test_e_raft_has_its_published_layout() -> None:
    shapes = shapes_of(make_e_raft(15).tensors)
    expected = {
        "fnet.conv1.weight": (64, 15, 7, 7),
        "fnet.layer2.0.downsample.0.weight": (96, 64, 1, 1),
        "cnet.norm1.running_mean": (64,),
        "cnet.layer3.0.norm3.weight": (128,),
        "cnet.layer3.0.downsample.1.weight": (128,),
        "cnet.conv2.weight": (256, 128, 1, 1),
        "update_block.encoder.convc1.weight": (256, 324, 1, 1),
        "update_block.gru.convq2.weight": (128, 384, 5, 1),
        "update_block.mask.2.bias": (576,),
    }
    assert {name: shapes[name] for name in expected} == expected
    assert "fnet.norm1.weight" not in shapes
    assert len(shapes) == 162


@pytest.mark.parametrize("size", [(64, 96), (48, 50)])
def test_e_raft_gives_flow_of_the_size_of_its_input(size: tuple[int, int]) -> None:
    network = make_e_raft(3).eval()
    draws = torch.Generator().manual_seed(0)
    before, voxel = torch.randn(2, 2, 3, *size, generator=draws)
    with torch.inference_mode():
        both = network(before, voxel)
        alone = network(before[1:], voxel[1:])
    assert both.shape == (2, 2, *size)
    assert float(both.abs().max()) > 0
    torch.testing.assert_close(both[1:], alone, rtol=1e-3, atol=1e-4)


def test_ev_flow_net_gives_flow_at_four_scales() -> None:
    network = make_ev_flow_net(5, 4, seed=0)
    flows = network(torch.rand(2, 5, 45, 60))
    assert [tuple(flow.shape) for flow in flows] == [(2, 2, 45, 60)] * 4
    sum(flow.sum() for flow in flows).backward()
    assert all(one.grad is not None for one in network.parameters())


def test_ev_flow_net_has_as_many_channels_as_published() -> None:
    shapes = shapes_of(make_ev_flow_net(5, 32, 0).tensors)
    assert shapes["multires_unet.encoders.3.conv2d.weight"] == (512, 256, 3, 3)
    assert shapes["multires_unet.resblocks.1.conv2.weight"] == (512, 512, 3, 3)
    assert shapes["multires_unet.decoders.0.conv2d.weight"] == (256, 1024, 3, 3)
    assert shapes["multires_unet.decoders.1.conv2d.weight"] == (128, 514, 3, 3)
    assert shapes["multires_unet.preds.3.conv2d.weight"] == (2, 32, 1, 1)


def test_weights_are_read_as_they_were(tmp_path: Path) -> None:
    written, read = (make_ev_flow_net(5, 2, seed=seed) for seed in (0, 1))
    read.read(written.tensors, tmp_path / "weights.pt", "elsewhere")
    assert all(torch.equal(one, read.tensors[name]) for name, one in written.tensors.items())
