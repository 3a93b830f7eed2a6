"""Names and shapes of the published files, as far as they are known."""

import math

import pytest

from .network_files import HEADS, shapes_like, small_shapes

pytestmark = pytest.mark.torch
pytest.importorskip("torch")


def count_parameters(shapes):
    return sum(
        math.prod(shape) for name, shape in shapes.items() if not name.endswith(("_mean", "_var"))
    )


@pytest.mark.parametrize("name", ["firenet", "firenet+"])
def test_firenet_has_the_published_24_tensors_and_37777_parameters(name):
    shapes = shapes_like(name, {})
    assert len(shapes) == 24
    assert count_parameters(shapes) == 37_777


def test_e2vid_has_the_published_10_7_million_parameters():
    assert count_parameters(shapes_like("e2vid", {})) == pytest.approx(10.71e6, rel=0.002)


def test_hyper_e2vid_differs_from_e2vid_in_its_first_decoder_alone():
    plain, hyper = small_shapes("e2vid+"), small_shapes("hypere2vid")
    different = plain.keys() ^ hyper.keys()
    assert different
    assert all(name.startswith("unetrecurrent.decoders.0.") for name in different)


@pytest.mark.parametrize("name", HEADS)
def test_shapes_follow_the_width_of_the_file(name):
    narrow, published = small_shapes(name), shapes_like(name, {})
    assert narrow.keys() == published.keys()
    assert narrow[HEADS[name]] != published[HEADS[name]]
