"""A field of a scene file changes something, or is refused; heights and speeds are as it says."""

import itertools
import math
from contextlib import nullcontext
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import place, stage, thing

from texvent.errors import ConfigError
from texvent_scenes.models.nouns import MOTIONS, NOUNS
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.scene_input import describe_scene, read, understand
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.spec.scene import (
    Camera,
    CameraMove,
    Light,
    Motion,
    MoveKind,
    Place,
    Relation,
    Scene,
    SceneObject,
)
from texvent_scenes.staging.actors import lowest_point
from texvent_scenes.staging.idle_fields import DIRECTIONS_OF_MOVES, READ_BY_MOVES, list_idle
from texvent_scenes.staging.tracks.phases import COMING_DOWN

TRIED = ("car", "box", "checkerboard", "fan", "drone", "ball", "wheel", "boat", "tree")
"""Nouns of every habitat, that go, roll, work, are flat, or stand."""
VALUES = {"direction": ("left", "clockwise", "to and fro"), "pace": (2.0,), "end_pace": (0.1,),
          "speed_m_s": (1.5,), "rate_hz": (1.25,), "start_s": (0.6,)}  # fmt: skip
ROWS = [
    (kind, TRIED[number % len(TRIED)], name, value)
    for number, (kind, (name, values)) in enumerate(
        itertools.product(sorted(MOTIONS - {"stand", "hang", "sit", "lie", "move"}), VALUES.items())
    )
    for value in values
][::2]


def drawn(one: SceneObject) -> np.ndarray:
    (actor,) = place(one)
    placed = [actor.place(t) for t in np.linspace(0.0, 1.9, 6)]
    parts = [part.to_body.ravel() for one in placed for part in one.parts]
    ways = [one.to_world.ravel() for one in placed]
    return np.concatenate([*parts, *ways, [float(actor.goes_across)]])


@for_every(ROWS)
def test_a_field_of_a_motion_changes_what_is_drawn_or_is_refused(row):
    kind, noun, name, value = row
    one = SceneObject(noun, motions=(Motion(kind, **{name: value}),))
    idle = next(list_idle(Scene(objects=(one,)), Scene(place=Place("plain")), NOUNS), None)
    if idle is not None:
        assert idle.path in (f"objects[0].motions[0].{name}", "objects[0].motions[0].kind")
        usual = replace(one, motions=(Motion(kind),))
        if idle.path.endswith(".kind"):
            usual = replace(one, motions=(Motion("stand", **{name: value}),))
        is_aloft = NOUNS[noun].habitat == "air"  # and would stand on the ground
        if name != "direction" and not is_aloft:  # the seed's may be another one
            np.testing.assert_allclose(drawn(one), drawn(usual), atol=1e-6)
        return
    others = [replace(one, motions=(Motion(kind, **{name: other}),)) for other in (
        ("right", "counter-clockwise", "down", "towards") if name == "direction" else (None,)
    )] if name != "pace" else [replace(one, motions=(Motion(kind),))]  # fmt: skip
    shown = drawn(one)
    assert any(shown.shape != each.shape or not np.allclose(shown, each, atol=1e-6)
               for each in map(drawn, others))  # fmt: skip


@for_every([(noun, kind) for noun in TRIED for kind in sorted(MOTIONS)])
def test_a_height_is_that_at_time_0(row):
    noun, kind = row
    one = SceneObject(noun, height_m=2.5, position_m=(1.0, 2.0), motions=(Motion(kind),))
    (actor,) = place(one)
    x, y, z = actor.track.at(0.0).position
    assert (x, y, z + lowest_point(actor.model)) == pytest.approx((1.0, 2.0, 2.5), abs=1e-6)


@for_every(itertools.product(("box", "ball", "checkerboard", "drone", "car"),
                             ((), ("bounce",), ("stand",), ("slide",))))  # fmt: skip
