"""Short prompts as people write them: each mechanism in three unrelated sentences at least."""

from functools import cache

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent_scenes.models.effects import hue_of
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.read import read
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staged_prompt import _are_enough, stage

SIZE = SensorSize(173, 130)


@cache
def staged(text):
    """The staged scene of a sentence, and its report."""
    nouns = list_nouns()
    scene = understand(text, nouns)
    return stage(scene, scene.words, nouns, seed=0, size=SIZE, duration_s=2.0)


@cache
def report(text):
    return ProceduralGenerator(ProceduralConfig(duration=2.0), size=SIZE).report(text)


def is_right(text):
    """Whether the report has no fault."""
    said = report(text)
    return not (said.not_understood or said.not_shown or said.out_of_view or said.substituted)


def parts(actor, time_s):
    return np.array([part.to_body for part in actor.own_parts(actor.pose(time_s))])


@pytest.mark.parametrize(
    "text",
    ["a door opens slowly", "a drawer slides open", "the fridge opens", "a laptop closes",
     "a box opens after 0.5 s", "a woman opens a window", "a boy shuts the oven"],
)  # fmt: skip
def test_what_opens_or_closes_turns_or_slides_its_own_parts(text):
    actor = staged(text)[0].actors[-1]
    first, last = parts(actor, 0.0), parts(actor, 2.0)
    assert np.abs(last - first).max() > 0.1 * actor.size_m
    assert is_right(text)


@pytest.mark.parametrize(
    ("text", "other"),
    [("an open door", "a closed door"), ("the laptop is open", "the laptop is closed"),
     ("a cat beside an open box", "a cat beside a closed box")],
)  # fmt: skip
def test_open_and_closed_of_what_opens_are_two_states_that_last(text, other):
    one, two = (staged(each)[0].actors[-1] for each in (text, other))
    np.testing.assert_array_equal(parts(one, 0.0), parts(one, 2.0))
    assert np.abs(parts(one, 0.0) - parts(two, 0.0)).max() > 0.1 * one.size_m
    assert is_right(text)
    assert is_right(other)


@pytest.mark.parametrize(
    ("text", "colours"),
    [("a traffic light turns green", ["red", "green"]),
     ("the traffic light changes from green to red", ["green", "red"]),
     ("a green car waits at a green traffic light", ["green", "green"])],
)  # fmt: skip
def test_a_traffic_light_shows_the_colour_that_is_said(text, colours):
    actor = next(one for one in staged(text)[0].actors if one.noun.name == "traffic light")
    lit = [
        hue_of(max(actor.own_parts(actor.pose(time_s)), key=lambda part: part.emission).colour)
        for time_s in (0.0, 2.0)
    ]
    assert lit == colours
    assert is_right(text)


@pytest.mark.parametrize(
    "text", ["a dog jumps into a lake", "a man leaps into the sea", "a woman jumps into the water"]
)
def test_who_jumps_into_water_comes_from_above_and_splashes(text):
    scene = staged(text)[0]
    (one,), (splash,) = scene.actors, scene.particles.effects
    before, after = (one.lowest_m(splash.start_s + step) for step in (-0.05, 0.2))
    assert one.lowest_m(0.0) > 0.4 > 0.0 > after
    assert before > 0.0
    times = np.array([splash.start_s - 0.1, splash.start_s + 0.1])
    seen, gone = (np.abs(splash.at(at).to_world[:, :, :3]).max(axis=(1, 2)) for at in times[::-1])
    assert seen.max() > 100.0 * gone.max()
    assert is_right(text)


def test_who_swims_or_stands_by_the_water_does_not_splash():
    for text in ("a dog swims in a lake", "a man jumps on a beach"):
        assert not staged(text)[0].particles.effects


@pytest.mark.parametrize(
    "text",
    ["a horse gallops along a fence", "a cat runs along a wall", "a dog runs along a brick wall"],
)
def test_a_fence_is_as_long_as_the_way_along_it(text):
    one, fence = staged(text)[0].actors
    way = one.middle(2.0) - one.middle(0.0)
    assert np.ptp(fence.corners(0.0)[:, 0]) == pytest.approx(np.linalg.norm(way), rel=0.4)
    assert is_right(text)


