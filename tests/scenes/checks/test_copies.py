"""What is claimed of several copies holds of each of them, or of one: by the kind of the claim.

Copies come from scenes in which one does something and another does not: a check of both agrees
with the checks of each alone.
"""

from dataclasses import replace
from functools import cache

import numpy as np
from tests.examples import one_of
from tests.scenes.staged import DURATION_S, SIZE, stage, thing

from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.checks.words import CHECKS
from texvent_scenes.description import Claim, SceneDescription
from texvent_scenes.spec.scene import Motion, Place, SceneObject

AWAY_M = (0.0, -200.0, 0.0)
"""Behind the camera."""
SUBJECTS = {
    "man": [{}, *([one] for one in (
        Motion("walk", "right"), Motion("jump"), Motion("wave"), Motion("sit"), Motion("lie"),
        Motion("walk", "circle"), Motion("run", "left"), Motion("turn", "left"))),
        [Motion("walk", "left"), Motion("stand")], {"colour": "red"}],
    "ball": [{"colour": "red"}, *([one] for one in (
        Motion("bounce"), Motion("roll", "right"), Motion("fall"), Motion("break"),
        Motion("spin", end_pace=0.3), Motion("rise"))), {"material": "wood"}, {"size": 8.0}],
    "car": [{"is_lit": True}, {"is_lit": False}, {"is_lit": True, "blink_hz": 3.0},
            [Motion("drive", "left")], [Motion("reverse")],
            [Motion("drive", "right"), Motion("stand")]],
    "airplane": [{}, [Motion("fly", "left")], [Motion("rise")], [Motion("sink")]],
}  # fmt: skip
"""Noun → fields of some of its bodies, or their motions."""
OF_TARGETS = ("along", "cover", "taken in")
ONE_IS_ENOUGH = {"lamp": ("car", "headlight"), "near": ("ball",)}
EACH = {
    "colour": ("man", "red"), "material": ("ball", "wood"), "lit colour": ("car", "white"),
    "look": ("ball", "low"),
    "activity": ("man", "walk", "jump", "wave", "sit"), "ground": ("airplane", True, False),
    "in image": ("airplane", "", "centre"), "times": ("man", 1), "run": ("man",),
    "circle": ("man",), "turn": ("man",), "aside": ("man",), "bounce": ("ball",), "lie": ("man",),
    "again": ("man",),
    "fall": ("ball",), "break": ("ball",), "along": ("ball",), "cover": ("ball",),
    "taken in": ("ball",), "begin": ("ball",), "pace": ("ball",),
    "blink": ("car",), "shine": ("car",), "stays": ("car",), "direction": ("car",),
    "parts": ("car",), "rounds": ("car",), "stop": ("car",), "move": ("car",), "reverse": ("car",),
    "rise": ("airplane",), "on_ground": ("airplane",), "descend": ("airplane",),
    "land": ("airplane",),
}  # fmt: skip
"""Kind of a claim → noun whose bodies differ in it, and values that are claimed, if it has any."""


@cache
def variants(noun):
    """The scene of each variant of a body by a box, and that body; of the first one away too."""
    found = []
    for said in SUBJECTS[noun]:
        fields = {"motions": tuple(said)} if isinstance(said, list) else said
        scene = stage(SceneObject(noun, **fields), thing("box"))
        found += [(scene, next(one for one in scene.actors if one.object_index == 0))]
    scene, actor = found[0]
    track = replace(actor.track, start=tuple(np.add(actor.track.start, AWAY_M)))
    return [*found, (scene, replace(actor, track=track))]


@cache
def clip(noun, *numbers):
    """A scene whose first object has these variants as its copies."""
    own = [variants(noun)[one] for one in numbers]
    chosen = [(scene, actor, replace(actor, instance=actor.instance + 100 * n))
              for n, (scene, actor) in enumerate(own)]  # fmt: skip
    lit = [replace(lamp, actor=copy) for scene, actor, copy in chosen
           for lamp in scene.lamps.lit if lamp.actor.instance == actor.instance]  # fmt: skip
    base, _ = variants(noun)[0]
    others = [one for one in base.actors if one.object_index]
    scene = replace(base, actors=(*(copy for *_, copy in chosen), *others),
                    lamps=replace(base.lamps, lit=tuple(lit)))  # fmt: skip
    objects = SceneObject(noun, count=len(numbers)), SceneObject("box")
    said = SceneDescription(objects=objects, place=Place("grass", is_empty=True))
    return StagedClip(scene, said, SIZE, DURATION_S)


def is_so(kind, value, noun, *numbers):
    claim = Claim("", kind, value, 0, (1,) if kind in OF_TARGETS else ())
    return bool(CHECKS[kind](clip(noun, *numbers), claim))


def list_alone(kind, value, noun):
    """Whether a claim holds of each variant; in a brief run, of some until one is unlike."""
    alone = {}
    for n in reversed(range(len(variants(noun)))):
        alone[n] = is_so(kind, value, noun, n)
        if one_of() > 1 and len({*alone.values()}) == 2:
            break
    return alone


def test_a_claim_of_copies_holds_of_each_or_is_enough_of_one():
    wrong = []
    for every, claims in ((all, EACH), (any, ONE_IS_ENOUGH)):
        for kind, (noun, *values) in claims.items():
            for value in values or [""]:
                alone = list_alone(kind, value, noun)
                assert {*alone.values()} == {True, False}, (kind, value, alone)
                good = next(n for n, held in alone.items() if held)
                pairs = [pair for n in alone for pair in ((good, n), (n, good))]
                wrong += [
                    (kind, value, pair)
                    for pair in pairs
                    if is_so(kind, value, noun, *pair) != every(alone[n] for n in pair)
                ]
    assert not wrong  # fmt: skip