def test_what_falls_starts_raised_and_ends_on_the_ground(row):
    noun, later = row
    kinds = ("fall", *later)
    for height_m in (None, 3.0):
        one = SceneObject(noun, height_m=height_m, motions=tuple(map(Motion, kinds)))
        (actor,) = place(one, duration_s=12.0)
        lows = [float(actor.corners(t)[:, 2].min()) for t in np.linspace(0.0, 12.0, 61)]
        assert height_m is None or lows[0] == pytest.approx(height_m, abs=0.02)
        assert min(lows) > -0.03
        assert min(lows) < 0.05 * max(1.0, actor.model.height)


def test_what_comes_down_from_a_height_is_in_free_fall():
    for kind in sorted(COMING_DOWN - {"sink"}):
        (actor,) = place(SceneObject("ball", height_m=4.0, motions=(Motion(kind),)))
        times = np.linspace(0.25, 0.8, 6)
        steps = np.diff([actor.track.at(t).position[2] for t in times], 2)
        np.testing.assert_allclose(steps, -9.81 * (times[1] - times[0]) ** 2, rtol=1e-6)


STATED = {"speed_m_s", "rate_deg_s"}
FIELDS = {"direction": None, "pace": 3.0, "means": "fly", "speed_m_s": 2.0, "rate_deg_s": 9.0}
MOVES = [(kind, name, beside) for kind in get_args(MoveKind) for name in FIELDS for beside in FIELDS
         if name == beside or beside in READ_BY_MOVES[kind]]  # fmt: skip


@pytest.mark.parametrize(("kind", "name", "beside"), MOVES)
def test_a_field_of_a_camera_move_changes_the_path_or_is_refused(kind, name, beside):
    """Alone, and beside each other one."""
    ways = (*DIRECTIONS_OF_MOVES.get(kind, ("left",)), None)
    given = {one: FIELDS[one] or ways[0] for one in (name, beside)}
    scene = Scene(objects=(SceneObject("box"),), camera=Camera((CameraMove(kind, **given),)))
    if name not in READ_BY_MOVES[kind] or ("pace" in given and given.keys() & STATED):
        why = rf"^camera\.moves\[0\]\.({name}|{beside}) has no effect: "
        with pytest.raises(ConfigError, match=why):
            describe_scene(scene, NOUNS)
        return
    described = describe_scene(scene, NOUNS)
    others = {**given, name: ways[1] if name == "direction" else 1.0 if name == "pace" else None}
    usual = CameraMove(kind, **others)
    paths = []
    for move in (described.camera.moves[0], usual):
        camera = stage(SceneObject("box"), camera=Camera((move,))).camera
        poses = [camera(t) for t in (0.3, 1.7)]
        paths.append(np.array([[*p.position, *p.rotation.ravel(), p.focal] for p in poses]))
    assert not np.allclose(*paths)


@pytest.mark.parametrize("kind", [kind for kind, read in READ_BY_MOVES.items()
                                  if read & {"speed_m_s", "rate_deg_s"}])  # fmt: skip
def test_a_camera_move_is_as_fast_as_it_says_while_it_lasts(kind):
    is_turn = "rate_deg_s" in READ_BY_MOVES[kind]
    said = {"rate_deg_s": 30.0} if is_turn else {"speed_m_s": 1.5}
    times = {} if kind == "travel" else {"start_s": 0.5, "duration_s": 0.8}
    move = CameraMove(kind, DIRECTIONS_OF_MOVES[kind][0], **said, **times)
    camera = stage(SceneObject("tree"), camera=Camera((move,))).camera
    before, a, b, after = (camera(t) for t in (0.4, 0.6, 1.1, 1.4))
    turn = math.degrees(math.acos(min(1.0, 0.5 * (np.trace(a.rotation @ b.rotation.T) - 1.0))))
    widths = [2.0 * math.degrees(math.atan(0.5 / one.focal)) for one in (a, b)]
    turn = abs(widths[1] - widths[0]) if kind == "zoom" else turn
    went = float(np.linalg.norm(b.position - a.position))
    assert (turn if is_turn else went) == pytest.approx(0.5 * (30.0 if is_turn else 1.5), rel=1e-3)
    if times:
        np.testing.assert_allclose(before.position, camera(0.1).position)
        np.testing.assert_allclose(after.position, camera(1.9).position)


