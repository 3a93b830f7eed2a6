"""Scenes to and from `SceneDescription`, which staging takes.

Motions, moves and light have the same fields in both; `vars` copies them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from texvent.scenes import description as staged
from texvent.scenes.colours import PALETTES, find_colour
from texvent.scenes.description import NamedColour, SceneDescription
from texvent.scenes.spec.data import scene_from_data
from texvent.scenes.spec.scene import Scene, SceneObject, number_nouns, object_ids


def to_description(scene: Scene) -> SceneDescription:
    """The description of a scene that `scene_from_data` accepts; what is open stays open."""
    index = {id: number for number, id in enumerate(object_ids(scene))}
    camera, light, place = scene.camera, scene.light, dict(vars(scene.place))
    return SceneDescription(
        scene.prompt,
        objects=tuple(map(_staged_object, scene.objects)),
        relations=tuple(
            staged.Relation(
                one.kind, number, tuple(index[id] for id in one.to), one.way or "", one.distance_m
            )
            for number, subject in enumerate(scene.objects)
            for one in subject.relations
        ),
        effects=tuple(
            staged.Effect(
                one.kind,
                None if one.source is None else index[one.source],
                _colour(one.colour, "effect"),
                one.start_s,
            )
            for one in scene.effects
        ),
        shot=staged.Shot(
            tuple(staged.CameraMove(**vars(one)) for one in camera.moves),
            camera.view,
            camera.framing,
            None if camera.target is None else index[camera.target],
            camera.position_m,
            camera.look_at_m,
            camera.field_of_view_deg,
        ),
        light=staged.Illumination(
            **{
                **vars(light),
                "tint": _colour(light.tint, "light"),
                "lamps": tuple(
                    staged.SceneLamp(**{**vars(one), "colour": _colour(one.colour, "light")})
                    for one in light.lamps
                ),
            }
        ),
        surroundings=staged.Surroundings(
            place.pop("name"),
            _colour(place.pop("colour"), "surface"),
            _colour(place.pop("sky"), "surface"),
            **place,
        ),
        is_timelapse=scene.is_timelapse,
        is_grey=camera.is_grey,
        absent=scene.absent,
    )


def from_description(description: SceneDescription) -> Scene:
    """The scene of a description; the report of its words is left out.

    Relations stand at their subjects: those of a description are in the order of these.

    Raises:
        ConfigError: a value is out of range, or relations go round in a circle.
    """
    shot, place = description.shot, dict(vars(description.surroundings))
    ids = number_nouns([one.noun for one in description.objects])
    return scene_from_data(
        {
            "prompt": description.prompt,
            "objects": [_object_data(description, n, ids) for n in range(len(ids))],
            "effects": [
                {
                    **vars(one),
                    "source": None if one.source is None else ids[one.source],
                    "colour": _name(one.colour),
                }
                for one in description.effects
            ],
            "camera": {
                "moves": [vars(one) for one in shot.moves],
                "view": shot.view,
                "framing": shot.framing,
                "target": None if shot.target is None else ids[shot.target],
                "is_grey": description.is_grey,
                "position_m": shot.position_m,
                "look_at_m": shot.look_at_m,
                "field_of_view_deg": shot.field_of_view_deg,
            },
            "light": {
                **vars(description.light),
                "tint": _name(description.light.tint),
                "lamps": [
                    {**vars(one), "colour": _name(one.colour)} for one in description.light.lamps
                ],
            },
            "place": {
                "name": place.pop("place"),
                "colour": _name(place.pop("colour")),
                "sky": _name(place.pop("sky")),
                **place,
            },
            "absent": description.absent,
            "is_timelapse": description.is_timelapse,
        }
    )


def _staged_object(one: SceneObject) -> staged.SceneObject:
    motions = [staged.ObjectMotion(**vars(motion)) for motion in one.motions]
    return staged.SceneObject(
        one.noun,
        one.count,
        _colour(one.colour, "surface"),
        one.size,
        motions[0] if motions else None,
        one.placement,
        tuple(motions[1:]),
        one.material,
        None if one.picture is None else staged.Picture(**vars(one.picture)),
        one.blink_hz,
        one.is_lit,
        one.position_m,
        one.height_m,
        one.heading_deg,
    )


def _object_data(description: SceneDescription, number: int, ids: Sequence[str]) -> dict[str, Any]:
    """Plain values of an object, with the relations of which it is the subject."""
    one = description.objects[number]
    relations = [relation for relation in description.relations if relation.subject == number]
    return {
        "noun": one.noun,
        "count": one.count,
        "colour": _name(one.colour),
        "size": one.scale,
        "material": one.material,
        "placement": one.side,
        "motions": [vars(motion) for motion in (one.motion, *one.then) if motion is not None],
        "relations": [
            {
                "kind": relation.kind,
                "to": [ids[target] for target in relation.targets],
                "way": relation.way or None,
                "distance_m": relation.distance_m,
            }
            for relation in relations
        ],
        "picture": None if one.picture is None else vars(one.picture),
        "blink_hz": one.blink_hz,
        "is_lit": one.is_lit,
        "position_m": one.position_m,
        "height_m": one.height_m,
        "heading_deg": one.heading_deg,
    }


def _colour(name: str | None, palette: str) -> NamedColour | None:
    return None if name is None else NamedColour(name, find_colour(name, PALETTES[palette]))


def _name(colour: NamedColour | None) -> str | None:
    return None if colour is None else colour.name
