"""Motions of bodies in acts that the act leaves no room for, found by staging the scene without."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np

from texvent.errors import ConfigError, shown
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.anchors import grips
from texvent_scenes.models.protocol import Noun
from texvent_scenes.spec.data import SENT
from texvent_scenes.spec.scene import Motion, Scene, SceneObject, object_ids
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.idle_fields import RESTS, probes
from texvent_scenes.staging.idle_surroundings import Idle
from texvent_scenes.staging.interactions.perform import ACTS
from texvent_scenes.staging.interactions.settling import settle_motions
from texvent_scenes.staging.interactions.striking import IMPACTS
from texvent_scenes.staging.placement.object_placement import ObjectPlacer
from texvent_scenes.staging.tracks.phases import YAWS

_CLIP_S, _LEVELS_M = 2.0, {"air": 1.5, "water": 0.5}
"""Length of the clip after the last stated start, s, and heights of what lives in air and water."""
_SHARES = (0.0, 0.07, 0.13, 0.21, 0.29, 0.41, 0.5, 0.6, 0.71, 0.83, 0.97)
_NEAR_RAD = 0.3
"""Turn from a direction up to which a body heads into it."""
_IN_HAND = ("hold", "wear")
"""Acts whose things other rules judge."""
_OF_ALL = ("wear", "rally")
"""Acts on all their targets."""


class _Staging:
    """A scene's bodies, staged with and without fields."""

    def __init__(self, scene: Scene, nouns: Mapping[str, Noun]) -> None:
        self._scene, self._nouns = scene, nouns
        starts = (each.start_s or 0.0 for one in scene.objects for each in one.motions)
        self._start_s = max(starts, default=0.0)
        self._usual = self._drawn(scene)

    def differs(self, n: int, one: SceneObject) -> bool:
        """Whether another object in place of one changes a body."""
        try:
            other = self._drawn(self._with(n, one))
        except ConfigError:  # another field contradicts it
            return True
        return len(self._usual) != len(other) or not all(map(_is_alike, self._usual, other))

    def heads(self, n: int, direction: str) -> bool:
        """Whether an object heads into a direction at time 0."""
        own = (one for one in self._usual if one[0] == n)
        yaws = (math.atan2(ways[0, 1, 0], ways[0, 0, 0]) for _, ways, _ in own)
        turns = (abs(math.remainder(yaw - YAWS[direction], math.tau)) for yaw in yaws)
        return any(turn < _NEAR_RAD for turn in turns)

    def settled(self, n: int, one: SceneObject) -> set[str]:
        """Kinds of motion that the acts leave another object in place of one."""
        description = complete(to_description(self._with(n, one)), self._nouns)
        return {one.kind for one in settle_motions(description, self._nouns, 0).objects[n].motions}

    def _with(self, n: int, one: SceneObject) -> Scene:
        objects = list(self._scene.objects)
        objects[n] = one
        return replace(self._scene, objects=tuple(objects))

    def _drawn(self, scene: Scene) -> list[list[Any]]:
        duration_s, start_s = self._start_s + _CLIP_S, self._start_s
        placer = ObjectPlacer(
            complete(to_description(scene), self._nouns), self._nouns, seed=0,
            duration_s=duration_s, level_m=_LEVELS_M,
        )  # fmt: skip
        times = [start_s + share * _CLIP_S for share in _SHARES]
        times += [share * start_s for share in _SHARES if start_s]
        return [_states(one, times) for one in placer.place_all()]


def _states(one: Actor, times: list[float]) -> list[Any]:
    ways = np.array([one.track.at(at).to_world() for at in times])
    return [one.object_index, ways, [one.pose(at) for at in times]]


def _is_alike(one: list[Any], other: list[Any]) -> bool:
    return bool(one[0] == other[0] and one[2] == other[2] and np.allclose(one[1], other[1]))


def list_idle_in_acts(scene: Scene, nouns: Mapping[str, Noun]) -> Iterator[Idle]:
    """Motions, and their fields, of bodies whose act decides otherwise; targets beside the first.

    The acts of machines' hands are left out: `idle_acts` has those.
    """
    ids = object_ids(scene)
    yield from _list_second(scene, ids)
    acts: dict[int, str] = {}
    for n, one in enumerate(scene.objects):
        for number, said in enumerate(one.relations):
            is_gripped = said.kind != "hold" and grips(one.noun, said.kind)
            if said.kind not in ACTS or is_gripped:
                continue
            if said.kind not in _OF_ALL and len(said.to) > 1:
                why = f"{shown(said.kind)} is done to one thing, its first"
                yield Idle(f"objects[{n}].relations[{number}].to[1]",
                           f"{why}; give the other a relation of its own")  # fmt: skip
            acts.setdefault(n, said.kind)
            if said.kind not in _IN_HAND or grips(one.noun, said.kind):
                acts.update({ids.index(to): said.kind for to in said.to})
    moved = [n for n in acts if scene.objects[n].motions]
    if not moved:
        return
    try:
        staging = _Staging(scene, nouns)
    except ConfigError:  # it is refused for another reason
        return
    for n in moved:
        yield from _idle_of(f"objects[{n}]", n, scene.objects[n], acts[n], staging)


def _list_second(scene: Scene, ids: Sequence[str]) -> Iterator[Idle]:
    """Impacts of bodies that have one already: each is in one, but what is sent may be caught."""
    busy: dict[int, str] = {}
    for n, one in enumerate(scene.objects):
        for number, said in enumerate(one.relations):
            if said.kind not in IMPACTS or grips(one.noun, said.kind):
                continue
            thing = ids.index(said.to[0])
            for body in dict.fromkeys((n, thing)):
                before = busy.get(body)
                is_caught = body == thing and "catch" in (before, said.kind)
                if before is not None and not (is_caught and {before, said.kind} & {*SENT}):
                    why = f"{shown(ids[body])} is in another act already ({before})"
                    yield Idle(f"objects[{n}].relations[{number}].kind",
                               f"{why}, and does or takes one; leave one of them out")  # fmt: skip
            busy |= {n: said.kind, thing: said.kind}


def _idle_of(
    where: str, n: int, one: SceneObject, act: str, staging: _Staging
) -> Iterator[Idle]:  # fmt: skip
    for number, motion in enumerate(one.motions):
        path, motions = f"{where}.motions[{number}]", one.motions
        without = replace(one, motions=(*motions[:number], *motions[number + 1 :]))
        if not staging.differs(n, without):
            is_usual = motion.kind in staging.settled(n, without) | RESTS | {act}
            idle = [each.name for each in fields(Motion) if each.name != "kind"
                    and getattr(motion, each.name) != each.default]  # fmt: skip
            why = f"its act ({act}) decides what the {one.noun} does; leave it out"
            if not is_usual:
                yield Idle(f"{path}.kind", why)
            elif idle:
                yield Idle(f"{path}.{idle[0]}", why)
            continue
        for each in fields(Motion):
            given = getattr(motion, each.name)
            if each.name == "kind" or given == each.default:
                continue
            is_way = given in YAWS and motion.kind != "turn"
            if is_way and staging.heads(n, given):
                continue
            tried = [*(() if is_way else probes(given)), each.default]
            others = (_with(one, number, each.name, value) for value in tried if value != given)
            if not any(staging.differs(n, other) for other in others):
                yield Idle(f"{path}.{each.name}", f"its act ({act}) decides it; leave it out")


def _with(one: SceneObject, number: int, name: str, value: Any) -> SceneObject:
    motions = list(one.motions)
    motions[number] = replace(motions[number], **{name: value})
    return replace(one, motions=tuple(motions))
