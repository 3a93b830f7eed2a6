"""Lamps, suns, gates and sparks that a prompt names, and that the image must have."""

import numpy as np
import pytest
from tests.scenes.test_short_prompts import report, staged

from texvent_scenes.models.shapes import bounds


@pytest.mark.parametrize(
    ("text", "word", "is_seen"),
    [("a bus driving to the right at night with its headlights on", "with its headlights on", True),
     ("a truck coming towards the camera at night with headlights", "with headlights", True),
     ("a car driving away at night with headlights on", "with headlights on", False),
     ("low sun over a field", "low sun", False),
     ("the sun hangs low above the sea", "sun hangs low", False),
     ("quadcopter flying fast through racing gates", "through", True),
     ("a dog running through three hoops", "through", True),
     ("a car driving through two gates", "through", True),
     ("a camera driving out of a tunnel into sunlight", "out of", True)],
)  # fmt: skip
def test_what_is_named_is_shown_only_where_the_image_has_it(text, word, is_seen):
    assert (word in report(text).shown) is is_seen


@pytest.mark.parametrize(
    "text", ["sparks flying off an angle grinder", "sparks fly from a table saw",
             "sparks fly off an angle grinder"],
)  # fmt: skip
def test_sparks_leave_the_part_of_a_tool_that_goes_round(text):
    scene = staged(text)[0]
    (emitter, *_), (tool, *_) = scene.particles.effects, scene.actors
    start = emitter.source.at(np.array([1.0]))[0]
    first, later = (tool.place(at) for at in (1.0, 1.02))
    moved = [one.to_body[:, 3] for one, other in zip(first.parts, later.parts, strict=True)
             if not np.allclose(one.to_body, other.to_body)]  # fmt: skip
    places = np.array(moved) @ first.to_world[:, :3].T + first.to_world[:, 3]
    assert np.linalg.norm(places - start, axis=1).min() < 0.6 * tool.size_m


@pytest.mark.parametrize("place", ["kitchen", "garage", "library"])
def test_a_lamp_in_a_room_has_a_cord_up_to_the_ceiling_that_is_drawn(place):
    scene, said, _ = staged(f"a person walking in a {place} below a ceiling lamp")
    (cord, _), ceiling_m = scene.threads[0], scene.environment(0.0).ceiling_m
    boxes = np.array([bounds([part]) for part in cord.parts])
    lamp = next(one for one in scene.actors if one.noun.name == "ceiling lamp")
    assert ceiling_m < 20.0
    np.testing.assert_allclose(boxes[:, 1, 2].max(), ceiling_m)
    assert boxes[:, 0, 2].min() < lamp.corners(0.0)[:, 2].max()
    assert not any("hanging" in one for one in said.not_shown)
