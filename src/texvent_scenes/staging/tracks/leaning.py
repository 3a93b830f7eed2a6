"""Leaning of what stands: it sways or tilts, and its lowest point stays on what it stands on."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from texvent_scenes.models.protocol import Model, Pose
from texvent_scenes.models.shapes import half_extents
from texvent_scenes.rendered_scene import Float64Array, Shape
from texvent_scenes.staging.tracks.track import Lift, Term, Track, rotation

_STEPS, _MOST_RAD = 33, 1.5
"""Angles of a table of heights; lean from which on a body lies or turns over instead."""


def keep_up(track: Track, model: Model) -> Track:
    """The track of a body that stands, which rises as it leans by what would be below its foot."""
    lifts = tuple(_list_lifts(track, model))
    return replace(track, lifts=lifts) if lifts else track


def _list_lifts(track: Track, model: Model) -> Iterator[Lift]:
    for channel in ("roll", "pitch"):
        most = sum(_reach(one) for one in track.terms if one.channel == channel)
        if not 0.0 < most < _MOST_RAD:
            continue
        angles = np.linspace(-most, most, _STEPS)
        turns = [rotation(0.0, *((0.0, one) if channel == "roll" else (one, 0.0)))
                 for one in angles]  # fmt: skip
        lows = _lowest_m(model, np.array(turns), track.radius_m or track.pivot_m)
        heights = lows[_STEPS // 2] - lows  # below 0 of what stands beside its origin
        yield Lift(channel, tuple(map(float, angles)), tuple(map(float, heights)))


def _reach(term: Term) -> float:
    """Most turn of a term; infinite of one that goes on."""
    span_s = term.end_s - term.begin_s
    drifted = abs(term.drift) * span_s if term.drift else 0.0
    is_early = math.isfinite(term.begin_s) and term.drift
    first = abs(term.offset + term.drift * term.begin_s) if is_early else abs(term.offset)
    return abs(term.amplitude) + first + drifted + (math.inf if term.gain else 0.0)


def _lowest_m(model: Model, turns: Float64Array, pivot_m: float) -> Float64Array:
    """[k] height of the lowest point of a body at rest, turned by `turns` [k, 3, 3], m."""
    placed: dict[Shape, list[Float64Array]] = {}
    for each in model.parts(Pose(0.0, 0.0, 0.0, "stand")):
        placed.setdefault(each.shape, []).append(np.array(each.to_body))
    lows = []
    for shape, maps in placed.items():
        about = np.array(maps)
        about[:, 2, 3] -= pivot_m
        lows.append(half_extents(shape, turns[:, None] @ about)[0][..., 2].min(axis=1))
    return np.asarray(np.min(lows, axis=0) + pivot_m)
