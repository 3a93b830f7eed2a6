"""Motions: continuous, physical, of the stated speed, and what sequences of them come to."""

import itertools
import math
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.scenes.every_row import for_every
from tests.scenes.golden.rows import usual_model
from tests.scenes.staged import stage, thing

from texvent_scenes.defaults import decide_motions
from texvent_scenes.models.activities import ACTIVITIES
from texvent_scenes.models.nouns import AFLOAT, MOTIONS, NOUNS, VARIANTS
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.spec.scene import Direction, Motion, SceneObject
from texvent_scenes.staging.tracks.choose_track import choose_track
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, Key, bounce_height
from texvent_scenes.staging.tracks.motion_plan import plan_motion
from texvent_scenes.staging.tracks.phase_keys import build_path
from texvent_scenes.staging.tracks.phases import PATH_KINDS, schedule
from texvent_scenes.staging.tracks.track import BodyState, Term, Track, seated, state_of, steady

TIMES_S, HOME = np.linspace(0.0, 2.0, 5), (0.0, 0.0, 0.0)
KINDS = ("drive", "walk", "run", "fly", "turn", "reverse", "spin", "rise", "sink",
         "jump", "bounce", "fall", "topple", "stand", "sit", "sway", "hover")  # fmt: skip
DIRECTIONS = (None, "left", "right", "towards", "away", "backward", "around", "up")
motions = st.builds(
    Motion, st.sampled_from(KINDS), st.sampled_from(DIRECTIONS),
    st.sampled_from([0.5, 1.0, 2.0]), end_pace=st.sampled_from([None, None, 0.0, 2.0]),
)  # fmt: skip
keys = st.builds(
    Key, st.floats(0.2, 2.0), st.floats(-4.0, 9.0), st.floats(-3.0, 3.0), st.floats(-1.0, 1.0),
    st.floats(0.05, 1.0), hop_m=st.sampled_from([0.0, 0.0, 0.3]),
    restitution=st.sampled_from([None, None, 0.3]), pitch_rad=st.sampled_from([0.0, 0.0, 1.5]),
)  # fmt: skip
tracks = st.builds(
    lambda yaw, speed, following: Track(
        (1.0, 2.0, 0.5), yaw, (Key(0.0, speed), *following), usual_speed_m_s=1.0, floor_m=0.0
    ),
    st.floats(-3.0, 3.0), st.floats(-3.0, 9.0), st.lists(keys, min_size=1, max_size=4),
)  # fmt: skip


def path_of(*sequence, noun="car", speed=4.0, duration_s=4.0):
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    return build_path(
        sequence, NOUNS[noun], model, yaw=0.0, stated_m_s=speed, duration_s=duration_s
    )


def test_motions_share_the_clip_evenly_and_stated_times_are_kept():
    sequence = [Motion("walk"), Motion("jump", start_s=2.0), Motion("sit")]
    assert [phase.start_s for phase in schedule(sequence, 6.0)] == [0.0, 2.0, 4.0]
    waiting = schedule([Motion("walk", start_s=1.5)], 2.0)
    assert [(p.motion.kind, p.start_s) for p in waiting] == [("stand", 0.0), ("walk", 1.5)]


@given(
    st.lists(motions, min_size=1, max_size=4),
    st.sampled_from(["car", "man", "helicopter", "dog", "fish", "table"]),
    st.floats(0.0, 4.0),
    st.floats(0.5, 4.0),
)
def test_sequences_are_continuous(sequence, noun, time_s, duration_s):
    path = path_of(*sequence, noun=noun, duration_s=duration_s)
    assert path.duration_s == pytest.approx(duration_s)
    edges = np.cumsum([key.duration_s for key in path.keys])
    for instant in (time_s, *(edges - 5e-4)):
        before, after = path.at(float(instant)), path.at(float(instant) + 1e-3)
        assert np.abs(np.subtract(after.position, before.position)).max() < 0.05
        assert abs(after.yaw - before.yaw) < 0.2
        assert abs(after.speed_m_s - before.speed_m_s) < 1.0


@for_every([*itertools.product(sorted(PATH_KINDS | {"bounce", "throw"}), ("car", "man", "ball"))])
def test_what_goes_one_way_is_at_home_at_mid_clip(row):
    """So it is in view before and after: half of its way lies behind its place."""
    kind, name = row
    noun, home = NOUNS[name], (3.0, -2.0, 0.5)
    model = NOUNS[name].build(colour=None, scale=1.0, seed=0)
    for way in ("left", "right", "towards", "away"):
        rng = np.random.default_rng(0)
        plan = plan_motion([Motion(kind, way)], noun, model, 3.0, rng)
        track = replace(choose_track(plan, model, home, rng), terms=())
        begin, middle, end = (np.array(track.at(t).position[:2]) for t in (0.0, 1.5, 3.0))
        if plan.path is None and plan.gesture is None:
            assert middle == pytest.approx(home[:2], abs=1e-6)
            assert begin + end == pytest.approx(2.0 * middle, abs=1e-6)
            assert np.hypot(*(end - begin)) > 0.1


