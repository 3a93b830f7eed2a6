"""Stated places and headings of bodies in relations and acts: angles, and what is so anyway."""

import itertools
from typing import get_args

import numpy as np
from tests.scenes.every_row import for_every
from tests.scenes.staging.interactions.test_stated_acts import (
    BODIES,
    KINDS,
    accepted,
    act,
    alike,
    paths,
)

from texvent_scenes.spec.scene import RelationKind

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
