"""Motions that acts of machines' hands leave without effect, in scene files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

from texvent_scenes.description import to_description
from texvent_scenes.models.anchors import grips
from texvent_scenes.spec.scene import Motion, Scene, SceneObject
from texvent_scenes.staging.idle_surroundings import Idle


def list_idle_acts(scene: Scene) -> Iterator[Idle]:
    """Motions and their fields that an act of a machine decides: all but when its work begins."""
    for one in to_description(scene).relations:
        machine = scene.objects[one.subject]
        if one.kind != "hold" and grips(machine.noun, one.kind):
            yield from _idle_of_machine(f"objects[{one.subject}]", machine, one.kind)
            for n in one.targets:
                yield from _idle_of_thing(f"objects[{n}]", scene.objects[n], machine.noun)


def _idle_of_machine(where: str, machine: SceneObject, act: str) -> Iterator[Idle]:
    has_begun = False
    for number, motion in enumerate(machine.motions):
        path = f"{where}.motions[{number}]"
        if motion.kind != ("stand" if motion.kind == "stand" and not number else "work"):
            why = f"a {machine.noun} does its act ({act}) to its end, and nothing else"
            yield Idle(f"{path}.kind", f"{why}; 'work' with a start_s says when that begins")
        elif motion.kind == "work" and has_begun:
            yield Idle(f"{path}.kind", f"a {machine.noun} does its act ({act}) once; leave it out")
        elif motion.kind == "work":
            has_begun = True
            idle = (each for each in fields(Motion) if each.name not in ("kind", "start_s")
                    and getattr(motion, each.name) != each.default)  # fmt: skip
            yield from (Idle(f"{path}.{each.name}", f"its act ({act}) decides it") for each in idle)


def _idle_of_thing(where: str, thing: SceneObject, machine: str) -> Iterator[Idle]:
    for number, motion in enumerate(thing.motions):
        if motion.kind != "stand":
            why = f"a {thing.noun} rests until the {machine} has it, which moves it then"
            yield Idle(f"{where}.motions[{number}].kind", f"{why}; leave it out")
