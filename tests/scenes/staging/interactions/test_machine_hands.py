"""Acts of machines' hands: they begin at the time of their motion, as the machine is headed."""

import itertools
import math
import re

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import place

from texvent.errors import ConfigError
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import trait_values
from texvent_scenes.scene_input import describe_scene
from texvent_scenes.spec.data import HANDLED
from texvent_scenes.spec.scene import Motion, Relation, Scene, SceneObject

ACTS = [(noun, act) for noun, row in trait_values("gripper").items()
        for act in row["acts"] if act != "hold"]  # fmt: skip
THINGS = {"robot arm": "box", "forklift": "pallet"}
CLIP_S = 4.0


def act(noun, kind, *motions, is_borne=False, **fields):
    """Bodies of an act by their names: the machine, the thing, and what that is on or gets to."""
    bears = (Relation("on", ("table",)),) if is_borne else ()
    done = (Relation(kind, ("thing",)),)
    bodies = (
        SceneObject(noun, id="machine", motions=motions, relations=done, **fields),
        SceneObject(THINGS[noun], id="thing", size=0.5, relations=bears),
        *[SceneObject("table", id="table", position_m=(1.0, 0.5))] * is_borne,
    )
    found = place(*bodies, duration_s=CLIP_S)
    return {bodies[one.object_index].id: one for one in found}


def first_move_s(actor):
    """When the hand leaves where it is at first, or the body does."""
    times = np.arange(0.0, CLIP_S, 0.05)
    places = [(*actor.anchor("hands", float(t))[:, 3], *actor.middle(float(t))) for t in times]
    moved = np.abs(np.subtract(places, places[0])).max(axis=1) > 1e-6
    return float(times[np.argmax(moved)]) if moved.any() else math.inf


@for_every(itertools.product(ACTS, (0.4, 0.9, 1.3), (False, True), (False, True)))
def test_a_machine_begins_its_act_at_the_stated_time(row):
    (noun, kind), start_s, is_first, is_borne = row
    if is_borne and (kind != "lift" or noun == "forklift"):
        return
    rest = [Motion("stand")] * is_first
    found = act(noun, kind, *rest, Motion("work", start_s=start_s), is_borne=is_borne)
    assert first_move_s(found["machine"]) == pytest.approx(start_s, abs=0.11)
    thing = found["thing"]
    if kind != "set down":
        assert np.allclose(thing.middle(0.0), thing.middle(start_s), atol=1e-6)
    assert not np.allclose(thing.middle(0.0), thing.middle(CLIP_S - 0.01), atol=0.05)


@for_every(itertools.product(ACTS, (None, -140.0, 0.0, 60.0), (False, True)))
def test_a_machine_is_headed_as_stated_and_has_the_thing_before_it(row):
    (noun, kind), heading_deg, is_borne = row
    if is_borne and (kind != "lift" or noun == "forklift"):
        return
    found = act(noun, kind, heading_deg=heading_deg, is_borne=is_borne)
    machine, thing = found["machine"], found["thing"]
    if heading_deg is not None:
        turned = math.remainder(machine.track.at(0.0).yaw - math.radians(heading_deg), math.tau)
        assert turned == pytest.approx(0.0, abs=1e-6)
    gaps = [np.linalg.norm(machine.anchor("hands", t)[:, 3] - thing.middle(t))
            for t in np.arange(0.0, CLIP_S, 0.05)]  # fmt: skip
    assert min(gaps) < 0.6 * thing.size_m


def lift(noun, machine_m, thing_m, bearer, heading_deg=None):
    """The machine and what it lifts, of what is on a thing or on the ground; None: left open."""
    on = (Relation("on", ("bearer",)),) if bearer else ()
    bodies = (
        SceneObject(noun, id="machine", relations=(Relation("lift", ("thing",)),),
                    position_m=machine_m, heading_deg=heading_deg),
        SceneObject(THINGS[noun], id="thing", size=0.5, relations=on, position_m=thing_m),
        *[SceneObject(bearer, id="bearer", heading_deg=0.0, position_m=thing_m)] * bool(bearer),
    )  # fmt: skip
    found = {one.object_index: one for one in place(*bodies)}
    return found[0], found[1]


