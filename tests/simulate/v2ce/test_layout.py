"""The published file's tensors, as its authors' program writes them."""

import math

import pytest

from texvent.simulate.v2ce.network import tensor_shapes


def test_the_published_file_has_218_tensors_of_53_million_numbers():
    shapes = tensor_shapes()
    assert len(shapes) == 218
    assert sum(math.prod(shape) for shape in shapes.values()) == 52_916_466


@pytest.mark.parametrize(
    ("name", "shape"),
    [
        ("UNet.head.conv3d.weight", (32, 2, 3, 3, 3)),
        ("UNet.head.conv3d.bias", (32,)),
        ("UNet.encoders.0.conv1.weight", (64, 32, 3, 3, 3)),
        ("UNet.encoders.3.conv2.weight", (512, 512, 3, 3, 3)),
        ("UNet.encoders.0.downsample.0.weight", (64, 32, 1, 1, 1)),
        ("UNet.encoders.0.downsample.0.bias", (64,)),
        ("UNet.encoders.0.downsample.1.running_mean", (64,)),
        ("UNet.encoders.0.bn1.num_batches_tracked", ()),
        ("UNet.resblocks.1.conv1.module.weight_u", (512,)),
        ("UNet.resblocks.1.conv1.module.weight_v", (13_824,)),
        ("UNet.resblocks.1.conv1.module.weight_bar", (512, 512, 3, 3, 3)),
        # Channels and picture stay, yet the original has a convolution around this block too.
        ("UNet.resblocks.0.downsample.0.weight", (512, 512, 1, 1, 1)),
        ("UNet.decoders.0.conv1.module.weight_bar", (256, 768, 3, 3, 3)),
        ("UNet.decoders.0.conv1.module.weight_v", (20_736,)),
        ("UNet.decoders.3.conv2.module.weight_bar", (32, 32, 3, 3, 3)),
        ("UNet.decoders.3.downsample.0.weight", (32, 96, 1, 1, 1)),
        ("UNet.pred.conv3d.weight", (20, 32, 1, 1, 1)),
        ("UNet.pred.conv3d.bias", (20,)),
    ],
)
def test_a_tensor_has_its_published_shape(name, shape):
    assert tensor_shapes()[name] == shape


def test_spectral_layers_have_no_plain_weight_and_no_bias():
    names = tensor_shapes()
    for absent in ("weight", "bias", "module.bias"):
        assert f"UNet.decoders.2.conv1.{absent}" not in names
        assert f"UNet.resblocks.0.conv2.{absent}" not in names
