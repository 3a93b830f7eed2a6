"""What works or switches does so at stated times; belts take along what is on them."""

import itertools
from contextlib import nullcontext

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import place

from texvent.errors import ConfigError
from texvent_scenes.models.activities import ACTIVITIES, ANIMAL_ACTIVITIES
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.scene_input import describe_scene
from texvent_scenes.spec.scene import Motion, Relation, Scene, SceneObject
from texvent_scenes.staging.tracks.phases import YAWS

WORKING = sorted(one.name for one in NOUNS.values() if one.is_working)
BELTS = sorted(trait_values("belt speed").keys() - nouns_with("flat pattern"))
SIGNS = {"left": -1.0, "right": 1.0, None: 1.0}


def work(noun, *motions, bears=()):
    """Bodies of 3 s: of what works, and of what is on it."""
    return place(SceneObject(noun, motions=motions), *bears, duration_s=3.0)


def drawn(actor, time_s):
    """All that is seen of a body: places of its parts in the world, and their light."""
    placed = actor.place(time_s)
    axes = np.vstack([placed.to_world, [0.0, 0.0, 0.0, 1.0]])
    parts = [axes @ np.vstack([one.to_body, [0, 0, 0, 1]]) for one in placed.parts]
    return np.array(parts), np.array([one.emission for one in placed.parts])


def changes(actor, begin_s, end_s):
    first, *later = (drawn(actor, t) for t in np.linspace(begin_s, end_s, 7))
    return any(not np.allclose(a, b, rtol=0.0, atol=1e-9) for one in later
               for a, b in zip(first, one, strict=True))  # fmt: skip


@for_every(itertools.product(WORKING, (0.7, 1.2)))
def test_what_works_stops_where_it_is_said_to_stand(row):
    noun, stop_s = row
    (actor,) = work(noun, Motion("work"), Motion("stand", start_s=stop_s))
    (alone,) = work(noun, Motion("work"))
    assert changes(actor, 0.0, stop_s) == changes(alone, 0.0, stop_s)
    assert not changes(actor, stop_s, 3.0)


@for_every(itertools.product(WORKING, (0.7, 1.2), (False, True)))
def test_what_works_rests_up_to_the_time_it_starts(row):
    noun, start_s, is_said = row
    (actor,) = work(noun, *[Motion("stand")] * is_said, Motion("work", start_s=start_s))
    (alone,) = work(noun, Motion("work"))
    assert not changes(actor, 0.0, start_s)
    assert changes(actor, start_s, start_s + 1.5) == changes(alone, 0.0, 1.5)


@for_every(itertools.product(sorted(trait_values("turns per second")), (0.5, 2.0), (0.8, 1.3)))
def test_what_turns_at_a_rate_has_turned_so_often_when_it_stops(row):
    noun, rate_hz, stop_s = row
    motions = (Motion("work", rate_hz=rate_hz), Motion("stand", start_s=stop_s))
    if not NOUNS[noun].is_working:
        return
    describe_scene(Scene(objects=(SceneObject(noun, motions=motions),)), NOUNS)
    (actor,) = work(noun, *motions)
    own_hz = trait_value("turns per second", noun)
    run_s = actor.pose(3.0).time_s - actor.pose(0.0).time_s
    assert own_hz * run_s == pytest.approx(rate_hz * stop_s, abs=1e-9)


@for_every(itertools.product(BELTS, (None, "left", "right"), ("work", "move"), (0.1, 0.3, 0.5),
                             ("mug", "apple", "bottle")))  # fmt: skip
def test_a_belt_and_what_is_on_it_go_as_fast_as_said_and_stop_together(row):
    belt, way, kind, speed, noun = row
    motions = (Motion(kind, way, speed_m_s=speed), Motion("stand", start_s=1.25))
    on = SceneObject(noun, relations=(Relation("on", (belt,)),))
    describe_scene(Scene(objects=(SceneObject(belt, motions=motions), on)), NOUNS)
    below, actor = work(belt, *motions, bears=(on,))
    x = [actor.track.at(t).position[0] for t in (0.0, 0.5, 1.25, 3.0)]
    np.testing.assert_allclose(np.diff(x), SIGNS[way] * speed * np.array([0.5, 0.75, 0.0]),
                               atol=1e-9)  # fmt: skip
    assert below.track.at(3.0).position == pytest.approx(below.track.at(0.0).position)
    own = trait_value("belt speed", belt)
    assert below.pose(3.0).time_s * own == pytest.approx(speed * 1.25)


