"""Bodies given as data, and what animals do in their place: joints, legs, mouths."""

import tomllib

import numpy as np
import pytest
from tests.scenes.every_row import for_every

from texvent.errors import FileFormatError
from texvent_scenes.models.activities import ANIMAL_ACTIVITIES, MOUTH_ACTIVITIES, limbs_of
from texvent_scenes.models.joints import Instant, read_cycle
from texvent_scenes.models.materials import BLACK
from texvent_scenes.models.nouns import FAMILIES, NOUNS, VARIANTS
from texvent_scenes.models.parts import PartsBuilder
from texvent_scenes.models.protocol import Model, Pose
from texvent_scenes.models.shapes import bounds

STILL = Pose(0.0, 0.0, 0.0, "stand")


def build(text: str) -> Model:
    return PartsBuilder("dodo", tomllib.loads(text))(colour=None, scale=1.0, seed=3)


def middles(model: Model, pose: Pose) -> np.ndarray:
    return np.array([part.to_body[:, 3] for part in model.parts(pose)])


def test_a_cycle_counts_seconds_metres_or_strides():
    now = Instant(Pose(0.5, 3.0, 1.0), 0, strides=2.5)
    assert read_cycle(["2hz"])(now) == pytest.approx(1.0)
    assert read_cycle(["1.5/m", "from", ".25"])(now) == pytest.approx(4.75)
    assert read_cycle(["2step"])(now) == pytest.approx(5.0)
    begun = {read_cycle(["2hz", "start", "flap"])(Instant(now.pose, seed)) for seed in range(5)}
    assert len(begun) == 5


LEGS = """
colours = { paint = ["(.3 .2 .1)"] }
gait = { stride = 1.0, duty = 0.6, lift = 0.1 }
body = "shift 0 0 .05 by step, sway z .05 2step from -.25 by step"
parts = "ball paint   0 0 1   1 .4 .4"
[[legs]]
surface = "paint"
pairs = '''
.3 .2 .8   .3 .2   0
-.3 .2 .8   -.3 .2   .5
'''
bones = [0.5, 0.5]
radii = [0.05, 0.04]
towards = [1.0, 0.0, 0.0]
foot = "ball paint   0 0 0   .1 .1 .1"
"""


def test_a_foot_on_the_ground_does_not_slide():
    model = build(LEGS)
    distances = np.linspace(0.0, 1.0, 101)
    feet = np.array([middles(model, Pose(0.0, d, 2.0))[3::3] for d in distances])
    assert feet.shape[1] == 4
    in_world = feet[..., 0] + distances[:, None]
    stays = (feet[:-1, :, 2] < 1e-9) & (feet[1:, :, 2] < 1e-9)
    assert stays.mean() > 0.5
    assert np.abs(np.diff(in_world, axis=0)[stays]).max() < 1e-9
    np.testing.assert_allclose(feet[0, ::2, 1], -feet[0, 1::2, 1])
    np.testing.assert_allclose(middles(model, STILL)[3::3, 2], 0.0)


def parts_at(noun: str, act: str, time_s: float) -> list:
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    return list(model.parts(Pose(time_s, 0.0, 0.0, act)))


QUIET = ("sleep", "curl up", "watch")
"""Acts of who only breathes, or turns its head a little."""
OF_THINGS = ("open", "close", "closed", "show", "turn")


@pytest.mark.long
@pytest.mark.parametrize("noun", ["dog", "horse", "bird", "ostrich"])
def test_an_act_moves_parts_smoothly_and_not_into_the_ground(noun):
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    size, ground = model.height, bounds(parts_at(noun, "stand", 0.0))[0][2]
    acts = NOUNS[noun].acts - {"glide"}
    of_things = {one for one in ANIMAL_ACTIVITIES if {*one.split()} & {*OF_THINGS}}
    on_legs = frozenset(ANIMAL_ACTIVITIES) - of_things - {"clap", "glide"}  # of other limbs
    assert acts in (on_legs, MOUTH_ACTIVITIES, MOUTH_ACTIVITIES | {"dance in place", "shake off"})
    for act in acts:
        start, moved = parts_at(noun, act, 0.0), 0.0
        for time_s in np.arange(0.0, 2.0, 0.21):
            now, next_ = (
                np.array([part.to_body for part in model.parts(Pose(t, 0.0, 0.0, act))])
                for t in (time_s, time_s + 1e-3)
            )
            assert np.abs(now - next_).max() < 0.02 * size
            assert bounds(parts_at(noun, act, time_s))[0][2] > ground - 0.4 * size
            first = np.array([part.to_body for part in start])
            moved = max(moved, float(np.abs(now - first).max()))
        assert moved > (0.0 if act in QUIET else 0.02) * size


