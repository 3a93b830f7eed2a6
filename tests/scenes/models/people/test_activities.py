"""What people do and wear: continuous, feet planted, hands that meet; the words for it."""

import math

import numpy as np
import pytest

from texvent_scenes.models.activities import (
    ACTIVITIES,
    ON_GROUND,
    TRAVELLING,
)
from texvent_scenes.models.people import person, posture
from texvent_scenes.models.people.outfit import (
    ADULT,
    CLOTHES,
    HOLDS,
    PROPS,
    draw_parts,
    dress_person,
    put_on,
    read_table,
)
from texvent_scenes.models.people.person import find_posture
from texvent_scenes.models.people.posture import LOWER_ARM, SHIN, THIGH, UPPER_ARM, Skeleton
from texvent_scenes.models.protocol import Pose

from ...every_row import for_every

STEP_S = 1e-3
MOVING = sorted(set(ACTIVITIES) - {"walk", "run", "jump"})
ADULT_MODEL = person.build_person(ADULT, colour=None, scale=1.0, seed=0)
PARTS = len(ADULT_MODEL.parts(Pose(0.0, 0.0, 0.0, "stand")))


def pose_joints(pose: Pose) -> Skeleton:
    return posture.solve(person.choose_posture(ADULT, pose))


def joints(activity: str, time_s: float, speed: float = 0.0) -> Skeleton:
    return pose_joints(Pose(time_s, speed * time_s, speed, activity))


def points(body: Skeleton) -> np.ndarray:
    limbs = (body.shoulders, body.elbows, body.hands, body.hips, body.knees, body.ankles)
    return np.array([point for pair in limbs for point in pair])


def test_every_activity_has_a_posture_and_every_word_one_activity():
    still = {name for name in ACTIVITIES if find_posture(name, 0.0) is None}
    assert still == {"walk", "run", "crawl", "jump"}
    assert set(ON_GROUND.values()) <= set(ACTIVITIES)
    assert {"walk", "run", "crawl", "swim", "surf"} <= TRAVELLING
    owner: dict[str, str] = {}
    for name, activity in ACTIVITIES.items():
        for word in activity.words:
            assert owner.setdefault(word, name) == name, word


@for_every(MOVING)
def test_a_millisecond_moves_no_joint_far(activity):
    for time_s in np.arange(0.0, 5.0, 0.113):
        before, after = joints(activity, float(time_s)), joints(activity, float(time_s) + STEP_S)
        # A thrown hand moves at 12 m/s, the foot of a kick at 10 m/s.
        assert np.abs(points(after) - points(before)).max() < 0.02, time_s


@for_every(MOVING)
def test_bones_keep_their_length(activity):
    for time_s in (0.1, 0.43, 0.9, 1.7):
        body = joints(activity, time_s)
        for side in (0, 1):
            upper = math.dist(body.shoulders[side], body.elbows[side])
            lower = math.dist(body.elbows[side], body.hands[side])
            assert upper + lower == pytest.approx(UPPER_ARM + LOWER_ARM, abs=1e-6)
            thigh = math.dist(body.hips[side], body.knees[side])
            shin = math.dist(body.knees[side], body.ankles[side])
            assert thigh + shin == pytest.approx(THIGH + SHIN, abs=1e-6)


@for_every(MOVING)
def test_nothing_reaches_into_the_ground(activity):
    for time_s in (0.0, 0.3, 0.8, 1.4):
        body = joints(activity, time_s)
        low = -0.6 if activity == "swim" else -0.01
        assert points(body)[:, 2].min() > low
        assert len(ADULT_MODEL.parts(Pose(time_s, 0.0, 0.0, activity))) == PARTS


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("sense", "sign"), [("clockwise", 1.0), ("counter-clockwise", -1.0)])
def test_arm_circles_turn_as_the_viewer_sees_them(side, sense, sign):
    index = 0 if side == "left" else 1
    hands = [joints(f"{side} arm {sense}", t).hands[index] for t in np.arange(0.0, 1.0, 0.05)]
    # Who faces the person sees body y to the right and z up; clockwise angles fall.
    middle = np.mean(hands, axis=0)
    angles = np.unwrap([math.atan2(z - middle[2], y - middle[1]) for _, y, z in hands])
    assert sign * (angles[-1] - angles[0]) < -4.0


@pytest.mark.parametrize("activity", ["squat", "push-up", "box", "dance", "sweep"])
def test_feet_do_not_slide_in_place(activity):
    ankles = np.array([joints(activity, t).ankles for t in np.arange(0.0, 3.0, 0.05)])
    assert np.ptp(ankles[:, :, :2], axis=0).max() < 1e-6


RED, BLUE = (0.5, 0.0, 0.0), (0.0, 0.0, 0.5)


def test_every_prop_hat_and_garment_can_be_drawn():
    for props in (*PROPS.values(), *HOLDS.values()):
        assert all(prop.draw(0.3) for prop in props)
    assert set(PROPS) <= set(ACTIVITIES)
    hat = dress_person(ADULT, colour=None, seed=0).material("hat")
    for group in ("hats", "garments"):
        for name in read_table("outfits")[group]:
            assert draw_parts("outfits", group, name, hat)


def test_clothes_have_their_colour_or_their_usual_one():
    worn = put_on(ADULT, [("dress", RED), ("shoe", BLUE), ("jacket", None)])
    assert (worn.dress, worn.shirts, worn.shoes, worn.has_sleeves) == ("skirt", (RED,), BLUE, True)
    assert put_on(ADULT, [("suit", None)]).trousers == tuple(CLOTHES["suit"]["usual"])
    assert put_on(ADULT, [("shirt", None)]).shirts == ADULT.shirts
    noun = next(one for one in person.NOUNS if one.name == "man")
    parts = (
        person.dress(noun, [("suit", RED)])
        .build(colour=None, scale=1.0, seed=0)
        .parts(Pose(0.0, 0.0, 0.0, "stand"))
    )
    assert sum(part.colour == RED for part in parts) >= 10