def check_lift(machine, thing, machine_m, thing_m):
    """Both are where they are stated, and the hand gets to the thing and takes it up."""
    for one, at in ((machine, machine_m), (thing, thing_m)):
        if at is not None:
            np.testing.assert_allclose(one.track.at(0.0).position[:2], at, atol=0.03)
    reached = [np.linalg.norm(machine.anchor("hands", t)[:, 3] - thing.middle(t))
               for t in np.arange(0.0, 2.0, 0.05)]  # fmt: skip
    assert min(reached) < 0.6 * thing.size_m
    assert thing.middle(1.99)[2] > thing.middle(0.0)[2] + 0.1


@for_every(itertools.product(
    [("robot arm", "table"), ("robot arm", ""), ("robot arm", "stool"), ("forklift", "")],
    (0.6, 1.2, 3.0), (-2.0, 0.4), (None, 130.0),
))  # fmt: skip
def test_a_stated_machine_reaches_a_stated_thing_or_says_from_where_it_does(row):
    (noun, bearer), off_m, angle, heading_deg = row
    thing_m = (0.7, -0.4)
    machine_m = (thing_m[0] + off_m * math.cos(angle), thing_m[1] + off_m * math.sin(angle))
    try:
        found = lift(noun, machine_m, thing_m, bearer, heading_deg)
    except ConfigError as error:
        text = str(error)
        said = re.search(r"needs it (.+) to (.+) m away; give \[(.+), (.+)\], or", text)
        near_m, far_m, x, y = map(float, said.groups())
        assert text.startswith("objects[0].position_m is [")
        assert not near_m + 0.05 < off_m < far_m - 0.05 or noun == "forklift"
        for own, other in (((x, y), thing_m), (None, thing_m), (machine_m, None)):
            check_lift(*lift(noun, own, other, bearer, heading_deg), own, other)
    else:
        check_lift(*found, machine_m, thing_m)
        yaw = found[0].track.at(0.0).yaw
        assert heading_deg is None or yaw == pytest.approx(math.radians(heading_deg))


@for_every(itertools.product(("man", "woman", "hand", "dog"), sorted(HANDLED), (False, True)))
def test_who_handles_a_thing_comes_to_its_stated_place_or_the_file_is_refused(row):
    noun, kind, is_borne = row
    on = (Relation("on", ("table",)),) if is_borne else ()
    bodies = (
        SceneObject(noun, relations=(Relation(kind, ("mug",)),)),
        SceneObject("mug", position_m=(0.5, 0.3), relations=on),
        *[SceneObject("table", position_m=(0.5, 0.3))] * is_borne,
    )
    if kind == "lift" and is_borne and noun != "hand":
        line = r"^objects\[1\]\.position_m is .*has it \S+ m (higher|lower)"
        with pytest.raises(ConfigError, match=line):
            place(*bodies)
        return
    (mug,) = (one for one in place(*bodies) if one.object_index == 1)
    np.testing.assert_allclose(mug.track.at(0.0).position[:2], (0.5, 0.3), atol=0.02)


IDLE = (
    ((Motion("work"), Motion("stand", start_s=1.0)), (), "objects[0].motions[1].kind"),
    ((Motion("stand"), Motion("turn", "left")), (), "objects[0].motions[1].kind"),
    ((Motion("work", pace=2.0),), (), "objects[0].motions[0].pace"),
    ((Motion("work"), Motion("work", start_s=1.0)), (), "objects[0].motions[1].kind"),
    ((), (Motion("slide", "left"),), "objects[1].motions[0].kind"),
)


@for_every(itertools.product(ACTS, IDLE))
def test_motions_that_an_act_of_a_machine_leaves_out_are_refused(row):
    (noun, kind), (own, other, path) = row
    machine = SceneObject(noun, motions=own, relations=(Relation(kind, ("thing",)),))
    things = SceneObject(THINGS[noun], id="thing", motions=other)
    with pytest.raises(ConfigError) as error:
        describe_scene(Scene(objects=(machine, things)), NOUNS)
    assert str(error.value).startswith(f"{path} has no effect: ")


@for_every(ACTS)
def test_a_time_of_the_work_of_a_machine_is_accepted(row):
    noun, kind = row
    motions = Motion("stand"), Motion("work", start_s=0.5)
    machine = SceneObject(noun, motions=motions, relations=(Relation(kind, ("thing",)),))
    describe_scene(Scene(objects=(machine, SceneObject(THINGS[noun], id="thing"))), NOUNS)