def test_words_whose_fields_change_nothing_are_not_shown():
    words = understand("a red car drives left quickly at 20 km/h", NOUNS).words
    assert "quickly" not in words.shown
    assert words.not_shown == ("quickly (speed_m_s takes its place; leave one of them out)",)
    words = understand("a grating moves up and a car drives right", NOUNS).words
    assert "right" in words.shown
    assert [one.partition(" (")[0] for one in words.not_shown] == ["up"]
    prompt = "a dog drives at 600 rpm on wet grass"
    words, reading = understand(prompt, NOUNS).words, read(prompt)
    assert [one.partition(" (")[0] for one in words.not_shown] == ["600 rpm", "wet"]
    assert reading.not_understood == ("600 rpm", "wet")
    assert reading.shown == words.shown


@pytest.mark.parametrize("start_s", [0.3, 1.0, 2.0, 5.0, 60.0])
@pytest.mark.parametrize("what", ["dog jumps", "man jumps", "ball bounces", "woman waves"])
def test_a_motion_that_begins_late_is_not_taken_for_rest(what, start_s):
    (thing,) = read(f"a {what} after {start_s} seconds").scene.objects
    ((kind, start),) = ((one.kind, one.start_s) for one in thing.motions)
    assert (f"{kind}s", start) == (what.split()[1], start_s)


@pytest.mark.filterwarnings("ignore:scene. not shown. the crossing")
def test_the_roads_cross_where_the_scene_says_and_the_report_where_they_do():
    car = SceneObject("car", position_m=(-4, 1), heading_deg=0, motions=(Motion("drive"),))
    scene = Scene(objects=(car,), place=Place("city", crossing_m=(9, 30)))
    for said in (scene, replace(scene, place=Place("city", road="crossing"))):
        video = ProceduralGenerator(ProceduralConfig(duration=0.2)).generate(said)
        ((x, y, angle),) = video.scene.environment(0.0).road_crossings
        assert said is not scene or (x, angle) == pytest.approx((9.0, 0.5 * math.pi))
        note = f"the roads cross at ({x:.3g}, {y:.3g}) m"
        assert note in video.metadata["prompt_report"]["notes"]


@pytest.mark.parametrize("noun", TRIED)
def test_what_is_written_before_makes_way_for_what_is_at_a_position_in_metres(noun):
    own = SceneObject(noun, motions=(Motion("stand"),))
    (alone,) = place(own)
    x, y = alone.track.at(0.0).position[:2]
    other, one = place(own, replace(own, position_m=(x, y)))
    assert one.track.at(0.0).position[:2] == pytest.approx([x, y])
    room_m = min(one.model.width, one.model.length)
    assert math.hypot(*(other.track.at(0.0).position[:2] - np.array([x, y]))) > 0.9 * room_m


@pytest.mark.parametrize("pace", [1.0, 4.0])
def test_a_belt_carries_what_is_on_it_up_to_its_end(pace):
    belt = SceneObject("conveyor belt", motions=(Motion("work", pace=pace),))
    boxes = SceneObject("box", count=2, size=0.4, relations=(Relation("on", ("conveyor belt",)),))
    carrier, *carried = place(belt, boxes, duration_s=3.0)
    for one in carried:
        x0, x1 = (one.track.at(t).position[0] for t in (0.5, 0.75))
        assert (x1 - x0) / 0.25 == pytest.approx(0.4 * pace, rel=1e-3)
        half = 0.5 * carrier.model.length + 0.1
        assert all(abs(one.track.at(t).position[0]) <= half for t in np.linspace(0.0, 3.0, 7))


