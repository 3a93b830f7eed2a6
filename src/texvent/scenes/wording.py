"""A scene's description in words, line by line, for a person to check."""

from __future__ import annotations

from typing import TYPE_CHECKING

from texvent.scenes.inflection import list_finite_forms, pluralise

if TYPE_CHECKING:
    from texvent.scenes.description import (
        CameraMove,
        Effect,
        Illumination,
        ObjectMotion,
        SceneDescription,
        SceneObject,
        Shot,
        Surroundings,
    )


def describe(description: SceneDescription) -> tuple[str, ...]:
    """What will be shown: a line for each object and effect, place, light and camera."""
    lines = [_describe_object(description, index) for index in range(len(description.objects))]
    lines.extend(_describe_effect(description, effect) for effect in description.effects)
    lines.append(f"place: {_describe_surroundings(description.surroundings)}")
    lines.append(f"light: {_describe_light(description.light)}")
    lines.append(f"camera: {_describe_shot(description.shot)}")
    if description.absent:
        lines.append(f"left out as asked: {', '.join(description.absent)}")
    return tuple(lines)


def _describe_object(description: SceneDescription, index: int) -> str:
    scene_object = description.objects[index]
    words = [_describe_count(scene_object)]
    if scene_object.colour is not None:
        words.append(scene_object.colour.name)
    if scene_object.scale != 1.0:
        words.append(f"{scene_object.scale:g} times its usual size")
    is_plural = scene_object.count > 1
    if scene_object.motion is not None:
        words.append(_describe_motion(scene_object.motion, is_plural=is_plural))
    words += [f"then {_describe_motion(one, is_plural=is_plural)}" for one in scene_object.then]
    if scene_object.side is not None:
        words.append(_SIDES[scene_object.side])
    if scene_object.is_lit is not None:
        words.append("lit" if scene_object.is_lit else "not lit")
    if scene_object.blink_hz is not None:
        words.append(f"blinking at {scene_object.blink_hz:g} Hz")
    for relation in description.relations:
        if relation.subject == index:
            others = (_describe_count(description.objects[target]) for target in relation.targets)
            targets = "each other" if relation.targets == (index,) else " and ".join(others)
            words.append(f"{_RELATIONS.get(relation.kind, relation.kind)} {targets}")
    return ", ".join(words)


def _describe_effect(description: SceneDescription, effect: Effect) -> str:
    words = effect.kind if effect.colour is None else f"{effect.colour.name} {effect.kind}"
    if effect.source is not None:
        words += f", from {description.objects[effect.source].noun}"
    return words if effect.start_s is None else f"{words}, after {effect.start_s:g} s"


_SIDES = {
    "left": "on the left",
    "right": "on the right",
    "centre": "in the middle",
    "far": "far away",
    "lane": "on the road",
    "near": "in the foreground",
    "row": "in a row",
    "together": "side by side",
    "ring": "in a circle",
}
_RELATIONS = {
    "front": "in front of",
    "surround": "surrounded by",
    "follow": "following",
    "overtake": "overtaking",
    "look at": "looking at",
    "hold": "holding",
    "carry": "carrying",
    "wear": "wearing",
    "ride": "riding",
    "ride along": "riding along on",
    "push": "pushing",
    "pull": "pulling",
    "kick": "kicking",
    "hit": "hitting",
    "throw": "throwing",
    "catch": "catching",
    "collide": "meeting",
}
"""Relation → words for it, where they differ from its name."""
_BACKDROPS = {
    "mountain": "mountains around (the ground itself stays flat)",
    "forest": "forest around",
    "city": "buildings around",
}
_DIRECTIONS = {
    "towards": "towards the camera",
    "circle": "in a circle",
    "across": "across the picture",
}


def _describe_count(scene_object: SceneObject) -> str:
    name = scene_object.noun
    return f"{scene_object.count} {name if scene_object.count == 1 else pluralise(name)}"


def _describe_motion(motion: ObjectMotion, *, is_plural: bool) -> str:
    """A motion in words, such as "runs towards the camera"."""
    if motion.kind in _NAMED or (" " in motion.kind and motion.kind not in _PHRASES):
        words = [f"{'do' if is_plural else 'does'} '{motion.kind}'"]
    else:
        verb, *rest = _PHRASES.get(motion.kind, motion.kind).split()
        words = [verb if is_plural else list_finite_forms(verb)[1], *rest]
    if motion.direction is not None:
        words.append(_DIRECTIONS.get(motion.direction, motion.direction))
    if motion.speed_m_s is not None:
        words.append(f"at {motion.speed_m_s:.3g} m/s")
    elif motion.pace != 1.0:
        words.append(f"at {motion.pace:.2g} times its usual speed")
    return " ".join(words)


_NAMED = ("push-up", "sit-up", "phone", "fist", "victory", "ok")
"""Activities named by a noun."""
_PHRASES = {"throw": "fly through the air", "work": "move in place", "stand": "stand still",
            "change lane": "change lanes", "flip": "turn over in the air"}  # fmt: skip


def _describe_surroundings(surroundings: Surroundings) -> str:
    words = [surroundings.place or "what suits the things"]
    if surroundings.road is not None:
        words.append(f"{surroundings.road} road")
    if surroundings.colour is not None:
        words.append(surroundings.colour.name)
    if surroundings.sky is not None:
        words.append(f"{surroundings.sky.name} sky")
    if surroundings.weather is not None:
        words.append(surroundings.weather)
    if surroundings.clouds is not None:
        words.append("clouds" if surroundings.clouds > 0 else "no clouds")
    words.extend(_BACKDROPS[backdrop] for backdrop in surroundings.backdrops)
    if surroundings.has_snow and surroundings.place != "snow":
        words.append("snow on the ground")
    if surroundings.has_dust:
        words.append("dust")
    if surroundings.wave_height > 1.0:
        words.append("waves")
    return ", ".join(words)


_LIT_FROM = {
    "left": "from the left", "right": "from the right", "back": "from behind",
    "front": "from the front", "above": "from above",
}  # fmt: skip
"""Direction of light → its words."""


def _describe_light(light: Illumination) -> str:
    words = [light.kind or "day"]
    said = (light.tint.name if light.tint else None, light.hardness, light.brightness)
    words.extend(one for one in said if one is not None)
    if light.direction is not None:
        words.append(_LIT_FROM[light.direction])
    if light.is_low:
        words.append("low")
    if light.flicker_hz is not None:
        words.append(f"flickering at {light.flicker_hz:g} Hz")
    if light.shadows is not None:
        words.append("with shadows" if light.shadows else "without shadows")
    return ", ".join(words)


def _describe_shot(shot: Shot) -> str:
    words = [
        " ".join(filter(None, (move.kind, move.direction, _describe_times(move))))
        for move in shot.moves
    ] or ["static"]
    if shot.view is not None:
        words.append(f"{shot.view} view")
    if shot.framing is not None:
        words.append(f"{shot.framing} shot")
    return ", ".join(words)


def _describe_times(move: CameraMove) -> str:
    start = "" if move.start_s is None else f"from {move.start_s:g} s"
    stop = "" if move.stop_s is None else f"to {move.stop_s:g} s"
    return f"{start} {stop}".strip()
