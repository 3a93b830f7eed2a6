"""The three published layouts: sizes as published, recognised from shapes alone."""

from math import prod

import pytest

from texvent.interpolate.rife.layouts import (
    LAYOUTS,
    RIFE_4_0,
    RIFE_4_6,
    RIFE_4_25,
    recognise_layout,
)


@pytest.mark.parametrize(
    ("layout", "tensors", "parameters", "inputs", "pad_to"),
    [
        (RIFE_4_0, 128, 5_160_980, (7, 12), 32),
        (RIFE_4_6, 120, 5_306_256, (7, 12), 32),
        (RIFE_4_25, 158, 5_664_776, (15, 28), 64),
    ],
)
def test_layouts_have_the_published_sizes(layout, tensors, parameters, inputs, pad_to):
    shapes = layout.tensor_shapes()
    assert len(shapes) == tensors
    assert sum(prod(shape) for shape in shapes.values()) == parameters
    assert (layout.input_channels(0), layout.input_channels(1)) == inputs
    assert layout.pad_to == pad_to


@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: layout.name)
def test_a_layout_is_recognised_beside_a_teacher_and_other_networks(layout):
    more = {"block_tea.conv0.0.0.weight": (45, 16, 3, 3), "unet.conv0.weight": (1,)}
    assert recognise_layout({**layout.tensor_shapes(), **more}) is layout


@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: layout.name)
def test_a_missing_added_or_changed_tensor_is_not_recognised(layout):
    shapes = layout.tensor_shapes()
    name = "block1.conv0.0.0.weight"
    missing = {other: shape for other, shape in shapes.items() if other != name}
    assert recognise_layout(missing) is None
    assert recognise_layout({**shapes, name: (1, 2, 3, 3)}) is None
    assert recognise_layout({**shapes, "block9.conv0.0.0.weight": (1,)}) is None
    assert recognise_layout({}) is None
