"""Every network against its slow twin in NumPy float64, on untrained weights."""

from types import SimpleNamespace

import numpy as np
import pytest

from .network_files import network_class, random_tensors, small_shapes
from .networks_numpy import run_et_net, run_firenet, run_unet

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
from texvent_lab.reconstruct.hyper_e2vid import fourier_bessel  # noqa: E402

HAS_NORM = "unetrecurrent.encoders.0.conv.norm_layer.weight"


def grids(count=2, height=16, width=24):
    random = np.random.default_rng(5)
    shape = (count, 5, height, width)
    return random.normal(0, 1, shape) * (random.random(shape) < 0.3)


def check(name, expected_of, *, settings=None, marks=()):
    tensors = random_tensors(small_shapes(name, *marks))
    network = network_class(name).from_tensors(
        {key: torch.from_numpy(one) for key, one in tensors.items()}, settings or {}
    )
    state = {key: one.astype(np.float64) for key, one in tensors.items()}
    expected = np.stack(expected_of(grids(), state))
    assert expected.std() > 1e-3
    for _ in range(2):  # the second time after a reset
        network.reset()
        found = np.stack(
            [
                network.step(torch.from_numpy(one[None]).float())[0, 0].detach().numpy()
                for one in grids()
            ]
        )
        np.testing.assert_allclose(found, expected, rtol=0, atol=2e-5)


FIRENET = SimpleNamespace(
    head="net.head.conv",
    units=("net.head.recurrent_block", "net.resblocks.0.recurrent_block"),
    blocks=("net.resblocks.0.conv", "net.resblocks.1"),
    prediction="net.pred",
)
FIRENET_PLUS = SimpleNamespace(
    head="head", units=("G1", "G2"), blocks=("R1", "R2"), prediction="pred"
)


@pytest.mark.parametrize(("name", "names"), [("firenet", FIRENET), ("firenet+", FIRENET_PLUS)])
def test_firenet_equals_its_definition(name, names):
    check(name, lambda voxels, state: run_firenet(voxels, state, names))


def test_hyper_e2vid_equals_its_definition_pixel_by_pixel():
    check(
        "hypere2vid",
        lambda voxels, state: run_unet(voxels, state, has_sigmoid=False, is_dynamic=True),
    )


def test_et_net_equals_its_definition():
    check("et-net", run_et_net)


@pytest.mark.parametrize("name", ["hypere2vid", "et-net"])
def test_clips_of_a_batch_do_not_see_each_other_and_all_weights_learn(name):
    torch.manual_seed(0)
    shape = (2, 2, 5, 16, 24)
    network, voxels = network_class(name).like(small_shapes(name), {}), torch.randn(shape)
    network(voxels).square().sum().backward()
    assert all(one.grad is not None and one.grad.any() for one in network.parameters())
    network.eval()
    with torch.inference_mode():
        together, alone = network(voxels), network(voxels[1:])
    torch.testing.assert_close(together[1:], alone)


def test_patterns_of_dynamic_kernels_are_orthonormal_on_the_larger_disc():
    patterns = fourier_bessel(5)
    assert patterns.shape == (12, 25)
    products = patterns[6:] @ patterns[6:].T
    np.testing.assert_allclose(products, np.eye(6), atol=0.04)
    small = patterns.reshape(-1, 5, 5)[:6]  # on 3x3 px
    assert not np.delete(small, [1, 2, 3], axis=1).any()
    assert np.square(small).sum() == pytest.approx(6)
    # As the authors' program computes them.
    assert patterns[[0, 6], 12] == pytest.approx([0.67310524, 0.43870705])


@pytest.mark.parametrize("name", ["e2vid", "e2depth"])
@pytest.mark.parametrize("marks", [(), (HAS_NORM,)])
def test_e2vid_and_e2depth_equal_their_definition_in_every_variant(name, marks):
    check(
        name,
        lambda voxels, state: run_unet(voxels, state, has_sigmoid=True),
        settings={"final_activation": ""},  # it ends with a sigmoid whatever its file says
        marks=marks,
    )


@pytest.mark.parametrize("activation", ["", "sigmoid"])
def test_e2vid_plus_ends_as_its_file_says(activation):
    check(
        "e2vid+",
        lambda voxels, state: run_unet(voxels, state, has_sigmoid=activation == "sigmoid"),
        settings={"final_activation": activation},
    )
