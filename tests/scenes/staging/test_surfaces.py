"""Materials that a scene names."""

import pytest

from texvent.errors import InputError
from texvent.scenes.models.materials import in_material
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.scene import Texture


def test_an_object_is_made_of_what_is_said():
    usual = NOUNS["car"].build(colour=None, scale=1.0, seed=0)
    pose = Pose(0.0, 0.0, 0.0, "stand")
    parts = in_material(usual, "wood", None).parts(pose)
    assert {part.texture for part in parts if part.emission == 0.0} == {Texture.WOOD}
    painted = in_material(usual, "wood", (0.1, 0.2, 0.6)).parts(pose)
    colours = [part.colour for part in usual.parts(pose)]
    assert [part.colour for part in painted] == colours
    assert in_material(usual, None, None) is usual
    with pytest.raises(InputError, match="unknown material 'cheese'; known: wood"):
        in_material(usual, "cheese", None)
