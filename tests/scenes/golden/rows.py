"""A small scene or model of every row of the tables of scenes, and sums over its numbers.

    python -m tests.scenes.golden.rows    # writes the sums anew; CHANGELOG.md says why

`rows.json.gz` holds them. A row is there as soon as it is in its table: nouns with all that they
do, motions and their tracks, relations, places, lights, effects, camera moves, materials; and a
third of the sentences of `sentences.txt` as they are staged, which hold what these rows do to each
other; and those of `reported.txt`, which run most of what reads, stages and checks, with their
reports and with what holds of their bodies. Places, lights and effects have small pictures, with
truth, too.
"""

import gzip
import itertools
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any, get_args, get_type_hints
from zlib import crc32

import numpy as np
from numpy.typing import NDArray
from tests.scenes.golden.golden import block_means, decided, read_lines, see, stored_scenes
from tests.scenes.read.phrases import ENDS, OBJECTS, RELATIONS, SUBJECTS, VERBS

from texvent.errors import ConfigError, InputError
from texvent.sensor import SensorSize
from texvent_scenes import read as reader
from texvent_scenes.checks.clip.relation_rules import RULES
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.checks.words import CHECKS
from texvent_scenes.defaults import complete, decide_motions
from texvent_scenes.description import Claim, report_of, to_description
from texvent_scenes.models.activities import ACTIVITIES, HAND_GESTURES, HAND_NOUNS, PERSON_NOUNS
from texvent_scenes.models.effects import EFFECTS
from texvent_scenes.models.nouns import MOTIONS, NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.models.protocol import Model, Noun, Pose
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.raycast.surfaces.catalogue import CHANNELS, SURFACES, build_tile
from texvent_scenes.rendered_scene import Texture
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.spec import scene as spec
from texvent_scenes.spec.data import scene_to_data
from texvent_scenes.spec.scene import (
    Camera,
    CameraMove,
    Effect,
    Light,
    Motion,
    Place,
    Relation,
    Scene,
    SceneObject,
)
from texvent_scenes.staged_prompt import stage as stage_prompt
from texvent_scenes.staging.camera.camera_track import time_moves
from texvent_scenes.staging.compose import ComposedScene, compose_scene
from texvent_scenes.staging.interactions.perform import ACTS
from texvent_scenes.staging.surroundings.lighting import choose_lighting
from texvent_scenes.staging.tracks.choose_track import choose_track
from texvent_scenes.staging.tracks.motion_plan import plan_motion

SUMS = Path(__file__).with_name("rows.json.gz")
SIZE, SEED, DURATION_S = SensorSize(96, 72), 5, 1.0
INSTANTS_S = (0.23, 0.81)
ACTED_S = (0.13, 0.46, 0.71)
MOVING = (Pose(0.31, 0.17, 1.3), Pose(2.9, 11.3, 4.0, "run"), Pose(0.4, 0.0, 0.0, "sit"))
EMPTY = Place("plain", is_empty=True)
BODIES = ("car", "man", "dog", "airplane", "ball", "boat")
DIRECTIONS, MOVE_DIRECTIONS = get_args(spec.Direction), get_args(spec.MoveDirection)
WITHIN_NORM = 1e-6
"""What a sum may differ by, of its norm."""
SMALL, PICTURE = SensorSize(48, 36), "picture"
WAY = Motion("move", "left"), Motion("move", "right")
CLAIMED: Mapping[str, tuple[Any, ...]] = {
    "colour": ("red", "white", "black"),
    "lit colour": ("red", "green"),
    "material": ("wood", "metal", "brick"),
    "relation": ("on", "behind", "towards"),
    "arrive": ("in", "on"),
    "row": ("along", "across"),
    "times": (1, 2, 3),
    "mutual": ("facing", "towards"),
    "activity": ("walk", "sit down", "jump", "wave", "open and close"),
    "ground": (True, False),
}
"""Kind of a check → values that are claimed; the others take none."""
TO_ANOTHER = ("relation", "off", "arrive", "stop before", "mutual", "hold", "sit at")
SIMPLE = sorted(MOTIONS - set(ACTIVITIES) | {"walk", "run", "jump", "sit", "swim"})
Marks = dict[str, list[float]]


def numbers(value: Any) -> Iterator[NDArray[Any]]:
    """All numbers in a value, in order; a word counts as its checksum."""
    if isinstance(value, str):
        yield np.array([crc32(value.encode()) / 2**32])
    elif is_dataclass(value):
        yield from numbers(list(vars(value).values()))
    elif value is None:
        return
    elif isinstance(value, Sequence) or np.asarray(value).dtype == np.object_:
        for one in value:
            yield from numbers(one)
    elif np.asarray(value).dtype.names:
        yield np.asarray(value).view(np.float64)  # a record array of numbers
    else:
        yield np.ravel(value).astype(np.float64)


