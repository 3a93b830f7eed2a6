"""What a file states of bodies in acts is kept, or refused: places, headings, times, motions."""

import itertools
import re
from typing import get_args

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import place

from texvent.errors import ConfigError
from texvent.sensor import SensorSize
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.scene_input import describe_scene
from texvent_scenes.spec.data import SENT, of_file, scene_from_data
from texvent_scenes.spec.scene import Motion, Relation, RelationKind, Scene, SceneObject
from texvent_scenes.staging.interactions.by_hand import BY_HAND
from texvent_scenes.staging.interactions.perform import ACTS
from texvent_scenes.staging.interactions.striking import IMPACTS, LEAD_S

BODIES = (("man", "ball"), ("woman", "box"), ("hand", "mug"), ("dog", "ball"), ("car", "box"),
          ("robot arm", "mug"), ("man", "horse"), ("man", "bicycle"))  # fmt: skip
KINDS = sorted(set(get_args(RelationKind)) & set(ACTS))
PLACES = ((None, (2.0, 1.0)), ((2.0, 1.0), None), ((0.0, 1.0), (2.0, 1.0)),
          ((0.0, 1.0), (0.0, 2.5)))  # fmt: skip
TIMES = np.linspace(0.0, 1.9, 20)


def act(kind, pair, *fields):
    """Both objects of an act."""
    who, what = (SceneObject(noun, **own) for noun, own in zip(pair, fields, strict=True))
    relation = Relation(kind, (what.noun,))
    return SceneObject(**{**vars(who), "relations": (relation,)}), what


def accepted(*objects):
    """The bodies of a file; None: it is refused."""
    try:
        describe_scene(Scene(objects=objects), NOUNS)
        return place(*objects)
    except ConfigError:
        return None


def paths(bodies):
    return [(one.object_index, [one.track.at(t).to_world() for t in TIMES],
             [one.pose(t) for t in TIMES]) for one in bodies]  # fmt: skip


def alike(one, other):
    return len(one) == len(other) and all(
        a[0] == b[0] and a[2] == b[2] and np.allclose(a[1], b[1])
        for a, b in zip(one, other, strict=True)
    )


@for_every(itertools.product(KINDS, BODIES, PLACES))
def test_bodies_of_an_act_begin_where_they_are_stated_or_the_file_is_refused(row):
    kind, pair, places = row
    objects = act(kind, pair, *({"position_m": one} for one in places))
    for one in accepted(*objects) or ():
        said = objects[one.object_index].position_m
        reach = 1.0 if kind == "ride" else 0.02
        if said is not None:
            assert np.hypot(*np.subtract(one.track.at(0.0).position[:2], said)) <= reach


@for_every(
    itertools.product(
        [one for one in KINDS if one not in ("ride", "rally")], BODIES[:6], (0, 1), (-30.0, 100.0)
    )
)
def test_bodies_of_an_act_have_their_stated_headings_or_the_file_is_refused(row):
    kind, pair, turned, heading = row
    fields = [{"heading_deg": heading} if n == turned else {} for n in (0, 1)]
    for one in accepted(*act(kind, pair, *fields)) or ():
        if one.object_index == turned:
            off = np.radians(heading) - one.track.at(0.0).yaw
            assert np.cos(off) == pytest.approx(1.0, abs=1e-3)


MOTIONS = (Motion("walk", "left", speed_m_s=1.0), Motion("drive", "away"), Motion("jump"),
           Motion("spin", rate_hz=0.4), Motion("roll", "right", start_s=0.7))  # fmt: skip


@for_every(itertools.product([one for one in KINDS if one != "wear"], BODIES, (0, 1), MOTIONS))
def test_a_motion_of_a_body_in_an_act_changes_something_or_is_refused(row):
    kind, pair, mover, motion = row
    fields = [{"motions": (motion,)} if n == mover else {} for n in (0, 1)]
    bodies = accepted(*act(kind, pair, *fields))
    usual = accepted(*act(kind, pair, {}, {}))
    if bodies is not None and usual is not None:
        assert not alike(paths(bodies), paths(usual))


