"""Scenes as `SceneDescription`s, which staging takes.

Motions, moves and light have the same fields in both; `vars` copies them.
"""

from __future__ import annotations

from texvent.scenes import description as staged
from texvent.scenes.colours import PALETTES, find_colour
from texvent.scenes.description import NamedColour, SceneDescription
from texvent.scenes.spec.scene import Scene, SceneObject, object_ids


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


def _colour(name: str | None, palette: str) -> NamedColour | None:
    return None if name is None else NamedColour(name, find_colour(name, PALETTES[palette]))
