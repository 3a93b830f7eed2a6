"""What people do and wear: continuous, feet planted, hands that meet; the words for it."""

import math
from dataclasses import replace

import numpy as np
import pytest

from texvent.generation.subjects import scenes
from texvent_scenes.models.activities import ACTIVITIES, ON_GROUND, TRAVELLING
from texvent_scenes.models.people import person
from texvent_scenes.models.people.outfit import ADULT, CLOTHES, HOLDS, PROPS, put_on
from texvent_scenes.models.postures import find_track
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.skeleton import Maps
from texvent_scenes.models.tables import read_table
from texvent_scenes.read.parsing.lexicon import deeds

from ...every_row import for_every

STEP_S = 1e-3
MOVING = sorted(set(ACTIVITIES) - {"walk", "run", "jump"})
ADULT_MODEL = person.build_person(ADULT, colour=None, scale=1.0, seed=0)
PARTS = len(ADULT_MODEL.parts(Pose(0.0, 0.0, 0.0, "stand")))


BODY = person.build_body(ADULT, None, 0)
SIDES = ("left", "right")
LIMBS = [
    (f"{side} {end}", bones) for side in SIDES for end, bones in (("hand", 0.64), ("foot", 0.86))
]
"""Ends of limbs, and the lengths of their bones together."""


def joints(activity: str, time_s: float, speed: float = 0.0) -> Maps:
    return BODY.map_groups(Pose(time_s, speed * time_s, speed, activity))


def points(body: Maps, *ends: str) -> np.ndarray:
    """Root, knee or elbow, and end of limbs."""
    names = [name for end in ends or dict(LIMBS) for name in (f"upper {end}", f"lower {end}", end)]
    return np.array([body[name][:, 3] for name in names])


def test_every_activity_has_a_posture_and_every_word_one_activity():
    still = {name for name in ACTIVITIES if not find_track("activities", name).at(0.0)}
    assert still == {"walk", "run", "crawl"}
    assert set(ON_GROUND.values()) <= set(ACTIVITIES)
    assert {"walk", "run", "crawl", "swim", "surf"} <= TRAVELLING
    owners: dict[str, set[str]] = {}
    for name, activity in ACTIVITIES.items():
        for word in activity.words:
            owners.setdefault(word, set()).add(name)
    shared = {word: names for word, names in owners.items() if len(names) > 1}
    assert all(names <= {*deeds().values()} for names in shared.values()), shared  # of players


@for_every(MOVING)
def test_a_millisecond_moves_no_joint_far(activity):
    for time_s in np.arange(0.0, 5.0, 0.113):
        before, after = joints(activity, float(time_s)), joints(activity, float(time_s) + STEP_S)
        # A thrown hand moves at 12 m/s, the foot of a kick at 10 m/s.
        assert np.abs(points(after) - points(before)).max() < 0.02, time_s


@for_every(MOVING)
def test_bones_keep_their_length(activity):
    for time_s in (0.1, 0.43, 0.9, 1.7):
        for end, bones in LIMBS:
            reached = points(joints(activity, time_s), end)
            assert np.linalg.norm(np.diff(reached, axis=0), axis=1).sum() == pytest.approx(bones)


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
    turning = [joints(f"{side} arm {sense}", t) for t in np.arange(0.0, 1.0, 0.05)]
    hands = [points(body, f"{side} hand")[-1] for body in turning]
    # Who faces the person sees body y to the right and z up; clockwise angles fall.
    middle = np.mean(hands, axis=0)
    angles = np.unwrap([math.atan2(z - middle[2], y - middle[1]) for _, y, z in hands])
    assert sign * (angles[-1] - angles[0]) < -4.0


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("turn", ["counter-clockwise", "counterclockwise", "anti-clockwise"])
def test_every_spelling_of_an_arm_circle_is_understood(side, turn):
    for way in (turn, turn.replace("-", " "), turn.replace("-", "")):
        found = scenes().read(f"a man rotates the {side} arm {way}")
        assert found.not_understood == ()
        assert found.scene.objects[0].motions[0].kind == f"{side} arm counter-clockwise"


@pytest.mark.parametrize("activity", ["squat", "push-up", "box", "dance", "sweep"])
def test_feet_do_not_slide_in_place(activity):
    bodies = [joints(activity, t) for t in np.arange(0.0, 3.0, 0.05)]
    ankles = np.array([[body[f"{side} foot"][:2, 3] for side in SIDES] for body in bodies])
    assert np.ptp(ankles, axis=0).max() < 1e-6


@pytest.mark.parametrize(
    ("activity", "speed", "ends", "low_m", "duty"),
    [("walk", 1.3, ("left foot", "right foot"), 0.08, 0.60),
     ("run", 3.0, ("left foot", "right foot"), 0.08, 0.34),
     ("crawl", 0.5, ("left hand", "right hand"), 0.05, 0.60),
     ("crawl", 0.5, ("left foot", "right foot"), 0.09, 0.60)],
)  # fmt: skip
def test_feet_and_hands_of_who_goes_stay_where_they_are_set_down(
    activity, speed, ends, low_m, duty
):
    times = np.arange(0.0, 4.0, 0.004)
    bodies = [joints(activity, float(t), speed) for t in times]
    for end in ends:
        places = np.array([body[end][:, 3] for body in bodies])
        is_down = places[:, 2] < low_m + 1e-9
        assert is_down.mean() == pytest.approx(duty, abs=0.1)
        both = is_down[1:] & is_down[:-1]
        steps = np.diff(places[:, 0] + speed * times)
        assert np.abs(steps[both]).max() < 1e-9


RED, BLUE = (0.5, 0.0, 0.0), (0.0, 0.0, 0.5)


def test_every_prop_hat_and_garment_can_be_drawn():
    for props in (*PROPS.values(), *HOLDS.values()):
        assert all(prop.draw(0.3) for prop in props)
    assert set(PROPS) <= set(ACTIVITIES)
    for field, group in (("hat", "hats"), ("garments", "garments")):
        for name in read_table("outfits")[group]:
            worn = replace(ADULT, **{field: name if field == "hat" else (name,)})
            model = person.build_person(worn, colour=None, scale=1.0, seed=0)
            assert len(model.parts(Pose(0.0, 0.0, 0.0, "stand"))) > PARTS


def test_clothes_have_their_colour_or_their_usual_one():
    worn = put_on(
        ADULT, [("dress", RED, "", None), ("shoe", BLUE, "", None), ("jacket", None, "", None)]
    )
    assert (worn.dress, worn.shirts, worn.shoes, worn.has_sleeves) == ("skirt", (RED,), BLUE, True)
    assert put_on(ADULT, [("suit", None, "", None)]).trousers == tuple(CLOTHES["suit"]["usual"])
    assert put_on(ADULT, [("shirt", None, "", None)]).shirts == ADULT.shirts
    noun = next(one for one in person.NOUNS if one.name == "man")
    parts = (
        person.dress(noun, [("suit", RED, "", None)])
        .build(colour=None, scale=1.0, seed=0)
        .parts(Pose(0.0, 0.0, 0.0, "stand"))
    )
    assert sum(part.colour == RED for part in parts) >= 10