def test_an_act_begins_when_it_is_said_and_takes_longer_slowly():
    usual, late, slow = (
        staged(text)[0].actors[0]
        for text in ("a door opens", "a door opens after 1 s", "a door opens slowly")
    )
    np.testing.assert_allclose(parts(usual, 0.5), parts(late, 1.5))
    np.testing.assert_allclose(parts(usual, 0.5), parts(slow, 1.0))
    np.testing.assert_array_equal(parts(late, 0.0), parts(late, 1.0))


@pytest.mark.parametrize(
    "text",
    ["three people sitting round a fire", "four children dance around a tree",
     "two dogs sit around a campfire", "two men and three women sit around a campfire"],
)  # fmt: skip
def test_a_ring_is_seen_as_a_whole_and_faces_its_middle_from_even_angles(text):
    scene, _, *_ = staged(text)
    *ring, middle = scene.actors
    assert is_right(text)
    offs = np.array([middle.middle(1.0)[:2] - one.middle(1.0)[:2] for one in ring])
    angles = np.sort(np.arctan2(offs[:, 1], offs[:, 0]))
    gaps = np.diff([*angles, angles[0] + 2.0 * np.pi])
    np.testing.assert_allclose(gaps, 2.0 * np.pi / len(ring), atol=0.2)
    for one, off in zip(ring, offs, strict=True):
        yaw = one.track.at(1.0).yaw
        assert np.array([np.cos(yaw), np.sin(yaw)]) @ off > 0.95 * np.linalg.norm(off)


@pytest.mark.parametrize(
    ("text", "speed"),
    [("boxes moving along a conveyor belt at 0.3 m/s", 0.3),
     ("a cup slides along a conveyor belt at 0.5 m/s", 0.5),
     ("two cups move left on a conveyor belt at 0.2 m/s", -0.2)],
)  # fmt: skip
def test_what_moves_along_a_belt_goes_on_it_as_fast_as_it_runs(text, speed):
    one = staged(text)[0].actors[0]
    way = one.middle(1.1) - one.middle(0.9)
    np.testing.assert_allclose(way[0], 0.2 * speed, rtol=0.01)
    assert one.lowest_m(1.0) > 0.3
    assert is_right(text)


@pytest.mark.parametrize(
    ("text", "noun", "rate_hz"),
    [("a pendulum swinging at 1 Hz", "pendulum", 1.0),
     ("a metronome ticking at 120 bpm", "metronome", 1.0),
     ("a newton cradle swings at 2 Hz", "newton cradle", 2.0)],
)  # fmt: skip
def test_what_swings_does_so_at_the_rate_that_is_said(text, noun, rate_hz):
    one = staged(text)[0].actors[0]
    assert one.noun.name == noun
    np.testing.assert_allclose(parts(one, 0.3), parts(one, 0.3 + 1.0 / rate_hz), atol=1e-9)
    assert np.abs(parts(one, 0.3) - parts(one, 0.3 + 0.5 / rate_hz)).max() > 1e-3
    assert is_right(text)


@pytest.mark.parametrize(
    "text",
    ["a train stops at a platform", "a train arrives at the platform", "a tram waits at a platform",
     "a train passes a platform"],
)  # fmt: skip
def test_the_platform_of_a_train_lies_along_it(text):
    train, platform = staged(text)[0].actors[:2]
    assert platform.noun.name == "station platform"
    off = platform.middle(2.0) - train.middle(2.0)
    yaw = train.track.at(2.0).yaw
    aside = abs(off[1] * np.cos(yaw) - off[0] * np.sin(yaw))
    assert 0.5 * platform.model.width < aside < platform.model.width + train.model.width
    assert is_right(text)


def test_another_platform_is_one_to_land_on():
    assert staged("a drone lands on a platform")[0].actors[1].noun.name == "platform"


