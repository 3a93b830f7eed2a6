"""Places on models for other things: on their boxes, and on what carries things."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.scenes.every_row import for_every
from tests.scenes.golden.rows import usual_model
from tests.scenes.raycast.intersect_reference import hit_shape_reference

from texvent_scenes.models.anchors import find_rim, has_rim, locate, top_heights
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.models.skeleton import Anchor
from texvent_scenes.rendered_scene import Shape
from texvent_scenes.staging.actors import is_centred

STILL = Pose(0.0, 0.0, 0.0, "stand")
UPWARDS = ("ground", "left foot", "seat", "left hand", "torso", "neck", "mouth", "face", "head",
           "crown")  # fmt: skip
"""Places from below to above."""


@for_every(NOUNS.values())
def test_a_body_without_limbs_has_its_places_in_its_box_from_foot_to_crown(noun):
    model = usual_model(noun)
    own = getattr(model, "anchor", lambda name, pose: None)
    if any(own(name, STILL) is not None for name in UPWARDS):
        return
    size = np.array([model.length, model.width, model.height])
    low = -0.5 * size if is_centred(noun) else -0.5 * size * [1.0, 1.0, 0.0]
    places = {name: (locate(model, name, STILL)[:, 3] - low) / size for name in UPWARDS}
    heights = [places[name][2] for name in UPWARDS]
    assert heights == sorted(heights)
    assert abs(heights[0]) < 1e-9
    assert 0.95 < heights[-1] <= 1.0
    right = (locate(model, "right hand", STILL)[:, 3] - low) / size
    left = places["left hand"]
    np.testing.assert_allclose(right + left, [2.0 * left[0], 1.0, 2.0 * left[2]], atol=1e-9)
    assert 0.6 < left[1] <= 1.0  # y is to the left
    assert 0.9 < places["mouth"][0] <= 1.0  # x is ahead


@for_every(sorted(filter(has_rim, NOUNS)))
def test_a_rim_is_as_much_larger_as_its_model(name):
    usual = find_rim(name, usual_model(NOUNS[name]))
    for scale in (0.4, 1.0, 2.5):
        found = find_rim(name, NOUNS[name].build(colour=None, scale=scale, seed=1))
        np.testing.assert_allclose(found, scale * np.array(usual))


# Steps of a micrometre: what divides by less overflows in the reference itself.
numbers = st.integers(-1_500_000, 1_500_000).map(lambda step: 1e-6 * step)


@given(
    st.lists(st.tuples(st.sampled_from(list(Shape)[:4]), *12 * [numbers]), min_size=1, max_size=4)
)
@examples(60)
def test_heights_from_above_are_where_rays_down_meet_the_parts(rows):
    parts = [ModelPart(shape, np.reshape(to_body, (3, 4)), (0, 0, 0)) for shape, *to_body in rows]
    parts = [one for one in parts if abs(np.linalg.det(one.to_body[:, :3])) > 0.05]
    x, y = (axis.ravel() for axis in np.meshgrid(*2 * [np.linspace(-2.0, 2.0, 9) + 0.013]))
    expected = np.full(x.shape, -np.inf)
    for one in parts:
        inverse = np.linalg.inv(one.to_body[:, :3])
        above = np.stack([x, y, np.full(x.shape, 50.0)], axis=1)
        origins = (above - one.to_body[:, 3]) @ inverse.T
        down = np.broadcast_to(inverse @ [0.0, 0.0, -1.0], origins.shape)
        shape = Shape.CYLINDER if one.shape is Shape.CONE else one.shape
        expected = np.maximum(expected, 50.0 - hit_shape_reference(shape, origins, down))
    found = top_heights(parts, x, y)
    is_sure = np.isfinite(found) == np.isfinite(expected)
    assert is_sure.mean() > 0.97  # rays that graze a part
    np.testing.assert_allclose(found[is_sure], expected[is_sure], atol=1e-4)


@given(st.floats(-3.2, 3.2), st.floats(-1.2, 1.2))
def test_level_axes_are_upright_and_turned_to_where_what_they_face_looks(yaw, pitch):
    forward = np.array([np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), np.sin(pitch)])
    maps = {"torso": np.column_stack([forward, np.eye(3)]), "hand": np.eye(3, 4)}
    axes = Anchor(("hand",), (1.0, 2.0, 3.0), "torso").locate(maps)
    x, y, z, place = axes.T
    assert x @ forward == pytest.approx(np.hypot(*forward[:2]))
    assert (z.tolist(), place.tolist()) == ([0.0, 0.0, 1.0], [1.0, 2.0, 3.0])
    assert np.cross(z, x) == pytest.approx(y)
    assert x @ x == pytest.approx(1.0)