@for_every(itertools.product(BELTS, (("left", "right"), ("right", "left"), (None, "left")),
                             (0.2, 0.4)))  # fmt: skip
def test_a_belt_runs_back_with_what_is_on_it(row):
    belt, (there, back), speed = row
    motions = (Motion("work", there, speed_m_s=speed), Motion("stand", start_s=1.0),
               Motion("work", back, speed_m_s=2 * speed, start_s=1.5))  # fmt: skip
    on = SceneObject("mug", relations=(Relation("on", (belt,)),))
    _, actor = work(belt, *motions, bears=(on,))
    x = [actor.track.at(t).position[0] for t in (0.0, 1.0, 1.5, 2.0)]
    sign = SIGNS[there]
    np.testing.assert_allclose(np.diff(x), [sign * speed, 0.0, -sign * speed], atol=1e-9)


LEGS = ["left", "right", "away", "left right", "right left", "left right left", "right left right",
        "away towards", "towards away towards", "towards left right"]  # fmt: skip


@for_every(itertools.product(BELTS, (0, 35, 90, 180, 270), LEGS))
def test_a_belt_with_a_heading_carries_goods_where_it_is_said_or_is_refused(row):
    belt, heading, ways = *row[:2], row[2].split()
    legs = tuple(Motion("work", way, start_s=float(n) or None) for n, way in enumerate(ways))
    own = SceneObject(belt, heading_deg=heading, motions=legs)
    on = SceneObject("mug", relations=(Relation("on", (belt,)),))
    across = any(abs(np.cos(YAWS[way] - np.radians(heading))) < 0.6 for way in ways)
    refusal = pytest.raises(ConfigError, match=r"no effect: (?!.*it reads direction)")
    with refusal if across else nullcontext():
        describe_scene(Scene(objects=(own, on)), NOUNS)
    _, actor = place(own, on, duration_s=3.0)
    for number, way in enumerate(() if across else ways):
        way_m = np.subtract(*(actor.track.at(number + t).position[:2] for t in (0.4, 0.1)))
        assert way_m @ (np.cos(YAWS[way]), np.sin(YAWS[way])) > 0.06


@for_every(itertools.product(WORKING, (0.5, 2.0), (0.3, 1.1)))
def test_what_works_at_another_pace_from_a_time_on_does_not_jump(row):
    noun, end_pace, start_s = row
    later = Motion("work", end_pace=end_pace, start_s=start_s)
    (actor,) = work(noun, Motion("work"), later)
    assert actor.pose(0.0).time_s == pytest.approx(0.0, abs=1e-9)
    times_s = np.linspace(0.0, 2.9, 291)
    paces = np.diff([actor.pose(t).time_s for t in times_s]) / 0.01
    assert (np.abs(np.diff(paces)) < 0.02).all()
    assert paces[0] == pytest.approx(1.0)
    assert paces[-1] == pytest.approx(end_pace, abs=0.1)


@for_every(itertools.product(BELTS, ("cup", "box"), (2, 3, 4), (0.05, 0.2)))
def test_a_row_on_a_belt_is_as_wide_whichever_way_it_runs(row):
    belt, noun, count, speed = row
    things = SceneObject(noun, count=count, relations=(Relation("on", (belt,)),))
    steps = []
    for way in ("left", "right", "clockwise", "counterclockwise"):
        _, *borne = work(belt, Motion("work", way, speed_m_s=speed), bears=(things,))
        x = [one.track.at(0.0).position[0] for one in borne]
        steps.append(np.diff(x))
        assert np.ptp(np.abs(steps[-1])) < 1e-9
    assert np.ptp(np.abs(steps), axis=0).max() < 1e-9


@pytest.mark.parametrize("belt", BELTS)
@pytest.mark.parametrize("way", ["towards", "away", "up"])
def test_the_usual_motion_of_a_belt_moves_no_machine(belt, way):
    scene = Scene(objects=(SceneObject(belt, motions=(Motion("move", way),)),))
    with pytest.raises(ConfigError, match=r"motions\[0\]\.kind .* 'work' runs its belt"):
        describe_scene(scene, NOUNS)