CROW = """
acts = "animal_activities"
sizes = { leg = ".5*height", height = 2 }
body = "shift 0 0 {leg} by sit"
colours = { coat = ["(.1 .1 .1)"] }
with = ["crest"]
anchors = { mouth = "head {height/4} 0 0" }
parts = '''
ball coat   0 0 {leg}   1 1 1
moving called head, shift 0 0 {height}, turn y 0 0 0 90deg by down
ball coat   .5 0 0   1 1 1
moving on head, shift 1 0 0
ball coat   0 0 0   1 1 1'''
[options]
crest = "ball red   0 0 {max(height,leg)+sin(0)}   1 1 1"
none = "ball red   0 0 9   1 1 1"
[surfaces]
red = "(1 0 0)"
"""


def test_joints_follow_channels_and_parts_what_they_are_on():
    model = build(CROW)
    body, crest, head, tip = middles(model, STILL)
    assert (body[2], crest[2]) == (1.0, 2.0)
    np.testing.assert_allclose([head, tip], [[0.5, 0, 2], [1, 0, 2]])
    sitting = middles(model, Pose(0.0, 0.0, 0.0, "sit"))
    np.testing.assert_allclose(sitting - middles(model, STILL), [[0, 0, 1]] * 4)
    down = middles(model, Pose(0.5 / 1.1, 0.0, 0.0, "peck"))
    np.testing.assert_allclose(down[2:], [[0, 0, 1.5], [0, 0, 1]], atol=1e-9)
    anchor = model.anchor("mouth", Pose(0.5 / 1.1, 0.0, 0.0, "peck"))
    np.testing.assert_allclose(anchor[:, 3], [0, 0, 1.5], atol=1e-9)


def test_only_an_animal_of_its_own_colour_has_usual_more():
    black, blue = (
        NOUNS["cow"].build(colour=colour, scale=1.0, seed=0) for colour in (None, (0.0, 0.0, 0.5))
    )
    spots = [sum(part.colour == BLACK for part in one.parts(STILL)) for one in (black, blue)]
    assert spots[0] == spots[1] + 7


@pytest.mark.parametrize(
    ("formula", "message"),
    [
        ("height+", "invalid syntax"),
        ("width", "known: numbers, height"),
        ("open(1)", "known"),
        ("height/0", "division"),
        ("height.real", "known"),
    ],
)
def test_a_bad_formula_is_named(formula, message):
    text = f'sizes = {{ height = 2 }}\nparts = "ball red   0 0 {{{formula}}}   1 1 1"'
    with pytest.raises(FileFormatError, match=message) as caught:
        build(text)
    assert repr(formula) in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("by down", "by dwon", "no channel 'dwon'; known: aim.0, aim.1"),
        ('"crest"', '"crown"', "known: crest, none"),
        ('"head {height/4}', '"haed {height/4}', "must be on one of ground, head"),
    ],
)
def test_a_name_that_nothing_has_is_refused(old, new, message):
    with pytest.raises(FileFormatError, match=message):
        build(CROW.replace(old, new))


def test_sizes_that_wait_for_each_other_are_named():
    with pytest.raises(FileFormatError, match="no number is given for: a, b"):
        build('sizes = { a = "b", b = "2*a" }')


@for_every(FAMILIES["quadrupeds"])
def test_four_legged_animals_eat_low_and_sit_with_their_heads_up(noun):
    model = noun.build(colour=None, scale=1.0, seed=0)
    stands, eats, sits = (
        model.anchor("mouth", Pose(0.2, 0.0, 0.0, act)) for act in ("stand", "graze", "sit")
    )
    assert eats[2, 3] < 0.9 * stands[2, 3]
    assert sits[2, 3] > eats[2, 3]