@given(st.floats(0.5, 20.0))
def test_stated_speeds_are_exact(speed):
    kinds = [Motion("drive", speed_m_s=speed), Motion("turn", "left", speed_m_s=speed)]
    for time_s in (0.3, 1.0, 3.0):
        assert path_of(*kinds).at(time_s).speed_m_s == pytest.approx(speed, rel=1e-12)


@pytest.mark.parametrize(("pace", "speed"), [(2.0, 8.0), (0.0, 0.0)])
def test_accelerating_and_braking_end_at_the_end_pace(pace, speed):
    path = path_of(Motion("drive", end_pace=pace))
    assert (path.at(0.0).speed_m_s, path.at(4.0).speed_m_s) == (4.0, speed)


def test_an_airplane_takes_off_along_a_runway_and_lands_on_it():
    off, down = (path_of(Motion(kind), noun="airplane", speed=20.0) for kind in ("rise", "sink"))
    assert off.at(1.0).position[2] == 0.0
    assert off.at(4.0).position[2] > 5.0
    assert off.at(4.0).pitch < -0.1
    assert down.at(0.0).position[2] > 3.0
    assert down.at(4.0).position[2] == pytest.approx(0.0, abs=0.1)


@given(tracks, st.floats(-0.5, 9.0))
def test_position_heading_and_speed_are_continuous(path, time_s):
    for instant in [time_s, *(knot.time_s - 5e-4 for knot in path._knots)]:
        before, after = path.at(instant), path.at(instant + 1e-3)
        assert np.abs(np.subtract(after.position, before.position)).max() < 0.03
        assert abs(after.yaw - before.yaw) < 0.01
        assert abs(after.speed_m_s - before.speed_m_s) < 0.5
        assert abs(after.distance_m - before.distance_m) < 0.02


@given(tracks, st.floats(0.0, 5.0))
def test_the_velocity_is_the_speed_along_the_heading(path, time_s):
    before, middle, after = (path.at(time_s + step) for step in (-1e-5, 0.0, 1e-5))
    velocity = np.subtract(after.position, before.position)[:2] / 2e-5
    signed = (after.distance_m - before.distance_m) / 2e-5
    heading = np.array([math.cos(middle.yaw), math.sin(middle.yaw)])
    np.testing.assert_allclose(velocity, signed * heading, atol=2e-3)
    assert abs(signed) == pytest.approx(middle.speed_m_s, abs=1e-2)


@for_every(sorted(MOTIONS | set(ACTIVITIES)))
def test_who_does_anything_covers_the_way_that_is_seen(kind):
    """So limbs and wheels move as their body does, whatever it is and wherever it goes."""
    bodies, times = ("car", "man", "dog", "airplane", "ball", "boat"), np.linspace(0.0, 1.0, 21)
    for number, way in [*enumerate(get_args(Direction))][len(kind) % 3 :: 3]:
        noun, rng = NOUNS[bodies[(number + len(kind)) % len(bodies)]], np.random.default_rng(5)
        said = decide_motions((Motion(kind, way), Motion(kind, way, end_pace=0.5)), noun)
        model = usual_model(noun)
        track = choose_track(plan_motion(said, noun, model, 1.0, rng), model, HOME, rng)
        states = [replace(track, terms=()).at(float(t)) for t in times]
        axes = 3 if any(key.swing_hz for key in track.keys) else 2
        ways = np.diff([one.position[:axes] for one in states], axis=0)
        covered = np.abs(np.diff([one.distance_m for one in states]))
        np.testing.assert_allclose(covered, np.linalg.norm(ways, axis=1), rtol=0.03, atol=5e-3)