def mark(*values: Any) -> list[float]:
    """How many numbers values have, and their norm and their sum, in which each has a weight of its
    own; signs of weights differ, so that a small change of one number is not lost among many."""
    found = np.nan_to_num(np.concatenate([np.zeros(1), *numbers(values)]), posinf=3.0, neginf=-3.0)
    weighted = found * (np.modf(np.arange(len(found)) * 0.618034)[0] - 0.5)
    sums = float(np.linalg.norm(weighted)), float(weighted.sum())
    return [len(found), *(float(f"{one:.10g}") for one in sums)]


def is_near(found: Sequence[float], before: Sequence[float]) -> bool:
    """Whether marks are the same but for what may differ between processors: the last bits."""
    within = WITHIN_NORM * before[1] + 1e-9
    return found[0] == before[0] and bool(np.allclose(found, before, rtol=0.0, atol=within))


@cache
def usual_model(noun: Noun) -> Model:
    """The model that several tests look at; built once, as building takes most of their time."""
    return noun.build(colour=None, scale=1.0, seed=1)


def mark_noun(noun: Noun) -> Marks:
    """A model: its size, and its parts at rest, on its way, and at all that it can do."""
    model = usual_model(noun)
    acts = sorted(noun.acts) + (sorted(HAND_GESTURES) if noun.name in HAND_NOUNS else [])
    if noun.name in PERSON_NOUNS:
        acts += sorted(ACTIVITIES) if noun.name == "man" else ["wave"]
    times_s = ACTED_S if acts else ACTED_S[:1]
    poses = [*MOVING, *(Pose(t, 0.6, 0.9, act) for act in ["stand", *acts] for t in times_s)]
    other = noun.build(colour=(0.2, 0.5, 0.7), scale=1.3, seed=2).parts(MOVING[1])
    return {
        "another": mark(*((p.shape, p.colour, p.second_colour, p.to_body) for p in other)),
        "size": mark(model.length, model.width, model.height),
        "parts": mark(*((p.shape, p.texture, p.texture_scale) for p in model.parts(poses[0]))),
        "paints": mark(*((p.colour, p.second_colour, p.emission) for p in model.parts(poses[0]))),
        "places": mark(*(part.to_body for pose in poses for part in model.parts(pose))),
    }


def stage(scene: Scene, size: SensorSize = SIZE) -> ComposedScene:
    description = complete(to_description(scene), NOUNS)  # also what files may not say
    return compose_scene(description, seed=SEED, size=size, duration_s=DURATION_S)


def mark_scene(scene: Scene) -> Marks:
    """A staged scene at some instants, by its fields."""
    staged, found = stage(scene), {}
    for name, seen in (
        ("shapes", staged.primitives),
        ("camera", staged.camera),
        ("environment", staged.environment),
    ):
        at = [seen(time_s) for time_s in INSTANTS_S]
        for field in fields(at[0]):
            found[f"{name}.{field.name}"] = mark(*(getattr(one, field.name) for one in at))
    return found


def mark_seen(scene: Scene) -> Marks:
    """As `mark_scene`, and how it looks."""
    picture = block_means(see(stage(scene), INSTANTS_S[0], SMALL), 12)
    return mark_scene(scene) | {PICTURE: picture.round(4).ravel().tolist()}


def mark_tracks(kind: str) -> Marks:
    """A motion of bodies in every direction, slower in the end, and one after another."""
    found: dict[str, list[Any]] = {}
    for way, name in itertools.product(DIRECTIONS, BODIES):
        noun, motions = NOUNS[name], (Motion(kind, way, 1.2), Motion(kind, way, end_pace=0.5))
        model, height_m = usual_model(noun), _one_of((None, 1.7), f"{kind} {name}")
        for said in (motions[:1], motions[1:], motions):
            rng = np.random.default_rng(SEED)
            plan = plan_motion(decide_motions(said, noun), noun, model, DURATION_S, rng, height_m)
            track = choose_track(plan, model, (1.0, 2.0, 0.7), rng)
            found.setdefault(str(way), []).extend((plan, *map(track.at, INSTANTS_S)))
    return {way: mark(*plans) for way, plans in found.items()}