@for_every(itertools.product(
    [kind for kind, one in IMPACTS.items() if one.activity is not None and kind in KINDS],
    (("man", "ball"), ("woman", "box"), ("hand", "mug")), (0.0, 0.4, 1.0),
))  # fmt: skip
def test_an_act_begins_at_its_stated_time(row):
    kind, pair, start_s = row
    if pair[0] == "hand" and kind not in BY_HAND:
        return
    doing = IMPACTS[kind].activity
    bodies = accepted(*act(kind, pair, {"motions": (Motion(doing, start_s=start_s),)}, {}))
    assert bodies is not None
    contact_s, (who, thing) = start_s + LEAD_S, bodies
    assert pair[0] == "hand" or who.track.contact_s == pytest.approx(contact_s)
    steps = [np.linalg.norm(np.subtract(*(thing.track.at(t + d).position for d in (0.01, 0.0))))
             for t in (contact_s - 0.03, contact_s + 0.03)]  # fmt: skip
    assert abs(steps[0] - steps[1]) > 1e-4 or kind == "roll"


@for_every(itertools.product(BY_HAND, ("mug", "bottle", "ball", "hammer", "box"), (False, True)))
def test_a_hand_alone_does_its_act_from_where_the_thing_is(row):
    kind, noun, is_borne = row
    on = (Relation("on", ("table",)),) if is_borne else ()
    table = (SceneObject("table"),) * is_borne
    who, thing = act(kind, ("hand", noun), {}, {"relations": on})
    bodies = accepted(who, thing, *table)
    assert bodies is not None
    moved = next(one for one in bodies if one.noun.name == noun)
    first, last = moved.lowest_m(0.0), moved.lowest_m(1.95)
    level = next((one.model.height for one in bodies if one.noun.name == "table"), 0.0)
    low, high = (first, last) if kind == "lift" else (last, first)
    assert low == pytest.approx(level, abs=0.03)
    assert high - low > 0.25


def test_only_the_first_of_several_targets_is_acted_on_and_others_are_refused():
    boxes = (SceneObject("box"), SceneObject("box"))
    who = SceneObject("man", relations=(Relation("push", ("box", "box 2")),))
    with pytest.raises(ConfigError, match=r"objects\[0\]\.relations\[0\]\.to\[1\] has no effect"):
        describe_scene(Scene(objects=(who, *boxes)), NOUNS)


@for_every(itertools.product(
    (("kick", "ball"), ("throw", "frisbee"), ("roll", "ball")), ("woman", "dog"),
    ("sender", "thing", "catch"), ((None, None), (None, (-3.0, 1.5)), ((-2.0, 0.0), (2.5, 1.0))),
))  # fmt: skip
def test_what_is_sent_comes_from_the_sender_to_who_receives_it_wherever_both_are(row):
    (kind, noun), other, way, (here, there) = row
    to = Relation("towards", (other,))
    sent = Relation(kind, (noun,))
    who = SceneObject("man", position_m=here, relations=(sent, *[to] * (way == "sender")))
    thing = SceneObject(noun, relations=(to,) * (way == "thing"))
    caught = (Relation("catch", (noun,)),) * (way == "catch")
    receiver = SceneObject(other, position_m=there, relations=caught)
    bodies = accepted(who, thing, receiver)
    assert bodies is not None
    man, ball, last = sorted(bodies, key=lambda one: one.object_index)
    for one, said in ((man, here), (last, there)):
        if said is not None:
            np.testing.assert_allclose(one.track.at(0.0).position[:2], said, atol=0.02)
    assert np.hypot(*(ball.middle(0.0) - man.middle(0.0))[:2]) < 0.9
    assert np.hypot(*(ball.middle(1.95) - last.middle(1.95))[:2]) < 1.1
    assert np.hypot(*(last.middle(1.95) - man.middle(1.95))[:2]) > 1.2