@pytest.mark.parametrize("kind", [None, "stand", "hang", "spin", "bounce", "walk", "run in place"])
def test_a_belt_carries_what_stands_on_it_and_nothing_that_moves_by_itself(kind):
    motions = () if kind is None else (Motion(kind),)
    relations = (Relation("on", ("conveyor belt",)),)
    for noun in ("dog", "man"):
        rider = SceneObject(noun, motions=motions, relations=relations)
        _, one = place(SceneObject("conveyor belt", motions=(Motion("work"),)), rider)
        is_carried = one.track.at(1.0).position[0] - one.track.at(0.5).position[0] > 0.15
        assert is_carried == (kind in (None, "stand")), noun


def test_a_board_tilts_then_rotates_at_the_rate_that_is_said():
    motions = (Motion("tilt", rate_hz=1.0), Motion("rotate", rate_hz=0.5))
    (board,) = place(SceneObject("checkerboard", motions=motions))
    assert max(abs(board.track.at(t).pitch) for t in np.linspace(0.0, 1.0, 21)) > 0.35
    turned = board.track.at(1.9).yaw - board.track.at(1.5).yaw
    assert abs(turned) == pytest.approx(2.0 * math.pi * 0.5 * 0.4, rel=1e-3)


def test_a_rest_that_changes_nothing_is_left_out_of_a_sentence():
    described = understand("a vase stands, then waits", NOUNS)
    assert [one.kind for one in described.objects[0].motions] == ["stand"]
    waits = understand("a fan spins, then waits", NOUNS)
    assert [one.kind for one in waits.objects[0].motions] == ["work", "stand"]
    assert "waits" in waits.words.shown


def test_what_waits_before_it_falls_is_said_to_hang_in_the_air():
    note = "the ball hangs on a thread until it falls"
    assert note in understand("a ball falls after 0.5 seconds", NOUNS).notes
    assert note not in understand("a ball falls", NOUNS).notes


@pytest.mark.parametrize(
    ("noun", "is_held"), [("ball", True), ("box", True), ("street lamp", False)]
)
def test_what_waits_in_the_air_hangs_on_a_thread_above_it(noun, is_held):
    late, once = (
        stage(thing(noun, *motions)) for motions in ((("stand",), ("fall",)), (("fall",),))
    )
    assert (len(late.threads), len(once.threads)) == (is_held, 0)
    body = late.actors[0].corners(0.0)
    middle = 0.5 * (body.min(axis=0) + body.max(axis=0))
    for hung, until_s in late.threads:
        to_world = hung.parts[0].to_body
        assert late.actors[0].corners(until_s)[:, 2].min() == pytest.approx(body[:, 2].min())
        assert late.actors[0].corners(until_s + 0.1)[:, 2].min() < body[:, 2].min() - 0.01
        for at_s, reach_m in ((until_s - 1e-3, 10.0), (until_s, 0.01)):
            drawn = late.primitives(at_s)
            longest = np.linalg.norm(drawn.to_world[:, :, 2], axis=1)[drawn.instance == 0]
            assert (longest.max() > reach_m) == (reach_m == 10.0)
        ends = to_world[:, 3] + np.outer((-1.0, 1.0), to_world[:, 2])
        assert np.allclose(ends[:, :2], middle[:2], atol=1e-6)
        assert middle[2] < ends[:, 2].min() < body[:, 2].max() < ends[:, 2].max() - 10.0


@pytest.mark.parametrize(
    ("noun", "kinds", "why"),
    [("door", ("open", "open"), "has done that before"),
     ("ball", ("roll", "open"), "does not do that")],
)  # fmt: skip
def test_a_motion_that_is_done_already_is_told_from_one_that_is_never_done(noun, kinds, why):
    scene = scene_from_data({"objects": [{"noun": noun, "motions": [{"kind": k} for k in kinds]}]})
    with pytest.raises(ConfigError, match=why):
        ProceduralGenerator(ProceduralConfig(duration=2.0)).report(scene)