@for_every(itertools.product(WORKING, ("speed_m_s", "rate_hz")))
def test_what_a_machine_does_not_read_is_refused_without_motions_that_carry_it_off(row):
    noun, name = row
    scene = Scene(objects=(SceneObject(noun, motions=(Motion("work", **{name: 0.7}),)),))
    try:
        describe_scene(scene, NOUNS)
    except ConfigError as error:
        words = str(error).partition("does not read it; ")[2]
        assert words.startswith("it reads ")


SWITCHED = [(noun.name, kind) for noun in NOUNS.values() for kind in sorted(noun.acts)
            if ANIMAL_ACTIVITIES[kind].to_state]  # fmt: skip


def show(noun, *motions, duration_s=2.0):
    one = SceneObject(noun, motions=motions)
    describe_scene(Scene(objects=(one,)), NOUNS)
    return place(one, duration_s=duration_s)[0]


def light(actor, time_s):
    return np.array([one.emission for one in actor.place(time_s).parts])


def test_lights_switch():
    assert {kind for _, kind in SWITCHED} >= {"turn green", "turn amber", "turn red"}


@for_every(itertools.product(SWITCHED, (False, True), (0.4, 1.0, 1.7), (2.0, 3.0)))
def test_a_state_changes_at_the_time_that_is_stated(row):
    (noun, kind), is_said, start_s, duration_s = row
    act = ANIMAL_ACTIVITIES[kind]
    motions = (Motion(act.from_state),) * is_said + (Motion(kind, start_s=start_s),)
    actor = show(noun, *motions, duration_s=duration_s)
    before, after = (
        light(show(noun, Motion(state), duration_s=duration_s), 0.5)
        for state in (act.from_state, act.to_state)
    )
    assert not np.allclose(before, after)
    for time_s in (0.0, 0.5 * start_s, start_s - 1e-6):
        np.testing.assert_array_equal(light(actor, time_s), before)
    for time_s in (start_s, start_s + 0.05, duration_s - 1e-6):
        np.testing.assert_array_equal(light(actor, time_s), after)


@for_every(itertools.product(SWITCHED, (0.8, 1.0, 2.0), (0.5, 0.8, 1.0)))
def test_a_state_does_not_change_in_a_clip_that_ends_before(row):
    (noun, kind), start_s, duration_s = row
    if start_s < duration_s:
        return
    before = show(noun, Motion(ANIMAL_ACTIVITIES[kind].from_state), duration_s=duration_s)
    actor = show(noun, Motion(kind, start_s=start_s), duration_s=duration_s)
    for time_s in (0.0, 0.5 * duration_s, duration_s - 1e-6, duration_s):
        np.testing.assert_array_equal(light(actor, time_s), light(before, 0.2))


@for_every(itertools.product(SWITCHED, (0.6, 1.1)))
def test_a_state_lasts_up_to_the_next(row):
    (noun, kind), start_s = row
    others = [one for name, one in SWITCHED if name == noun and one != kind]
    for other in others:
        motions = (Motion(kind, start_s=start_s), Motion(other, start_s=start_s + 0.5))
        actor = show(noun, *motions)
        states = [light(actor, t) for t in (start_s, start_s + 0.499, start_s + 0.5, 1.99)]
        np.testing.assert_array_equal(states[0], states[1])
        np.testing.assert_array_equal(states[2], states[3])
        assert not np.allclose(states[1], states[2])


def test_without_a_time_a_light_is_seen_before_and_after_it_turns():
    (noun, kind), *_ = SWITCHED
    actor = show(noun, Motion(kind))
    assert not np.allclose(light(actor, 0.0), light(actor, 1.9))
    assert pytest.approx(light(actor, 0.0)) == light(actor, 0.3)


@pytest.mark.parametrize("lead_s", [0.0, 0.4])
@pytest.mark.parametrize("pace", [0.5, 1.0, 1.6])
@pytest.mark.parametrize("kind", [name for name, one in ACTIVITIES.items() if one.repeats_hz])
def test_an_act_among_others_goes_on_at_its_pace(kind, pace, lead_s):
    own_s = 2.0 / ACTIVITIES[kind].repeats_hz
    end_s = lead_s + own_s / pace
    motions = [Motion(kind, pace=pace, start_s=lead_s or None), Motion("stand", start_s=end_s)]
    (man,) = place(SceneObject("man", motions=motions), duration_s=12.0)
    begin, end = man.pose(lead_s + 1e-6), man.pose(end_s - 1e-6)
    assert (begin.activity, end.activity) == (kind, kind)
    assert end.time_s - begin.time_s == pytest.approx(own_s, abs=1e-4)