@for_every(itertools.product(
    (("kick", "ball"), ("kick", "football"), ("throw", "ball"), ("roll", "ball")),
    ("woman", "goalkeeper"), (None, (2.5, 0.0), (0.5, 4.0)), (False, True),
))  # fmt: skip
def test_what_one_sends_is_in_the_hands_of_who_catches_it_at_the_end(row):
    (kind, noun), other, there, is_aimed = row
    sent = (Relation(kind, (noun,)), *(Relation("towards", (other,)),) * is_aimed)
    who = SceneObject("man", position_m=None if there is None else (0.0, 0.0), relations=sent)
    keeper = SceneObject(other, position_m=there, relations=(Relation("catch", (noun,)),))
    bodies = accepted(who, SceneObject(noun), keeper)
    assert bodies is not None
    _, ball, last = sorted(bodies, key=lambda one: one.object_index)
    hands = last.anchor("hands", 1.99)[:, 3]
    assert np.linalg.norm(ball.middle(1.99) - hands) < 0.5 * ball.model.height + 0.2
    assert np.linalg.norm(ball.middle(0.0) - last.anchor("hands", 0.0)[:, 3]) > 0.8


@for_every(itertools.product(
    [kind for kind in KINDS if kind in IMPACTS], [kind for kind in KINDS if kind in IMPACTS],
    (0, 1),
))  # fmt: skip
def test_a_body_in_a_second_impact_is_refused_but_for_what_is_caught(row):
    first, second, by = row
    acts = [Relation(first, ("ball",)), Relation(second, ("ball",))]
    people = [SceneObject("man", relations=(acts[0], *acts[1:] * (by == 0))),
              SceneObject("woman", relations=(*acts[1:] * (by == 1),))]  # fmt: skip
    bodies = accepted(*people, SceneObject("ball"))
    is_caught = by == 1 and "catch" in (first, second) and {first, second} & {*SENT}
    assert (bodies is not None) == bool(is_caught)


@for_every(itertools.product(SENT, ("woman", "child", "dog"), ("ball", "football", "tennis ball"),
                             (None, (3.0, 2.0), (-4.0, -1.0))))  # fmt: skip
def test_what_is_sent_ends_at_who_catches_it_and_begins_apart_from_there(row):
    kind, who, what, at_m = row
    sender = SceneObject("man", relations=(Relation(kind, (what,)),),
                         position_m=None if at_m is None else (0.0, 0.0))  # fmt: skip
    catcher = SceneObject(who, relations=(Relation("catch", (what,)),), position_m=at_m)
    _, receiver, thing = place(sender, catcher, SceneObject(what))
    gaps = [float(np.linalg.norm(thing.middle(t) - receiver.middle(t)))
            for t in np.linspace(0.0, 2.0, 41)]  # fmt: skip
    assert min(gaps[-2:]) < 0.7 * receiver.size_m
    assert gaps[0] > receiver.size_m * 0.5
    assert min(gaps) > gaps[-1] - 0.1  # it does not go through the receiver


PAIRS = (("child", "ball"), ("robot arm", "cup"), ("woman", "box"))
STATED = ({"position_m": [4.1, 1.9]}, {"position_m": [0.0, 0.3], "heading_deg": 33.0},
          {"height_m": 2.4, "position_m": [1.0, 1.0]})  # fmt: skip


@for_every(itertools.product(PAIRS, ("kick", "lift", "catch", "hit", "set down"), STATED))
def test_refusals_of_a_staged_file_name_it_and_say_what_to_do(row):
    (who, what), kind, fields = row
    holder = {"noun": who, "relations": [{"kind": kind, "to": [what]}], "position_m": [1.1, 1.9]}
    table = {"objects": [{**holder, "heading_deg": 120.0}, {"noun": what} | fields]}
    scene = of_file(scene_from_data(table), "folder/acts.toml")
    generator = ProceduralGenerator(ProceduralConfig(), size=SensorSize(64, 48))
    try:
        text = str(generator.report(scene) and "")
    except ConfigError as error:
        text = str(error)
    line = r"folder/acts\.toml: objects\[\d\][\w.\[\]]+ (is|has) .*[;,] (or )?(give|leave)"
    assert not text or re.match(line, text), text
    assert text.count("acts.toml") <= 1