SAID = [
    ({"place": Place("kitchen", clouds=0.5)}, r"^place\.clouds has no effect: "),
    ({"place": Place("beach", road="crossing")}, r"^place\.road has no effect: "),
    ({"place": Place("grass", crossing_m=(1, 1))}, r"^place\.crossing_m has no effect: "),
    ({"place": Place("road", wave_height=2.0)}, r"^place\.wave_height has no effect: "),
    ({"light": Light(wave="strobe")}, r"^light\.wave has no effect: "),
    ({"objects": (SceneObject("box", blink_hz=3.0),)}, r"^objects\[0\]\.blink_hz has no effect: "),
    ({"objects": (SceneObject("car", heading_deg=9, motions=(Motion("drive", "left"),)),)},
     r"^objects\[0\]\.motions\[0\]\.direction has no effect: "),
    ({"objects": (SceneObject("car", placement="left", position_m=(0, 0)),)},
     r"^objects\[0\]\.placement has no effect: "),
    ({"objects": (SceneObject("car", motions=(Motion("wave"),)),)},
     r"^objects\[0\]\.motions\[0\]\.kind has no effect: "),
    ({"place": Place("road", weather="rain", is_wet=True)}, None),
    ({"place": Place("road", weather="rain", is_wet=False)}, "rain wets the ground; leave"),
    ({"place": Place("grass", weather_amount=3.0)}, "it is that of a weather"),
    ({"place": Place("grass", weather="snow", weather_amount=3.0)}, None),
    ({"place": Place("grass", is_wet=False)}, None),
    ({"place": Place("grass", is_wet=True)}, "has not a road or a paved ground"),
    ({"objects": (SceneObject("box", is_lit=False),)}, None),
    ({"objects": (SceneObject("box", is_lit=True),)}, "has no lamp"),
    ({"objects": (SceneObject("car", heading_deg=180, motions=(Motion("drive", "left"),)),)}, None),
    ({"objects": (SceneObject("car", heading_deg=-180, motions=(Motion("drive", "left"),)),)},
     None),
    ({"objects": (SceneObject("car", heading_deg=170, motions=(Motion("drive", "left"),)),)},
     "heading_deg takes its place"),
    ({"objects": (SceneObject("man", motions=(Motion("stand"), Motion("stand", start_s=1.0))),)},
     None),
]  # fmt: skip


@pytest.mark.parametrize(("fields", "why"), SAID)
def test_what_is_so_anyway_is_accepted_and_what_has_no_effect_is_named(fields, why):
    with nullcontext() if why is None else pytest.raises(ConfigError, match=why):
        describe_scene(Scene(**fields), NOUNS)


@for_every(itertools.product((0.5, 1.2, 4.0), (None, 0.4), ("ball", "box", "tennis ball")))
def test_a_bounce_after_a_fall_has_the_time_of_the_landing_or_none(row):
    height_m, fall_s, noun = row
    landing_s = (fall_s or 0.0) + math.sqrt(2.0 * height_m / 9.81)
    first = () if fall_s is None else (Motion("stand"),)

    def check(start_s):
        motions = (*first, Motion("fall", start_s=fall_s), Motion("bounce", start_s=start_s))
        one = SceneObject(noun, height_m=height_m, motions=motions)
        describe_scene(Scene(objects=(one,)), NOUNS)

    for agreeing_s in (None, landing_s, landing_s + 0.01):
        check(agreeing_s)
    with pytest.raises(ConfigError, match=rf"as soon as it is down, at {landing_s:.3f} s; leave"):
        check(landing_s + 0.2)


@for_every(ROWS[::5])
def test_an_error_of_a_field_does_not_name_its_own_motion_as_one_that_reads_it(row):
    kind, noun, name, value = row
    for before in ((), (Motion("stand"),), (Motion("fall"),)):
        motions = (*before, Motion(kind, **{name: value}))
        scene = Scene(objects=(SceneObject(noun, motions=motions),))
        for idle in list_idle(scene, Scene(place=Place("plain")), NOUNS):
            assert "..." not in idle.why
            named = idle.why.partition("these do: ")[2].partition(";")[0].split(", ")
            assert kind not in named or idle.path.endswith(".kind")