def mark_acts(kind: str) -> Marks:
    """What a person does with some things, and with those of which a trait says how."""
    traits = ("held as a tool", "held upright", "held up high", "held hanging", "worn")
    special = {_one_of(sorted(nouns_with(one)), kind, step) for one in traits for step in (0, 1)}
    found = {}
    for name in NOUNS:
        if name in special or crc32(f"{kind} {name}".encode()) % 16 == 0:
            man = SceneObject("man", relations=(Relation(kind, (name,)),))
            man = replace(man, motions=_one_of(((), (Motion("walk"),), WAY), f"{name} {kind}"))
            staged = stage(Scene(objects=(man, SceneObject(name)), place=EMPTY))
            found[name] = mark(*map(staged.primitives, INSTANTS_S), staged.not_shown, staged.notes)
    return found


def mark_readings(subject: str) -> Marks:
    """How sentences about a subject are read, one of a few thousand that its words make."""
    found = {}
    for words in itertools.product(VERBS, RELATIONS, OBJECTS, ENDS):
        sentence = " ".join((subject, *words)).strip()
        if crc32(sentence.encode()) % 499 == 0:
            found[sentence] = mark(*vars(reader.read(sentence, NOUNS)).values())
    return found


def mark_moves() -> Marks:
    """All camera moves, each in every direction."""
    path = stage(Scene(objects=(SceneObject("box"),), place=EMPTY)).camera_path
    moves = [CameraMove(kind, to) for kind in get_args(spec.MoveKind) for to in MOVE_DIRECTIONS]
    return {
        f"{one.kind} {one.direction}": mark(
            *(replace(path, moves=tuple(time_moves([one], DURATION_S))).at(t) for t in INSTANTS_S)
        )
        for one in moves
        if one.kind != "travel"
    }


def mark_lights() -> Marks:
    """The lighting of all places in every light."""
    return {
        kind: mark(*(choose_lighting(place, Light(kind)) for place in PLACES.values()))
        for kind in _choices(Light, "kind")
    }


def mark_surface(texture: Texture) -> Marks:
    """The tile of a material, and all that its row says."""
    tile = build_tile(texture).reshape(-1, CHANNELS)
    found = {f"channel {number}": mark(channel) for number, channel in enumerate(tile.T)}
    return found | {"kind": mark(*(one for one in vars(SURFACES[texture]).values()
                                   if isinstance(one, int | float)))}  # fmt: skip


def _choices(owner: type, field: str) -> tuple[Any, ...]:
    """Words that a field of a scene may have."""
    (literal, _) = get_args(get_type_hints(owner)[field])
    return get_args(literal)


def _one_of(words: Sequence[Any], name: str, step: int = 0) -> Any:
    """One of some words; which one hangs on the row's name alone, not on the rows before."""
    return words[(crc32(name.encode()) + step) % len(words)]


def _of_objects() -> Iterator[tuple[str, Scene]]:
    for kind in SIMPLE:
        for step in (0, 1):
            noun, way = _one_of(BODIES, kind, step), _one_of(DIRECTIONS, kind, step)
            actor = SceneObject(noun, motions=(Motion(kind, way), Motion("move", start_s=0.6)))
            yield f"{noun} {kind} {way}", Scene(objects=(actor,), place=EMPTY)
    pairs = (("man", "table"), ("cat", "box"), ("car", "truck"), ("man", "chair"))
    for kind in get_args(spec.RelationKind):
        for noun, target in pairs[::2] if kind in ("on", "at") else [_one_of(pairs, kind)]:
            for count, several in ((1, 1), (2, 1), (3, 2), (1, 2)):
                actor = SceneObject(noun, count=count, relations=(Relation(kind, (target,)),))
                if count < several:
                    actor = replace(actor, motions=WAY)
                others = SceneObject(target, count=several), SceneObject("dog")
                yield (
                    f"{count} {noun} {kind} {several} {target}",
                    Scene(objects=(actor, *others), place=EMPTY),
                )
    for one in get_args(spec.Placement):
        placed = SceneObject("man", placement=one), SceneObject("car")
        yield f"placed {one}", Scene(objects=placed, place=EMPTY)


