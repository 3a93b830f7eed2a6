"""Tables of people: tracks by hand, what is worn and held, and that every entry can be drawn."""

import math
from dataclasses import fields

import pytest

from texvent.scenes.models.people import person
from texvent.scenes.models.people.activities import ACTIVITIES, PERSON_NOUNS, Activity
from texvent.scenes.models.people.movements import find_track
from texvent.scenes.models.people.outfit import (
    ADULT,
    CLOTHES,
    KINDS,
    PersonKind,
    draw_parts,
    dress_person,
    put_on,
    read_table,
)
from texvent.scenes.models.people.props import HOLDS, PROPS
from texvent.scenes.models.people.track import read_track
from texvent.scenes.models.protocol import Pose

BODY_CHANNELS = {
    *("hips", "lean", "tilt", "turn", "nod", "look", "heading", "tool"),
    *(f"{arm}.{what}" for arm in ("left", "right", "arms") for what in ("hand", "elbow", "fixed")),
    *(f"{leg}.{what}" for leg in ("left_leg", "right_leg", "legs") for what in
      ("foot", "knee", "pitch")),
}  # fmt: skip
HAND_CHANNELS = {"bent", "spread", "roll", "pitch", "yaw", "shift", "keys"}
RED, BLUE = (0.5, 0.0, 0.0), (0.0, 0.0, 0.5)


def test_a_track_by_hand():
    track = read_track(
        {
            "lean": [0.2, 0.1, 0.5],
            "right": {"hand": [0.3, [0.0, 1.0, 2.0, 0.25, 0.5, 1.0], -0.1]},
            "keys": {"at_s": [0.0, 1.0], "right": {"hand": [[0, 0, 0], [0, 0, 1]]}, "nod": [0, 2]},
        }
    )
    values = track.at(0.5)
    assert values["lean"] == pytest.approx((0.3,))
    assert values["nod"] == pytest.approx((1.0,))
    wave = math.sin(2.0 * math.pi * 1.25) + 0.5 * math.sin(math.pi)
    assert values["right.hand"] == pytest.approx((0.3, wave, 0.4))
    assert track.at(7.0)["nod"] == (2.0,)


@pytest.mark.parametrize("noun", sorted(PERSON_NOUNS))
def test_every_person_is_drawn_and_stands_on_the_ground(noun):
    model = person.build_person(KINDS[noun], colour=None, scale=1.0, seed=3)
    assert model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    assert model.height == pytest.approx(1.75 * KINDS[noun].height, rel=0.15)


def test_every_key_of_the_tables_is_read():
    activity = {one.name for one in fields(Activity)}
    kind = {one.name for one in fields(PersonKind)} | {"names", "plurals", "speed", "motion"}
    for row in read_table("hand_gestures").values():
        assert set(row) <= activity | HAND_CHANNELS
    for row in read_table("outfits")["people"].values():
        assert set(row) <= kind | {"holds"}
    for noun, row in CLOTHES.items():
        assert set(row) <= kind | {"painted", "usual"}, noun
    for name in ACTIVITIES:
        track = find_track(name)
        if track is None:
            continue
        channels = {*track.series, *(one for keys in track.keyed for one, _ in keys.channels)}
        assert channels <= BODY_CHANNELS, name


def test_every_prop_hat_and_garment_can_be_drawn():
    for props in (*PROPS.values(), *HOLDS.values()):
        assert all(prop.draw(0.3) for prop in props)
    assert set(PROPS) <= set(ACTIVITIES)
    for group in ("hats", "garments"):
        for name in read_table("outfits")[group]:
            assert draw_parts("outfits", group, name, dress_person(ADULT, colour=None, seed=0).hat)


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