@pytest.mark.parametrize("noun", ["horse", "dog", "zebra"])
def test_diagonal_legs_step_together_in_a_trot_alone(noun):
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    for activity in ("trot", "run", "walk"):
        poses = [Pose(0.0, 0.13 * one, 4.0, activity) for one in range(40)]
        feet = np.array([[part.to_body[2, 3] for part in model.parts(one)[-10::3]]
                         for one in poses])  # fmt: skip
        left, right, rear_left, rear_right = feet.T
        is_together = np.allclose(left, rear_right) and np.allclose(right, rear_left)
        assert is_together == (activity == "trot")
        assert not np.allclose(left, right)


SLEEPERS = sorted(name for name, one in NOUNS.items() if {"sleep", "graze"} <= one.acts)


@for_every(SLEEPERS)
def test_who_sleeps_has_its_head_lower_than_who_stands_or_lies_awake(noun):
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    asleep, awake, up = (
        model.anchor("mouth", Pose(0.0, 0.0, 0.0, act))[2, 3] for act in ("sleep", "lie", "stand")
    )
    assert asleep <= awake < up
    assert asleep >= min(awake, 0.0) - 0.15 * model.height


def test_only_flippers_clap_and_only_who_turns_its_head_looks_around():
    clapping = {name for name, one in NOUNS.items() if "clap" in one.acts}
    assert clapping == {"seal"}
    assert "look around" in NOUNS["owl"].acts
    assert "look around" not in NOUNS["duck"].acts


def test_limbs_of_acts_with_keys_are_needed_too():
    assert {"left_paw_ahead", "right_paw_ahead"} <= limbs_of("stretch")
    assert "stretch" not in NOUNS["parrot"].acts


def extents_m(noun: str, *poses: Pose) -> np.ndarray:
    """Greatest extents of a noun at some poses, along x, y and z."""
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    return np.max([np.ptp(bounds(model.parts(pose)), axis=0) for pose in poses], axis=0)


WINGED = sorted({*VARIANTS.values()} & {name for name, one in NOUNS.items() if "glide" in one.acts})
"""Birds that float or walk, of which sentences say that they fly."""


@for_every(WINGED)
def test_a_bird_that_flies_lies_along_its_way_with_its_wings_spread(noun):
    beat = [Pose(at, 0.0, 5.0, "fly") for at in np.linspace(0.0, 0.6, 7)]
    span, rest = extents_m(f"flying {noun}", *beat), extents_m(noun, STILL)
    assert span[1] > 1.7 * rest[1] or noun == "peacock"  # whose fan is spread at rest
    model = NOUNS[f"flying {noun}"].build(colour=None, scale=1.0, seed=0)
    body = np.array([np.ptp(bounds([one]), axis=0) for one in model.parts(beat[0])])[0]
    assert body[0] > 1.2 * body[2]  # the trunk lies along x
    assert span[1] > 3.0 * body[1]
    tips = [float(bounds(model.parts(one))[1][2]) for one in beat]
    assert np.ptp(tips) > 0.1 * span[1]


@for_every(sorted({name for name, one in NOUNS.items() if "glide" in one.acts} - {*WINGED}))
def test_who_glides_keeps_its_wings_spread_and_still(noun):
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    shapes = {(act, at): np.array([one.to_body for one in model.parts(Pose(at, 0.0, 5.0, act))])
              for act in ("glide", "fly") for at in (0.2, 0.27)}  # fmt: skip
    assert np.allclose(shapes["glide", 0.2], shapes["glide", 0.27])
    assert not np.allclose(shapes["fly", 0.2], shapes["fly", 0.27])
    wide_m = np.ptp(bounds(model.parts(Pose(0.2, 0.0, 5.0, "glide"))), axis=0)[1]
    assert wide_m > 0.9 * model.width


@for_every(range(6))
def test_brick_walls_are_red_and_white_walls_are_white(seed):
    rest = Pose(0.0, 0.0, 0.0, "stand")
    red, _, blue = (
        NOUNS["brick wall"].build(colour=None, scale=1.0, seed=seed).parts(rest)[0].colour
    )
    assert red > 2.5 * blue
    for noun in ("wall", "inner wall", "plain wall"):
        parts = NOUNS[noun].build(colour=(0.9, 0.9, 0.9), scale=1.0, seed=seed).parts(rest)
        size = [abs(np.linalg.det(one.to_body[:, :3])) for one in parts]
        assert np.average([min(one.colour) for one in parts], weights=size) > 0.8
