"""Tables of people: tracks by hand, what is worn and held, and that every entry can be drawn."""

import math

import pytest

from texvent.scenes.models.people import person
from texvent.scenes.models.people.activities import ACTIVITIES, PERSON_NOUNS
from texvent.scenes.models.people.outfit import (
    ADULT,
    CLOTHES,
    KINDS,
    draw_parts,
    dress_person,
    put_on,
    read_table,
)
from texvent.scenes.models.people.props import HOLDS, PROPS
from texvent.scenes.models.people.track import read_track
from texvent.scenes.models.protocol import Pose

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
