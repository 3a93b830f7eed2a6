"""Scenes to and from `SceneDescription`, which staging takes.

Motions, moves and light have the same fields in both; `vars` copies them.
"""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes import description as staged
from texvent.scenes.colours import PALETTES, find_colour
from texvent.scenes.description import NamedColour, SceneDescription
from texvent.scenes.spec.scene import (
    Camera,
    CameraMove,
    Effect,
    Light,
    Motion,
    Picture,
    Place,
    Relation,
    Scene,
    SceneObject,
    object_ids,
)


def to_description(scene: Scene) -> SceneDescription:
    """The description of a scene that `scene_from_data` accepts; what is open stays open."""
    index = {id: number for number, id in enumerate(object_ids(scene))}
    camera, light, place = scene.camera, scene.light, dict(vars(scene.place))
    return SceneDescription(
        scene.prompt,
        objects=tuple(map(_staged_object, scene.objects)),
        relations=tuple(
            staged.Relation(one.kind, number, tuple(index[id] for id in one.to), one.way or "")
            for number, subject in enumerate(scene.objects)
            for one in subject.relations
        ),
        effects=tuple(
            staged.Effect(
                one.kind,
                None if one.source is None else index[one.source],
                _named_colour(one.colour, "effect"),
                one.start_s,
            )
            for one in scene.effects
        ),
        shot=staged.Shot(
            tuple(staged.CameraMove(**vars(one)) for one in camera.moves),
            camera.view,
            camera.framing,
            None if camera.target is None else index[camera.target],
        ),
        light=staged.Illumination(**{**vars(light), "tint": _named_colour(light.tint, "light")}),
        surroundings=staged.Surroundings(
            place.pop("name"),
            _named_colour(place.pop("colour"), "surface"),
            _named_colour(place.pop("sky"), "surface"),
            **place,
        ),
        is_timelapse=scene.is_timelapse,
        is_grey=camera.is_grey,
        absent=scene.absent,
    )


def from_description(description: SceneDescription) -> Scene:
    """The scene of a description; the report of its words is left out.

    Relations stand at their subjects, so that their order across subjects is lost.
    """
    shot, around = description.shot, dict(vars(description.surroundings))
    ids = object_ids(
        Scene(objects=tuple(SceneObject(noun=one.noun) for one in description.objects))
    )
    light = {**vars(description.light), "tint": _name(description.light.tint)}
    return Scene(
        prompt=description.prompt,
        objects=tuple(
            _scene_object(one, [each for each in description.relations if each.subject == n], ids)
            for n, one in enumerate(description.objects)
        ),
        effects=tuple(
            Effect(
                kind=one.kind,
                source=None if one.source is None else ids[one.source],
                colour=_name(one.colour),
                start_s=one.start_s,
            )
            for one in description.effects
        ),
        camera=Camera(
            moves=tuple(CameraMove(**vars(one)) for one in shot.moves),
            target=None if shot.target is None else ids[shot.target],
            is_grey=description.is_grey,
            **{"view": shot.view, "framing": shot.framing},
        ),
        light=Light(**light),
        place=Place(
            name=around.pop("place"),
            colour=_name(around.pop("colour")),
            sky=_name(around.pop("sky")),
            **around,
        ),
        absent=description.absent,
        is_timelapse=description.is_timelapse,
    )


def _staged_object(one: SceneObject) -> staged.SceneObject:
    first, *then = [staged.ObjectMotion(**vars(motion)) for motion in one.motions] or [None]
    return staged.SceneObject(
        one.noun,
        one.count,
        _named_colour(one.colour, "surface"),
        one.size,
        first,
        one.placement,
        tuple(filter(None, then)),
        one.material,
        None if one.picture is None else staged.Picture(**vars(one.picture)),
        one.blink_hz,
        one.is_lit,
    )


def _scene_object(
    one: staged.SceneObject, relations: Sequence[staged.Relation], ids: Sequence[str]
) -> SceneObject:
    """An object with the relations of which it is the subject."""
    motions = (one.motion, *one.then) if one.motion is not None else ()
    words = {"material": one.material, "placement": one.side}
    return SceneObject(
        noun=one.noun,
        count=one.count,
        colour=_name(one.colour),
        size=one.scale,
        motions=tuple(Motion(**vars(motion)) for motion in motions),
        relations=tuple(_relation(relation, ids) for relation in relations),
        picture=None if one.picture is None else Picture(**vars(one.picture)),
        blink_hz=one.blink_hz,
        is_lit=one.is_lit,
        **words,
    )


def _relation(one: staged.Relation, ids: Sequence[str]) -> Relation:
    words = {"kind": one.kind, "way": one.way or None}
    return Relation(to=tuple(ids[target] for target in one.targets), **words)


def _named_colour(name: str | None, palette: str) -> NamedColour | None:
    return None if name is None else NamedColour(name, find_colour(name, PALETTES[palette]))


def _name(colour: NamedColour | None) -> str | None:
    return None if colour is None else colour.name
