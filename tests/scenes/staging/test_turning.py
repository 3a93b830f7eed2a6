"""What turns does so about its hub, clockwise as is said; what rolls, about that of its ball."""

import itertools
import math

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import middle, place, stage, thing

from texvent.camera import project
from texvent.sensor import SensorSize
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Shape
from texvent_scenes.spec.scene import Camera, CameraMove, Motion, SceneObject
from texvent_scenes.staging.tracks.turning import axle_of

SIZE = SensorSize(173, 130)
SENSES = {"clockwise": -1.0, "counter-clockwise": 1.0}
WORKING = [name for name in ("fan", "clock", "windmill", "ferris wheel", "spinning disc", "globe",
                             "merry-go-round", "record player", "gear", "watch movement")
           if NOUNS[name].is_working]  # fmt: skip


def axis_of(before, after):
    """[3] axis of the turn from one [3, 3] to the other, in the world; right-handed."""
    turn = after @ before.T
    return np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])


UPRIGHT = ("car", "box", "chair", "drone", "man")


@for_every(itertools.product((*UPRIGHT, "wheel", "grating", "checkerboard"), SENSES))
def test_what_spins_does_so_as_seen_from_above_or_a_wheel_or_picture_by_the_camera(row):
    noun, sense = row
    for seed in range(1 if noun in UPRIGHT else 4):
        (actor,) = stage(thing(noun, ("spin", sense)), seed=seed).actors
        a, b = (actor.track.at(t).to_world()[:, :3] for t in (1.0, 1.01))
        axis = axis_of(a, b)
        is_upright = noun in UPRIGHT or abs(axis[2]) > abs(axis[1])
        seen = axis[2] if is_upright else -axis[1]  # the camera looks along +y
        assert np.sign(seen) == SENSES[sense], seed


@for_every([(noun, sense) for noun in WORKING for sense in SENSES])
def test_what_works_turns_as_who_sees_its_front_or_top_says(row):
    noun, sense = row
    (actor,) = stage(thing(noun, ("work", sense))).actors
    a, b = (actor.own_parts(actor.pose(t)) for t in (1.0, 1.004))
    axes = [axis_of(*(each.to_body[:, :3] / np.linalg.norm(each.to_body[:, :3], axis=0)
                      for each in pair)) for pair in zip(a, b, strict=True)]  # fmt: skip
    axis = max(axes, key=np.linalg.norm)
    along = max(axis[0], axis[2], key=abs)
    assert np.sign(along) == SENSES[sense]


@pytest.mark.parametrize("noun", ["bird", "dog", "car"])
@pytest.mark.parametrize("sense", SENSES)
def test_what_goes_round_does_so_as_seen_from_above(noun, sense):
    scene = stage(thing(noun, ("orbit", sense)), thing("box"))
    one = scene.actors[0]
    a, b, c = (middle(one, t)[:2] for t in (0.6, 1.0, 1.4))
    (ax, ay), (bx, by) = b - a, c - b
    assert np.sign(ax * by - ay * bx) == SENSES[sense]


@for_every([(noun, sense) for noun in ("car", "dog", "man", "bus", "drone") for sense in
            ("clockwise", "counter-clockwise", "left", "right")])  # fmt: skip
def test_a_turn_is_the_drivers(row):
    noun, sense = row
    said = {"left": 1.0, "right": -1.0}.get(sense) or SENSES[sense]
    (actor,) = stage(thing(noun, ("turn", sense))).actors
    turned = actor.track.at(1.6).yaw - actor.track.at(0.2).yaw
    assert turned * said > 0.3


@pytest.mark.parametrize("sense", [*SENSES, "left", "right"])
@pytest.mark.parametrize("noun", ["tree", "car", "chair"])
def test_a_camera_goes_round_as_seen_from_above(noun, sense):
    # Who goes round to the right goes anticlockwise.
    said = {"left": -1.0, "right": 1.0}.get(sense) or SENSES[sense]
    scene = stage(thing(noun, ("stand",)), camera=Camera((CameraMove("orbit", sense),)))
    middle_ = middle(scene.actors[0], 1.0)[:2]
    a, b = (scene.camera(t).position[:2] - middle_ for t in (0.8, 1.2))
    assert np.sign(a[0] * b[1] - a[1] * b[0]) == said


@pytest.mark.parametrize("sense", [*SENSES, "left", "right"])
def test_a_camera_rolls_as_who_stands_behind_it_sees(sense):
    said = {"left": 1.0, "right": -1.0}.get(sense) or SENSES[sense]
    scene = stage(thing("tree"), camera=Camera((CameraMove("roll", sense),)))
    point = np.add(middle(scene.actors[0], 1.0), [1.0, 0.0, 0.0])
    angles = []
    for t in (0.8, 1.2):
        ends = project(scene.camera(t), SIZE, np.array([middle(scene.actors[0], 1.0), point]))
        (x, y) = (ends[1] - ends[0])[:2]
        angles.append(math.atan2(-y, x))
    # The picture turns the other way.
    assert np.sign(angles[1] - angles[0]) == -said


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