def _of_surroundings() -> Iterator[tuple[str, Scene]]:
    box, dog = (SceneObject("box"),), (SceneObject("dog"),)
    for kind in EFFECTS:
        for source in ("box", None):
            effects = (Effect(kind, source),)
            yield f"{kind} from {source}", Scene(objects=box, effects=effects, place=EMPTY)
    for name in PLACES:
        place = Place(name, weather=_one_of(["fog", "rain", "snow", None], name))
        light = Light(_one_of(_choices(Light, "kind"), name))
        yield name, Scene(objects=dog, place=place, light=light)
    man = (SceneObject("man", motions=(Motion("walk"),)),)
    moves = [CameraMove(one, _one_of(MOVE_DIRECTIONS, one)) for one in get_args(spec.MoveKind)]
    cameras = [Camera((one,)) for one in moves]
    cameras += [Camera(view=one) for one in get_args(spec.View)]
    cameras += [Camera(framing=one) for one in _choices(Camera, "framing")]
    for camera in cameras:
        scene = Scene(objects=man, camera=camera, place=EMPTY)
        yield f"camera {scene_to_data(scene)['camera']}", scene


def mark_sentence(sentence: str) -> Marks:
    """A staged sentence at some instants, in an image, by a seed and over a time of its own."""
    size = _one_of((SIZE, SensorSize(50, 80)), sentence)
    seed, duration_s = _one_of((5, 6, 7), sentence), _one_of((1.0, 2.5), sentence, 1)
    description = decided(stored_scenes()[sentence])
    if description is None:
        return {}
    staged = compose_scene(description, seed=seed, size=size, duration_s=duration_s)
    return {
        seen.__name__: mark(*(seen(share * duration_s) for share in INSTANTS_S))
        for seen in (staged.primitives, staged.camera, staged.environment)
    } | {"said": mark(*staged.not_shown, *staged.notes, *staged.camera_path.notes)}


def _claims(clip: StagedClip) -> Iterator[bool]:
    """Whether each check holds of each body, and of the next one."""
    objects = [n for n, _ in enumerate(clip.description.objects) if clip.list_actors(n)][:3]
    for subject, target in zip(objects, [*objects[1:], *objects[:1]], strict=True):
        for kind, check in CHECKS.items():
            for value in CLAIMED.get(kind, ("",)):
                if subject != target or kind not in TO_ANOTHER:
                    yield check(clip, Claim("", kind, value, subject, (target,)))


def mark_report(sentence: str) -> Marks:
    """A sentence read and staged, its report, and all that may be claimed of its bodies."""
    nouns, size, duration_s = list_nouns(), _one_of((SIZE, SMALL), sentence), 1.0
    try:
        description = understand(sentence, nouns)
    except (ConfigError, InputError) as error:
        return {"refused": mark(str(error))}
    said = report_of(description)
    staged, report, _ = stage_prompt(
        description, said, nouns, seed=SEED, size=size, duration_s=duration_s
    )
    clip = StagedClip(staged, description, size, duration_s)
    pairs = [*itertools.permutations(itertools.chain(*clip.boxes), 2)][:30]
    return {name: mark(one) for name, one in vars(report).items()} | {
        "relations": mark(*(rule(*pair) for rule in RULES.values() for pair in pairs)),
        "claims": mark(*_claims(clip)),
        "shapes": mark(*map(staged.primitives, INSTANTS_S)),
        "camera": mark(*map(staged.camera, INSTANTS_S)),
        "environment": mark(*map(staged.environment, INSTANTS_S)),
    }


def rows() -> Iterator[tuple[str, Callable[[], Marks]]]:
    """Name of each row, and its marks."""
    yield "camera moves", mark_moves
    yield "lights", mark_lights
    for name, noun in NOUNS.items():
        yield name, partial(mark_noun, noun)
    for texture in SURFACES:
        yield f"surface: {texture.name}", partial(mark_surface, texture)
    for kind in SIMPLE:
        yield f"tracks: {kind}", partial(mark_tracks, kind)
    for subject in SUBJECTS:
        yield f"readings: {subject}", partial(mark_readings, subject)
    for kind in ACTS:
        yield f"acts: {kind}", partial(mark_acts, kind)
    for name, scene in _of_objects():
        yield f"scene: {name}", partial(mark_scene, scene)
    for name, scene in _of_surroundings():
        yield f"scene: {name}", partial(mark_seen, scene)
    for sentence in list(stored_scenes())[::3]:
        yield f"sentence: {sentence}", partial(mark_sentence, sentence)
    for sentence in read_lines("reported.txt"):
        yield f"report: {sentence}", partial(mark_report, sentence)


def stored_sums() -> Mapping[str, Marks]:
    """Name of each row, and what its marks were."""
    found: dict[str, Marks] = json.loads(gzip.decompress(SUMS.read_bytes()))
    return found


if __name__ == "__main__":
    text = json.dumps({name: find() for name, find in rows()}, separators=(",", ":"))
    SUMS.write_bytes(gzip.compress(text.encode(), mtime=0))