STRAIGHT = steady((5.0, 2.0, 0.0), math.pi, 4.0)
TRACKS = {
    "rest": steady((1.0, 2.0, 0.0), 0.0),
    "straight": STRAIGHT,
    "weaving": replace(
        steady((0.0, 0.0, 2.0), 0.3, 1.0, climb=0.4), terms=(Term("yaw", 0.1, 0.7, 0.3),)
    ),
    "rolling": replace(steady(HOME, 0.0, 2.0), radius_m=0.25),
    "to and fro": Track(HOME, 0.5, (Key(1.0, 2.8, activity="run", swing_hz=0.3),)),
    "circle": steady((2.0, 0.0, 1.0), -0.5 * math.pi, 3.0, turn_rad_s=-1.5),
    "spin": Track(HOME, terms=(Term("yaw", drift=3.0, gain=0.2),)),
    "axle": Track(HOME, terms=(Term("pitch", drift=3.0),), pivot_m=0.5),
    "bounce": Track(
        (0.0, 0.0, 1.5), keys=(Key(0.0, 0.5), Key(1.0, 0.5, restitution=0.8)), floor_m=0.0
    ),
    "throw": Track(
        (0.0, 0.0, 1.0), 0.4,
        (Key(0.3), Key(1.0, 2.2, climb_m_s=4.0, ramp_s=0.0, restitution=0.6)),
        (Term("pitch", drift=3.0, offset=-0.9, begin_s=0.3),), floor_m=0.0, pivot_m=0.2,
    ),
    "hover": Track((0.0, 0.0, 2.0), terms=(Term("x", 0.12, 0.23), Term("z", 0.2, 0.4, 0.1))),
    "riding": seated(STRAIGHT, (0.0, 0.0, 1.0), "sit"),
}  # fmt: skip


@pytest.mark.parametrize("name", TRACKS)
def test_a_body_never_jumps_and_its_distance_grows(name):
    times = np.linspace(0.0, 6.0, 1201)
    states = [TRACKS[name].at(float(t)) for t in times]
    maps = np.array([state.to_world() for state in states])
    assert np.abs(np.diff(maps, axis=0)).max() / times[1] < 14.0
    distance = np.array([state.distance_m for state in states])
    assert np.all(np.diff(distance) >= -1e-12)


NOT_SO = {"skier", "surfer", "skateboarder", "windsock"}
"""Who falls over the tip of a board, in snow or water, and what the wind blows about."""
FALLING = [one for one in NOUNS.values() if one.habitat == "fixed" or (
           one.habitat == "ground" and one.motion in ("walk", "drive"))][::3]  # fmt: skip


@for_every(FALLING)
def test_what_falls_over_turns_on_its_edge_or_side_and_lies_on_the_ground(noun):
    model = usual_model(noun)
    is_low = noun.habitat == "fixed" and model.height < model.length
    if is_low or noun.name in NOT_SO | nouns_with("flat pattern"):
        return
    (actor,) = stage(thing(noun.name, *([("move",)] * (len(noun.name) % 2)), ("topple",))).actors
    sinks_m = 0.5 * model.length if noun.name in nouns_with("falls over") else 0.0
    lows = np.array([actor.lowest_m(time_s) for time_s in TIMES_S[::2]])
    assert lows.min() > -sinks_m - 0.1 * model.height - 0.01
    assert lows[-1] < 0.1 * model.height + 0.01
    assert actor.corners(2.0)[:, 2].max() < 1.1 * max(actor.model.length, actor.model.width)


@given(*2 * [st.tuples(*3 * [st.floats(-1.5, 1.5)])], st.floats(0.0, 2.0))
def test_a_state_is_that_of_its_map_about_any_pivot(place, turns, pivot_m):
    said = BodyState(place, *turns, pivot_m=pivot_m)
    found = state_of(said.to_world(), pivot_m)
    for name in ("position", "yaw", "pitch", "roll"):
        assert getattr(found, name) == pytest.approx(getattr(said, name), abs=1e-6)


@pytest.mark.parametrize("noun", ["ball", "car", "book", "cat"])
def test_what_is_low_or_round_does_not_fall_from_the_ground(noun):
    states = [path_of(Motion("move"), Motion("fall"), noun=noun).at(t) for t in (0.0, 3.0, 4.0)]
    assert {(one.position[2], one.pitch) for one in states} == {(0.0, 0.0)}


@pytest.mark.parametrize(("seat", "posture"), [(None, "sit on ground"), ("chair", "sit")])
@pytest.mark.parametrize("act", ["read", "drink", "wave"])
def test_who_sits_goes_on_sitting_while_acting(seat, posture, act):
    bodies = (thing("man", ("sit",), (act,)), *((thing(seat, ("stand",)),) if seat else ()))
    man = stage(*bodies, relations=(("on", 0, 1),) if seat else ()).actors[0]
    assert {man.pose(t).activity.partition(" and ")[0] for t in TIMES_S} == {posture}
    assert man.pose(1.9).activity == f"{posture} and {act}"


