"""What spins does so about the middle of its disc or hub; what rolls, about that of its ball."""

import math

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import place

from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Shape
from texvent_scenes.spec.scene import Motion, SceneObject
from texvent_scenes.staging.tracks.turning import axle_of

TURNED = sorted(nouns_with("flat pattern") | nouns_with("flat picture") | nouns_with("has an axle"))
ROLLING = sorted(name for name, noun in NOUNS.items() if noun.motion == "roll")


def list_hubs(model, along):
    """Middles of its cylinders about that axis, body coordinates."""
    for part in model.parts(Pose(0.0, 0.0, 0.0, "stand")):
        axis = part.to_body[:, 2] / np.linalg.norm(part.to_body[:, 2])
        if part.shape is Shape.CYLINDER and abs(axis[along]) > 0.999:
            yield float(np.linalg.norm(part.to_body[:, 0])), part.to_body[:, 3]


@for_every([(noun, late) for noun in TURNED for late in (False, True)
            if not NOUNS[noun].is_working])  # fmt: skip
def test_what_turns_about_its_front_or_width_does_so_about_its_hub(row):
    noun, late = row
    motions = (Motion("spin", rate_hz=1.3),)
    (actor,) = place(SceneObject(noun, motions=((Motion("stand"),) if late else ()) + motions))
    along = 1 if noun in nouns_with("has an axle") else 0
    hubs = [*list_hubs(actor.model, along)]
    is_round = hubs and max(hubs, key=lambda one: one[0])[0] > 0.35 * actor.model.height
    low, high = bounds(actor.model.parts(Pose(0.0, 0.0, 0.0, "stand")))
    middle = 0.5 * (low + high)
    middle[2] = low[2] + 0.5 * actor.model.height
    middle = max(hubs, key=lambda one: one[0])[1] if is_round else middle
    ways = [actor.track.at(t).to_world() @ [*middle, 1.0] for t in np.linspace(1.0, 2.0, 9)]
    turned = [actor.track.at(t).to_world()[:, :3] for t in (1.1, 1.3)]
    assert not np.allclose(*turned)
    np.testing.assert_allclose(ways, np.broadcast_to(ways[0], (9, 3)), atol=2e-3)
    lows = [actor.lowest_m(t) for t in np.linspace(1.0, 2.0, 9)]
    assert min(lows) > -0.01
    assert not is_round or max(lows) < 0.02 * actor.model.height + 0.01


@for_every(ROLLING)
def test_the_middle_of_what_rolls_goes_straight_on(noun):
    (actor,) = place(SceneObject(noun, motions=(Motion("roll", "right", speed_m_s=0.5),)))
    balls = [(float(np.linalg.norm(part.to_body[:, 0])), part.to_body[:, 3])
             for part in actor.model.parts(Pose(0.0, 0.0, 0.0, "stand"))
             if part.shape is Shape.ELLIPSOID]  # fmt: skip
    if not actor.track.radius_m or not balls:
        return
    radius, middle = max(balls, key=lambda one: one[0])
    if radius < 0.4 * actor.model.height:
        return
    ways = [actor.track.at(t).to_world() @ [*middle, 1.0] for t in np.linspace(0.2, 1.8, 9)]
    np.testing.assert_allclose(np.diff([one[2] for one in ways]), 0.0, atol=1e-4)
    assert actor.track.at(1.0).pitch == pytest.approx(
        actor.track.at(1.0).distance_m / axle_of(actor.model, "pitch").height_m
    )
    assert math.isclose(actor.track.radius_m, radius, rel_tol=0.03)
