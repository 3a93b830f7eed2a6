"""People: the figure of `data/outfits.toml` on the skeleton of all models, in clothes; riders."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache, lru_cache, partial
from typing import Any

import numpy as np

from texvent_scenes.models.channel_track import flattened
from texvent_scenes.models.gait import read_gaits
from texvent_scenes.models.joints import Instant
from texvent_scenes.models.limbs import read_limbs
from texvent_scenes.models.materials import STEEL, Material
from texvent_scenes.models.people.outfit import ADULT, KINDS, PersonKind, Worn, dress_person, put_on
from texvent_scenes.models.postures import Postures
from texvent_scenes.models.protocol import ModelPart, Noun, Pose
from texvent_scenes.models.shapes import Affine, ArticulatedModel, Point, point, rod, spike
from texvent_scenes.models.skeleton import Anchor, Body, Maps, PartGroup, read_anchor, read_skeleton
from texvent_scenes.models.tables import fill_in, read_table
from texvent_scenes.rendered_scene import Colour

HEAD_SIZE = 0.23
"""Height of an adult's head, m."""
SEAT = 0.42
"""Height of the chair on which one sits, m: hips are a little above it."""


def build_person(
    kind: PersonKind, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a person; `colour` is the shirt or dress."""
    body = build_body(kind, colour, seed)
    return _usual_person(kind).scaled(scale * kind.height, body.articulate)


@cache
def _usual_person(kind: PersonKind) -> ArticulatedModel:
    """A person in any clothes: all of a kind have the same shapes."""
    body = build_body(kind, None, 0)
    return ArticulatedModel([], articulate=body.articulate, anchor=body.locate)


@lru_cache(maxsize=256)
def build_body(kind: PersonKind, colour: Colour | None, seed: int) -> Body:
    """A dressed figure at an adult's size."""
    groups, postures, anchors = _read_figure(kind)
    outfit = dress_person(kind, colour=colour, seed=seed)
    return Body(
        seed,
        partial(_observe, postures),
        [(one, outfit.draw(one.parts)) for one in groups],
        anchors,
        [partial(_draw_skirt, outfit.material("shirt"))] if kind.dress == "skirt" else [],
        limbs=[(one, one.draw(outfit)) for one in postures.limbs],
        walk=postures.walk,
    )


def _observe(postures: Postures, pose: Pose, seed: int) -> dict[str, float]:
    """Channels of a person; one who lies has no direction in which the knees go with the torso."""
    found = postures.at(pose, seed)
    stance = found["turn"] if abs(found["lean"][0]) < 1.0 else (0.0,)
    return flattened({**found, "stance": stance})


@cache
def _read_figure(
    kind: PersonKind,
) -> tuple[tuple[PartGroup, ...], Postures, Mapping[str, Anchor]]:
    """Groups, postures and anchors of `figure` in `data/outfits.toml`, with what the kind wears."""
    outfits = read_table("outfits")
    sizes = {"size": HEAD_SIZE * kind.head, "hair": 0.80 if kind.hat else 0.92}
    row = fill_in({**outfits["figure"], "sizes": sizes})
    texts = [row["torso"], *(outfits["garments"][one] for one in kind.garments), row["head"]]
    texts += [row["long_hair"]] if kind.long_hair else []
    texts += [row["hat"], outfits["hats"][kind.hat]] if kind.hat else []
    _, groups = read_skeleton([("\n".join(texts), False)])
    limbs = read_limbs(row["limbs"])
    postures = Postures("activities", limbs, read_gaits("activities", "run" if kind.runs else ""))
    names = {*(one.name for one in groups), *(one.name for one in limbs)}
    return groups, postures, {key: read_anchor(text, names) for key, text in row["anchors"].items()}


def _draw_skirt(cloth: Material, _: Instant, maps: Maps) -> list[ModelPart]:
    """A cone from chest to knees; of a seated person it begins lower and is narrower."""
    torso, *shins = (
        np.asarray(maps[name]) for name in ("torso", "lower left foot", "lower right foot")
    )
    hips = torso[:, 3]
    thigh = 0.5 * (shins[0] + shins[1])[:, 3] - hips
    level = float(np.linalg.norm(thigh[:2])) / max(float(np.linalg.norm(thigh)), 1e-9)
    level = max(level - 0.5, 0.0) * 2.0
    tip = torso @ np.array([0.02, 0.0, 0.46 - 0.34 * level, 1.0])
    return [spike(cloth, point(hips + 1.12 * thigh), point(tip), 0.33 - 0.15 * level)]


_GEAR = 0.45
"""Turns of the pedals per turn of the wheels."""
_CRANK_M = 0.17


@dataclass(frozen=True)
class Rider:
    """Contact points of a rider on a cycle, m; the right hand and pedal mirror the left ones."""

    hips: Point
    neck: Point
    grip: Point
    crank: Point
    wheel: float
    """Radius of the wheels."""

    def draw(self, seed: int, distance_m: float) -> list[ModelPart]:
        """The rider and the pedals after a distance."""
        now, pedals = self._pose(seed, distance_m)
        return [*pedals, *build_body(ADULT, None, seed).draw(now)]

    def locate(self, seed: int, name: str, distance_m: float) -> Affine | None:
        """Axes [3, 4] at a named place of the rider after a distance."""
        return build_body(ADULT, None, seed).locate_at(name, self._pose(seed, distance_m)[0])

    def _pose(self, seed: int, distance_m: float) -> tuple[Instant, list[ModelPart]]:
        """State of the rider, and the pedals."""
        turn, pedals = _GEAR * distance_m / self.wheel, []
        lean = math.atan2(self.neck[0] - self.hips[0], self.neck[2] - self.hips[2])
        postures = _read_figure(ADULT)[1]
        limbs = {limb.name: limb for limb in postures.limbs}
        posture = {
            **postures.standing,
            "hips": self.hips,
            "lean": (lean,),
            "nod": (-lean,),
            "stance": (0.0,),
        }
        x, y, z = self.grip
        for word, side, phase in (("left", 1.0, 0.0), ("right", -1.0, math.pi)):
            ahead, up = (_CRANK_M * wave(turn + phase) for wave in (math.sin, math.cos))
            pedal = (self.crank[0] + ahead, side * self.crank[1], self.crank[2] + up)
            axle = (self.crank[0], side * (self.crank[1] - 0.03), self.crank[2])
            pedals.append(rod(STEEL, axle, pedal, 0.018))
            foot = (pedal[0] - 0.04, self.crank[1], pedal[2] + 0.10)
            posture |= limbs[f"{word} foot"].at(foot, (1.0, 0.0, 0.35), pitch=0.15)
            posture |= limbs[f"{word} hand"].at((x, y, z + 0.02), (-0.3, 0.5, -1.0))
        return Instant(Pose(0.0, distance_m, 0.0), seed, flattened(posture)), pedals


def read_rider(table: Mapping[str, Any]) -> Rider:
    """A rider from a noun's table.

    Raises:
        ValueError: a place is missing or no point.
    """
    wanted = ("hips", "neck", "grip", "crank")
    if set(table) != {*wanted, "wheel"}:
        raise ValueError(f"a rider has {', '.join(wanted)} and wheel, not {', '.join(table)}")
    hips, neck, grip, crank = (point(table[name]) for name in wanted)
    return Rider(hips, neck, grip, crank, float(table["wheel"]))


def dress(noun: Noun, worn: Iterable[Worn]) -> Noun:
    """The noun of a person, whose builder is made of its `PersonKind`, in what it wears."""
    build: Any = noun.build
    return replace(noun, build=partial(build.func, put_on(build.args[0], worn)))


def _read_noun(name: str, row: Mapping[str, Any]) -> Noun:
    return Noun(
        name,
        partial(build_person, KINDS[name]),
        "ground",
        0.0,
        row.get("motion", "walk"),
        tuple(row.get("names", ())),
        tuple(row.get("plurals", ())),
    )


NOUNS = tuple(_read_noun(name, row) for name, row in read_table("outfits")["people"].items())