@pytest.mark.parametrize(
    ("rounds", "height"),
    [(0.5, 0.75), (1.0, 0.0), (1.8, 0.64), (1.0 + 1.6 + 0.64, 0.64**2), (200.0, 0.0)],
)
def test_a_bouncing_ball_falls_freely_and_keeps_its_restitution(rounds, height):
    landing = math.sqrt(2.0 * 1.25 / GRAVITY_M_S2)
    found = bounce_height(1.25, 0.0, 0.8, landing * rounds)
    assert found == pytest.approx(1.25 * height, abs=1e-12)


@pytest.mark.parametrize(
    ("noun", "said"),
    [("disc", (("move", "left"), ("move", "right"))), ("grating", (("orbit",),)),
     ("barcode", (("spin",),)), ("checkerboard", (("slide", "to and fro"),)),
     ("disc", (("rise",),))],
)  # fmt: skip
def test_a_flat_pattern_faces_the_camera_all_along(noun, said):
    path = stage(thing(noun, *said), place=None, duration_s=1.0).actors[0].track
    fronts = [path.at(time).to_world()[:, 0] for time in (0.0, 0.3, 0.7, 1.0)]
    np.testing.assert_allclose(fronts, np.tile([0.0, -1.0, 0.0], (4, 1)), atol=1e-9)


@pytest.mark.parametrize("way", ["to and fro", "up and down"])
@pytest.mark.parametrize(
    ("noun", "kind", "after"),
    [("checkerboard", "move", "tilt"), ("drone", "fly", "spin"), ("fish", "swim", "sway"),
     ("ball", "move", "jump")],
)  # fmt: skip
def test_what_goes_to_and_fro_before_it_does_something_else_swings_until_then(
    noun, kind, after, way
):
    first = Motion(kind, way, rate_hz=1.5, speed_m_s=0.6)
    body = stage(SceneObject(noun, motions=(first, Motion(after, start_s=1.0)))).actors[0]
    times = np.linspace(0.0, 1.0, 21)
    places = np.array([body.track.at(time).position for time in times])
    # A stated speed is the greatest one: of 0.6 m/s at 1.5 Hz, 64 mm to either side.
    swing = 0.6 / (3.0 * math.pi) * np.sin(3.0 * math.pi * times)
    moved = places - places[0]
    axis = (
        moved[:, 2]
        if way == "up and down"
        else moved[:, :2] @ (moved[3, :2] / np.linalg.norm(moved[3, :2]))
    )
    np.testing.assert_allclose(axis, swing, atol=1e-6)


@pytest.mark.parametrize(("said", "sign"), [("right", 1), ("left", -1), (None, 1)])
def test_a_grating_drifts_where_it_is_told_to(said, sign):
    (does,) = decide_motions((Motion("move", said),), NOUNS["grating"])
    actor = stage(thing("grating", (does.kind, does.direction)), place=None).actors[0]
    placed = [actor.place(time) for time in (1.0, 1.1)]
    to_right = [
        [(one.to_world[:, :3] @ part.to_body[:, 3])[0] for part in one.parts] for one in placed
    ]
    drift = np.diff(to_right, axis=0)[0, 2:-1]  # bars that no edge of the board cuts
    size = actor.model.height / 1.2
    np.testing.assert_allclose(drift, sign * 0.0216 * size, rtol=1e-6)


def _heights(noun, motion, place):
    motions = decide_motions((motion,), NOUNS[noun])
    actor, *_ = stage(SceneObject(noun, motions=motions), place=place).actors
    corners = np.array([actor.corners(time_s)[:, 2] for time_s in TIMES_S])
    return corners.min(axis=1), corners.max(axis=1)


@pytest.mark.parametrize("noun", sorted(AFLOAT - VARIANTS.keys()))
def test_what_floats_on_water_does_not_rise_out_of_it(noun):
    low, high = _heights(noun, Motion("hover"), "lake")
    assert np.ptp(low + high) < 0.1 * float(high.max() - low.min())


@pytest.mark.parametrize("noun", ["dog", "horse", "cat", "elephant", "rabbit"])
def test_what_has_legs_swims_with_its_back_above_the_water(noun):
    for place in ("lake", "river"):
        low, high = _heights(noun, Motion("swim"), place)
        assert low.max() < -0.3 * float(np.max(high - low))
        assert high.min() > 0.0


@pytest.mark.parametrize("noun", sorted(nouns_with("flat pattern")))
@pytest.mark.parametrize(("way", "sign"), [("up", 1.0), ("down", -1.0)])
def test_a_flat_pattern_goes_up_and_down_in_its_own_plane(noun, way, sign):
    low, _ = _heights(noun, Motion("slide", way), "plain")
    assert sign * (low[-1] - low[0]) > 0.05