@pytest.mark.parametrize(
    ("text", "speed"),
    [("ego view driving on a highway at 100 km/h", 100 / 3.6),
     ("dashcam footage driving through a city at 10 m/s", 10.0),
     ("egocentric view walking through a forest at 1 m/s", 1.0),
     ("dashcam view in the rain at 50 km/h", 50 / 3.6), ("ego motion at 3 m/s in a forest", 3.0),
     ("driver view at night at 72 km/h", 20.0)],
)  # fmt: skip
def test_a_view_that_travels_goes_once_and_as_fast_as_is_said(text, speed):
    camera = staged(text)[0].camera
    way = camera(1.1).position - camera(0.9).position
    np.testing.assert_allclose(np.linalg.norm(way), 0.2 * speed, rtol=0.02)
    assert is_right(text)


@pytest.mark.parametrize(
    ("text", "paces"),
    [
        ("a pendulum at 0.5 Hz next to a metronome at 60 bpm", [0.5 / 0.540686, 0.5]),
        ("two fans spinning at 5 Hz and 8 Hz", [5 / 3.37, 8 / 3.37]),
        ("a fan at 300 rpm", [5 / 3.37]),
    ],
)
def test_what_works_does_so_at_a_rate_without_a_verb(text, paces):
    objects = understand(text, list_nouns()).objects
    np.testing.assert_allclose([one.motions[0].pace for one in objects], paces, rtol=1e-5)
    assert is_right(text)


@pytest.mark.parametrize(
    ("text", "is_so"),
    [("a white square flickering at 10 Hz on a black background", True),
     ("a flashing disc", True), ("a checkerboard blinks at 4 Hz", False),
     ("a chair flickers at 5 Hz", False), ("a flickering screen", False)],
)  # fmt: skip
def test_patterns_and_lamps_blink_and_nothing_else(text, is_so):
    scene = staged(text)[0]
    assert is_right(text) is is_so
    shares = {one.lamps.place(one.actors[0], time_s).parts[0].to_body[:, :3].max().round(6)
              for one in (scene,) for time_s in np.arange(0.0, 0.5, 0.0125)}  # fmt: skip
    assert len(shares) == 1 + is_so


def test_a_camera_goes_through_what_has_a_way_through_alone():
    said = "camera dollies forward through a doorway"
    scene = staged(said)[0]
    ahead = [(scene.actors[0].middle(0.0) - scene.camera(time_s).position)[:2]
             for time_s in (0.0, 2.0)]  # fmt: skip
    assert ahead[0] @ ahead[1] < 0.0
    for text in ("the camera moves through a car", "the camera flies through a tunnel"):
        assert "through" in report(text).not_understood


@pytest.mark.parametrize(
    "text",
    ["a car approaching the camera at 60 km/h", "a dog approaches the camera",
     "a person approaching the camera", "a ping-pong ball thrown at the camera",
     "a tomato flies straight at the lens", "a baseball thrown directly at the camera"],
)  # fmt: skip
def test_what_approaches_the_camera_comes_nearer(text):
    scene = staged(text)[0]
    away = [np.linalg.norm(scene.actors[0].middle(time_s) - scene.camera(time_s).position)
            for time_s in (0.0, 2.0)]  # fmt: skip
    assert away[1] < away[0]
    assert scene.actors[0].track.at(1.0).speed_m_s > 0.5
    assert not read(text, list_nouns()).scene.camera.moves


def test_of_things_without_a_number_most_in_view_are_enough():
    assert _are_enough("tree (1 of 3)", ["trees"])
    assert not _are_enough("tree (1 of 3)", ["trees", "three"])
    assert not _are_enough("tree (2 of 3)", ["trees"])
    assert not _are_enough("tree (cut off)", ["trees"])


@pytest.mark.parametrize(
    "text",
    ["a dog barks, then sparks fly from a barrel", "a man waves, then smoke rises from a campfire",
     "a car drives past, then leaves fall"],
)  # fmt: skip
def test_an_effect_after_then_begins_with_the_second_half(text):
    effects = staged(text)[0].particles.effects
    assert max(one.start_s for one in effects) == 1.0


