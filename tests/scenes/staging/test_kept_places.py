"""Places and headings that are kept: stated ones, and those of bodies on, at or down others."""

import itertools
from typing import get_args

import numpy as np
from tests.scenes.every_row import for_every
from tests.scenes.staged import road_of, stage
from tests.scenes.staging.interactions.test_stated_acts import (
    BODIES,
    KINDS,
    TIMES,
    accepted,
    act,
    alike,
    paths,
)

from texvent_scenes.models.activities import TIMED
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with, trait_values
from texvent_scenes.spec.scene import Motion, Relation, RelationKind, SceneObject

OF_NO_TIE = sorted({*get_args(RelationKind)} - {"off"})  # both sides of an even thing are as near


@for_every(itertools.product(OF_NO_TIE, BODIES[::3], (0, 1), (0.0, 100.0)))
def test_a_heading_a_full_turn_away_is_the_same(row):
    kind, pair, turned, heading = row
    said = ([{"heading_deg": one} if n == turned else {} for n in (0, 1)]
            for one in (heading, heading - 360.0))  # fmt: skip
    one, other = (accepted(*act(kind, pair, *each)) for each in said)
    is_same = one == other if None in (one, other) else alike(paths(one), paths(other))
    assert is_same


@for_every(itertools.product(sorted({*KINDS} - {"hold", "wear"}), BODIES, (0, 1)))
def test_what_is_so_anyway_may_be_stated(row):
    kind, pair, which = row
    usual = {
        one.object_index: one.track.at(0.0) for one in accepted(*act(kind, pair, {}, {})) or ()
    }
    if which in usual:
        (x, y, _), yaw = usual[which].position, np.degrees(usual[which].yaw)
        for said in ({"position_m": (x, y)}, {"heading_deg": yaw % 360.0 - 360.0 * which}):
            assert accepted(*act(kind, pair, *(said if n == which else {} for n in (0, 1))))


def frame(body, time_s):
    """[4, 4] from a body to the world."""
    return np.vstack([body.track.at(time_s).to_world(), [0.0, 0.0, 0.0, 1.0]])


BORNE = ("man", "table", "mug"), ("car", "box", "book"), ("dog", "chair", "vase")


@for_every(itertools.product(KINDS, BORNE, ((0, 1), (1, 0))), is_quick=True)
def test_what_is_on_a_thing_goes_along_wherever_an_act_moves_that(row):
    kind, (who, below, noun), order = row
    borne = [SceneObject(noun, relations=(Relation("on", (below,)),)),
             SceneObject("coin", relations=(Relation("on", (noun,)),))]  # fmt: skip
    bodies = accepted(*act(kind, (who, below), {}, {}), *(borne[n] for n in order)) or ()
    own = {one.noun.name: one for one in bodies}
    for one in (noun, "coin") if len(own) == 4 else ():
        there = [np.linalg.solve(frame(own[below], t), frame(own[one], t)) for t in TIMES[::4]]
        assert np.ptp(there, axis=0).max() < 1e-6


GOERS = (
    ("truck", Motion("drive", "left")), ("man", Motion("walk", "right")),
    ("boat", Motion("sail", "towards")), ("turntable", Motion("spin")),
    ("conveyor belt", Motion("work", "left")), ("box", Motion("slide", "away")),
)  # fmt: skip
STACKS = (
    ("box", "on", "mug"),
    ("table", "on", "man"),
    ("bowl", "in", "apple"),
    ("chair", "on", "cat"),
)


@for_every(itertools.product(GOERS, STACKS, ((0, 1, 2), (2, 1, 0))), is_quick=True)
def test_what_is_on_or_in_a_thing_on_what_goes_is_taken_along(row):
    (goer, motion), (noun, how, top), order = row
    objects = (SceneObject(goer, id="goer", motions=(motion,)),
               SceneObject(noun, id="below", relations=(Relation("on", ("goer",)),)),
               SceneObject(top, relations=(Relation(how, ("below",)),)))  # fmt: skip
    bodies = accepted(*(objects[n] for n in order)) or ()
    own = {order[one.object_index]: one for one in bodies}
    if len(own) == 3:
        there = [np.linalg.solve(frame(own[1], t), frame(own[2], t)) for t in TIMES[::4]]
        assert np.ptp(there, axis=0).max() < 1e-6


@for_every(itertools.product(sorted(trait_values("slope")), ("man", "dog", "ball"), (2, 3),
                             (30.0, 120.0, None)))  # fmt: skip
def test_those_who_go_down_a_slope_do_so_side_by_side_if_it_is_as_wide(row):
    slope, noun, count, heading_deg = row
    down = (Relation("down", (slope,)),)
    *own, below = accepted(SceneObject(noun, count=count, relations=down),
                           SceneObject(slope, heading_deg=heading_deg))  # fmt: skip
    wide = 1.2 * max(one.model.width for one in own)
    for time_s in (0.0, 0.3):
        starts = [np.linalg.solve(frame(below, time_s), frame(one, time_s))[:2, 3] for one in own]
        along, across = np.transpose(starts)
        if count * wide <= below.model.width:
            np.testing.assert_allclose(along, along[0], atol=1e-6)
            np.testing.assert_allclose(
                across, wide * (np.arange(count) - 0.5 * (count - 1)), atol=1e-6
            )


OPENED = [one.name for one in NOUNS.values() if one.acts & TIMED]


@for_every(itertools.product(OPENED, ("man", "girl"), (None, 50.0, 200.0)))
def test_who_is_at_what_opens_is_before_it_and_turned_to_it(row):
    noun, who, heading_deg = row
    person, thing = accepted(SceneObject(who, relations=(Relation("at", (noun,)),)),
                             SceneObject(noun, heading_deg=heading_deg))  # fmt: skip
    own = np.linalg.solve(frame(thing, 0.0), frame(person, 0.0))
    assert own[0, 3] > 0.5 * thing.model.length
    np.testing.assert_allclose(own[:2, 0], (-1.0, 0.0), atol=1e-6)


@for_every(itertools.product(sorted(nouns_with("on a road")), (-3.0, 0.0, 40.0)))
def test_a_road_is_where_what_stands_on_it_is(row):
    noun, y = row
    scene = stage(SceneObject(noun, position_m=(1.0, y)), place="road")
    line, half_m = road_of(scene)
    middles = np.array([one.middle(0.0)[:2] for one in scene.actors])
    assert np.abs(line.across(middles)).max() < half_m
