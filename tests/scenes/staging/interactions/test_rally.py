"""Rallies: the ball goes to and fro between the rackets of two players, in free flight."""

import numpy as np
import pytest
from tests.scenes.test_short_prompts import report, staged

from texvent_scenes.models.activities import ACTIVITIES, PERSON_NOUNS
from texvent_scenes.models.tables import trait_values
from texvent_scenes.staging.interactions.rally import PERIOD_S

TEXTS = [
    "a table tennis rally",
    "two women play badminton",
    "a woman plays badminton",
    "a tennis match",
    "two men play ping pong",
]


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
    for player, at in ((first, act.contact_s), (second, act.contact_s + 0.5 * PERIOD_S)):
        for hit_s in (at, at + PERIOD_S):
            reach = [0.0, 0.0, act.reach_m * player.model.scale, 1.0]
            tip = player.anchor("right hand", hit_s) @ reach
            np.testing.assert_allclose(ball.middle(hit_s), tip, atol=0.02)
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