@pytest.mark.parametrize(
    ("text", "count"),
    [("dominoes topple one after another", 5), ("four pigeons take off one by one", 4),
     ("three balls fall one after the other", 3)],
)  # fmt: skip
def test_copies_that_take_turns_begin_at_different_times(text, count):
    actors = [one for one in staged(text)[0].actors if one.is_mover]
    times = np.linspace(0.0, 1.9, 39)
    begun = {next(t for t in times if np.abs(one.middle(t) - one.middle(0.0)).max() > 1e-4)
             for one in actors}  # fmt: skip
    assert len(actors) == len(begun) == count


def test_what_topples_one_after_another_stands_in_an_even_row():
    for text in ("dominoes topple", "six bottles fall over", "four books topple"):
        first, *others = read(f"{text} one after another", list_nouns()).scene.objects
        places = [0.0, *(one.relations[0].distance_m for one in others)]
        assert len(places) > 3
        assert {one.relations[0].to for one in others} == {(first.noun,)}
        np.testing.assert_allclose(np.diff(places), places[1], rtol=1e-5)


@pytest.mark.parametrize(
    ("text", "noun"),
    [("a black disc with a white line spins", "white-lined disc"),
     ("a spinning disc with a black dot", "black-dotted disc"),
     ("a rotating disk with black and white sectors", "spinning disc"),
     ("a fan with three blades", "three-bladed fan"),
     ("a two-blade fan at 60 rpm", "two-bladed fan"),
     ("a spinning fan with a black dot on one blade", "dotted fan"),
     ("a disc with two white lines", "disc"), ("a fan with a red ribbon", "fan")],
)  # fmt: skip
def test_a_mark_makes_a_disc_or_a_fan_one_that_turns_visibly(text, noun):
    assert staged(text)[0].actors[0].noun.name == noun
    assert is_right(text) == (noun not in ("disc", "fan"))


@pytest.mark.parametrize(
    ("text", "activity"),
    [("a pancake being flipped in a pan", "toss"), ("wood being chopped", "chop wood"),
     ("dough being kneaded on a kitchen counter", "knead"), ("a hammer striking a nail", "hammer"),
     ("a pen writing on white paper", "write"), ("a broom sweeping the floor", "sweep"),
     ("slicing a tomato", "slice"), ("chopping carrots", "slice"), ("petting a cat", "stroke low"),
     ("hands kneading dough", "knead"), ("hands shuffling cards", "shuffle cards"),
     ("a hand slices bread", "slice")],
)  # fmt: skip
def test_an_act_that_only_a_person_does_brings_one(text, activity):
    actors = staged(text)[0].actors
    assert actors[0].noun.name == "person"
    assert actors[0].track.at(0.0).activity == activity
    assert is_right(text)


def test_a_tool_does_nothing_else_by_itself():
    actors = [one for text in ("a pen rolls off a table", "a hammer falls", "a broom on a table")
              for one in staged(text)[0].actors]  # fmt: skip
    assert {one.noun.name for one in actors} == {"pen", "table", "hammer", "broom"}


@pytest.mark.parametrize(
    ("text", "activities"),
    [("fingers snapping, close up", ["snap"]), ("a hand counts from one to five", ["count"]),
     ("rock, paper, scissors hand gestures", ["rock paper scissors"]),
     ("thumbs up, then a peace sign", ["thumbs up", "victory"]),
     ("a hand waving left to right", ["wave"])],
)  # fmt: skip
def test_one_hand_makes_all_gestures(text, activities):
    (hand,) = staged(text)[0].actors
    shown = [hand.track.at(at).activity for at in (0.3, 1.9)]
    assert list(dict.fromkeys(shown)) == activities
    assert len({tuple(np.round(parts(hand, at).ravel(), 4)) for at in np.arange(0, 2, 0.25)}) > 1
    assert is_right(text)


@pytest.mark.parametrize(
    "text", ["laundry flapping on a line", "laundry flaps on a clothesline in strong wind"]
)
def test_laundry_is_on_its_line_and_flaps(text):
    (line,) = staged(text)[0].actors
    assert np.abs(parts(line, 0.5) - parts(line, 0.0)).max() > 0.05
    assert is_right(text)
