"""Acts on things at hand: each is where its row has it, and a hand or a mouth reaches it."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.scenes.test_short_prompts import is_right, report, staged

from texvent_scenes.checks.bodies.acts import handles
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.description import Claim
from texvent_scenes.models.activities import ACTIVITIES, PERSON_NOUNS, is_mutual, nouns_upon
from texvent_scenes.models.materials import Material
from texvent_scenes.models.people.prop_motions import Emission, Toss
from texvent_scenes.models.shapes import ball
from texvent_scenes.models.tables import trait_values
from texvent_scenes.staging.interactions.rally import PERIOD_S
from texvent_scenes.staging.interactions.striking import contact_time
from texvent_scenes.words import list_verb_forms

from ...every_row import for_every

ACTS = [(name, noun) for name, one in ACTIVITIES.items() if one.upon and not is_mutual(name)
        for noun in sorted(nouns_upon(name))[:2]]  # fmt: skip
BALL = (ball(Material((0.5, 0.5, 0.5)), (0.0, 0.0, 0.0), (0.1, 0.1, 0.1)),)


@for_every(ACTS)
def test_every_act_reaches_what_it_is_done_to(row):
    name, noun = row
    who = "boy" if "pet" in ACTIVITIES[name].verbs else "woman"
    verb, _, rest = ACTIVITIES[name].verbs[0].partition(" ")
    text = f"a {who} {' '.join([list_verb_forms(verb)[2][0], rest])} a {noun}"
    assert is_right(text), report(text)
    people = (one for one in staged(text)[0].actors if one.noun.name in PERSON_NOUNS)
    assert next(people).track.at(0.0).activity == name


@pytest.mark.parametrize("text", ["a boy pets a dog", "a cook slices bread", "a man washes a van"])
def test_what_is_out_of_reach_is_not_acted_on(text):
    scene = staged(text)[0]
    who, what = scene.actors
    claim = Claim("", "act on", "", 0, (1,))
    clip = StagedClip(scene, None, None, 2.0)
    assert handles(clip, claim)
    far = replace(what, track=replace(who.track, start=(9.0, 9.0, 0.0)))
    assert not handles(replace(clip, scene=replace(scene, actors=(who, far))), claim)


@pytest.mark.parametrize(
    ("text", "place"),
    [("a dog catches a frisbee", "mouth"), ("a girl catches a ball", "hands"),
     ("a cat catches a fish", "mouth")],
)  # fmt: skip
def test_what_is_caught_comes_in_free_flight_and_then_stays(text, place):
    who, thing = staged(text)[0].actors
    z = [thing.middle(at)[2] for at in np.arange(0.05, 0.86, 0.1)]
    np.testing.assert_allclose(np.diff(z, 2), -9.81 * 0.1**2, atol=1e-6)
    gaps = [np.linalg.norm(thing.middle(at) - who.anchor(place, at)[:, 3])
            for at in (0.0, 0.899, 0.901, 1.9)]  # fmt: skip
    assert gaps[0] > 0.8
    np.testing.assert_allclose(gaps[1:], gaps[-1], atol=0.03)
    assert is_right(text)


@pytest.mark.parametrize("text", ["a woman pulls a suitcase", "a horse pulls a trailer",
                                  "a boy drags a box along the beach"])  # fmt: skip
def test_what_is_pulled_follows_at_one_distance(text):
    who, thing = staged(text)[0].actors
    way = who.middle(1.9) - who.middle(0.1)
    gaps = [who.middle(at) - thing.middle(at) for at in (0.1, 1.0, 1.9)]
    assert np.linalg.norm(way) > 0.5
    assert all(gap @ way > 0.0 for gap in gaps)
    assert np.ptp([np.linalg.norm(gap[:2]) for gap in gaps]) < 0.05


@pytest.mark.parametrize("text", [
    "a dog with a stick in its mouth", "a fox carries a fish in its mouth",
    "a bear holding a fish in its jaws",
])  # fmt: skip
def test_an_animal_holds_things_in_its_mouth(text):
    who, thing = staged(text)[0].actors
    for at in (0.0, 0.7, 1.8):
        assert np.linalg.norm(who.anchor("mouth", at)[:, 3] - thing.middle(at)) < 0.1
    assert is_right(text)


@pytest.mark.parametrize("text", ["rain falling on a window", "snow falling on a church"])
def test_no_person_is_added_where_something_else_may_do_it(text):
    nouns = {one.noun.name for one in staged(text)[0].actors}
    assert not nouns & PERSON_NOUNS


@pytest.mark.parametrize(
    "text", ["a woman kicks a penalty", "a boy shoots hoops", "a man takes a free kick"]
)
def test_an_object_that_a_phrase_implies_is_there(text):
    assert len(staged(text)[0].actors) == 3  # with the ball and where it is sent
    assert is_right(text)


@pytest.mark.parametrize(
    ("text", "activity"),
    [("a man hits a tennis ball with a racket", "swing racket"),
     ("a batter hits a ball", "swing bat"), ("a woman strikes a volleyball", "hit by hand")],
)  # fmt: skip
def test_what_is_hit_comes_to_what_is_swung_and_flies_back(text, activity):
    who, ball = (staged(text)[0].actors[n] for n in (0, -1 if "racket" not in text else 1))
    contact_s = contact_time(2.0, 0.45)
    assert who.track.at(contact_s).activity == activity
    reach_m = ACTIVITIES[activity].reach_m
    tip = who.anchor("right hand", contact_s) @ [0.0, 0.0, reach_m, 1.0]
    assert np.linalg.norm(ball.middle(contact_s) - tip) < 0.1
    ahead = who.track.at(0.0).to_world()[:, 0]
    ways = [ahead @ (ball.middle(at) - ball.middle(contact_s)) for at in (0.2, 0.7, 1.1)]
    assert ways[0] > ways[1] > 0.0 < ways[2]


@pytest.mark.parametrize(
    "text", ["two men shake hands", "a girl hugs her mother", "a couple kisses"]
)
def test_two_who_act_on_each_other_stand_face_to_face_in_reach(text):
    one, other = staged(text)[0].actors
    gap = other.middle(0.5) - one.middle(0.5)
    assert np.linalg.norm(gap[:2]) < 0.9
    ways = [each.track.at(0.5).to_world()[:2, 0] for each in (one, other)]
    assert ways[0] @ gap[:2] > 0.0 > ways[1] @ gap[:2]
    assert one.track.at(0.5).activity == other.track.at(0.5).activity
    assert is_right(text)


@pytest.mark.parametrize("text", ["a man opens an umbrella", "a boy closes the umbrella",
                                  "a woman shuts her laptop"])  # fmt: skip
def test_what_opens_in_the_hands_moves_its_own_parts(text):
    thing = staged(text)[0].actors[1]
    first, last = (thing.own_parts(thing.pose(at)) for at in (0.0, 1.9))
    gaps = [np.abs(a.to_body - b.to_body).max() for a, b in zip(first, last, strict=True)]
    assert max(gaps) > 0.1
    assert is_right(text)


@pytest.mark.parametrize("text", ["a candle is blown out", "the candle goes out",
                                  "a girl blows out a candle"])  # fmt: skip
def test_a_flame_that_is_put_out_is_seen_no_more(text):
    scene = staged(text)[0]
    lit = [scene.primitives(at).emission.max() for at in (0.2, 1.9)]
    assert lit[0] > 3.0 * lit[1]
    assert is_right(text)


@pytest.mark.parametrize("text", ["a dog digs in the garden", "a cat licks its paw",
                                  "a wolf scratches itself"])  # fmt: skip
def test_a_paw_is_raised_while_others_stay(text):
    (who,) = staged(text)[0].actors
    legs = np.array([[part.to_body[:, 3] for part in who.own_parts(who.pose(at))[-12:]]
                     for at in np.arange(0.0, 1.0, 0.05)])  # fmt: skip
    assert np.ptp(legs, axis=0).max() > 0.01
    assert np.ptp(legs, axis=0).min() < 1e-9
    assert legs[..., 2].max() > 0.1
    assert is_right(text)


@pytest.mark.parametrize("turns", [0.0, 1.0, 2.5])
@pytest.mark.parametrize(("hz", "up"), [(0.8, 0.4), (2.0, 0.1)])
def test_what_is_tossed_is_in_free_flight_turns_so_often_and_then_rests(hz, up, turns):
    toss = Toss(hz=hz, up=up, start=0.25, turns=turns, axis="z")
    times = np.arange(0.0, 2.5, 0.01)
    maps = np.array([toss.place(BALL, at)[0].to_body for at in times])
    height = maps[:, 2, 3]
    is_up = height > 1e-9
    bend = np.diff(height, 2)[is_up[:-2] & is_up[1:-1] & is_up[2:]]
    np.testing.assert_allclose(bend, -9.81 * 1e-4, rtol=1e-6)
    assert height.max() == pytest.approx(up, abs=1e-3)
    assert (height[~is_up] == 0.0).all()
    turned = np.unwrap(np.arctan2(maps[:, 1, 0], maps[:, 0, 0]))
    rate = 2.0 * np.pi * turns / np.sqrt(8.0 * up / 9.81)
    steps = np.diff(turned)[is_up[:-1] & is_up[1:]] / 0.01
    np.testing.assert_allclose(steps, rate, atol=1e-6)


@given(hz=st.floats(1.0, 9.0), lasts_s=st.floats(0.3, 2.0), at=st.floats(-3.0, 9.0))
def test_copies_leave_one_by_one_each_on_its_own_way_and_slow_down(hz, lasts_s, at):
    count = max(round(hz * lasts_s), 1)
    for drag, spread in itertools.product((0.0, 0.7, 3.0), (0.0, 0.5)):
        emission = Emission(hz, lasts_s, (2.0, 0.0, 1.0), spread, drag=drag)
        *places, again = (
            np.array([one.to_body[:, 3] for one in emission.place(BALL, at + step_s)])
            for step_s in (0.0, 0.01, 0.02, count / hz)
        )
        ways = np.diff(places, axis=0)
        flies = (ways[..., 0] > 0.0).all(axis=0) & (places[0][:, 0] > 0.02)  # neither new nor gone
        np.testing.assert_allclose(ways[1, flies], np.exp(-0.01 * drag) * ways[0, flies], atol=1e-9)
        speeds = ways[0, flies] / 0.01 + drag * places[0][flies]
        assert (np.abs(speeds - (2.0, 0.0, 1.0)) <= spread + 0.06).all()
        assert (np.abs(again - places[0]) > 1e-6)[flies].any() == (spread > 0.0 and flies.any())


TEXTS = ["two boys play table tennis", "two girls play badminton", "a table tennis rally",
         "two women play badminton", "a woman plays badminton", "a tennis match",
         "two men play ping pong"]  # fmt: skip


def _cast(text):
    """Players, the ball, and what they play over."""
    actors = staged(text)[0].actors
    players = [one for one in actors if one.noun.name in PERSON_NOUNS]
    court = next(one for one in actors if one.noun.name in trait_values("rally"))
    return [*players, *(one for one in actors if one not in (*players, court)), court]


@pytest.mark.parametrize("text", TEXTS)
def test_each_player_hits_the_ball_once_in_a_period(text):
    said = report(text)
    assert [*said.not_understood, *said.not_shown, *said.out_of_view] == []
    *players, ball, court = _cast(text)
    first, second = players
    assert court.noun.name in trait_values("rally")
    act = ACTIVITIES[first.track.at(0.0).activity]
    low_m = 0.5 * ball.model.height + 0.76 * trait_values("rally")[court.noun.name]["bounces"]
    for player, at in ((first, act.contact_s), (second, act.contact_s + 0.5 * PERIOD_S)):
        for hit_s in (at, at + PERIOD_S):
            reach = [0.0, 0.0, act.reach_m * player.model.scale, 1.0]
            tip = player.anchor("right hand", hit_s) @ reach
            tip[2] = max(tip[2], low_m + 0.1)  # a child reaches over a table
            np.testing.assert_allclose(ball.middle(hit_s), tip, atol=0.03)
    assert abs(first.middle(0.0)[0] - second.middle(0.0)[0]) > court.model.length


@pytest.mark.parametrize("text", TEXTS)
def test_between_two_hits_the_ball_falls_freely_and_stays_above_what_it_bounces_on(text):
    *_, ball, court = _cast(text)
    times = np.arange(0.0, 3.0, 0.01)
    middle = np.array([ball.middle(at) for at in times])
    assert np.abs(np.diff(middle, axis=0)).max() < 0.12
    bends = np.diff(middle[:, 2], 2) / 0.01**2
    assert np.mean(np.abs(bends + 9.81) < 0.05) > 0.9
    if trait_values("rally")[court.noun.name]["bounces"]:
        assert middle[:, 2].min() == pytest.approx(0.76 + 0.5 * ball.model.height, abs=0.05)
