"""All words of a prompt that the scene was staged for, and which of them are not to be seen."""

from __future__ import annotations

from texvent.generate.seen_words.camera.camera_moves import judge_move
from texvent.generate.seen_words.camera.views import judge_camera
from texvent.generate.seen_words.colours import share_like
from texvent.generate.seen_words.courses import judge_courses
from texvent.generate.seen_words.degrees import claims_after, judge_degree
from texvent.generate.seen_words.effects import FILLING, judge_effects, judge_filling
from texvent.generate.seen_words.light import (
    capped_share,
    judge_light,
    judge_snow,
    judge_weather,
)
from texvent.generate.seen_words.picture import USUAL, Picture
from texvent.generate.seen_words.places import judge_place
from texvent.generate.seen_words.positions import judge_position
from texvent.generate.seen_words.things import judge_thing
from texvent.scenes.description import Claim, SceneDescription
from texvent.scenes.language.vocabulary.film import GREYSCALE
from texvent.scenes.language.vocabulary.scene import SNOW_CAPPED
from texvent.scenes.raycast.trace import GROUND
from texvent.scenes.staging.surroundings.places import is_room

_OF_THINGS = frozenset({"name", "colour", "size", "material", "part", "side", "count"})
_OF_SCENE = ("light", "weather", "effect", "dust")
_WAVES = ("wave", "waves")
"""What a surfer is said to ride."""
_LEAST_PAINTED = 0.05
_LEAST_CAPPED = 0.04
"""Share of the mountains in view that is snow, where they are said to be capped."""


def judge_words(
    picture: Picture, description: SceneDescription
) -> tuple[dict[str, str], dict[tuple[str, int], str]]:
    """What words say that the picture does not show.

    Args:
        picture: of the staged scene.
        description: what it was staged from.

    Returns:
        Words of the scene → why; aspect and object → why.
    """
    effects = judge_effects(picture, description) if picture.scene.particles.kinds else {}
    words = judge_courses(picture, description)
    qualities: dict[tuple[str, int], str] = {}
    for claim in description.claims:
        is_wave = claim.word in _WAVES and claim.aspect == "name" and claim.motion is not None
        if is_wave and description.surroundings.wave_height <= 1.0:
            words.setdefault(claim.word, "the sea is calm")
        fault = judge_degree(picture, description, claim)
        if fault is None and claim.aspect == "relation":
            fault = judge_position(picture, claim)
        if fault is None and claim.things and claim.aspect in _OF_THINGS:
            qualities = {**_judge_qualities(picture, description, claim), **qualities}
            continue
        fault = fault or _judge_scene_word(picture, description, claim, effects)
        if fault is not None:
            words.setdefault(claim.word, fault)
    for claim in description.claims:
        fault = next((words[one] for one in _said_of(claim, description) if one in words), None)
        if fault is None and _is_of_scene(claim):
            fault = next(iter(effects.values()), None)
        if fault is not None:
            words.setdefault(claim.word, fault)
    return words, qualities


def _judge_qualities(
    picture: Picture, description: SceneDescription, claim: Claim
) -> dict[tuple[str, int], str]:
    """Aspect of a claim and object of which it is not seen → why."""
    faults = {one: judge_thing(picture, description, claim, one) for one in claim.things}
    return {(claim.aspect, one): fault for one, fault in faults.items() if fault is not None}


def _said_of(claim: Claim, description: SceneDescription) -> list[str]:
    """Words for what rain, light or smoke does: a verb that is of no thing."""
    if not _is_of_scene(claim):
        return []
    return [one.word for one in description.claims if one.aspect in _OF_SCENE]


def _is_of_scene(claim: Claim) -> bool:
    is_act = claim.aspect == "motion" or (claim.aspect == "quality" and claim.word.endswith("ing"))
    return is_act and not claim.things and claim.move is None


def _judge_scene_word(
    picture: Picture, description: SceneDescription, claim: Claim, effects: dict[str, str]
) -> str | None:
    """Why a word of the scene itself is not seen, or None."""
    if claim.aspect in ("light", "lighting", "shadow", "bright"):
        return judge_light(picture, description, claim)
    if claim.aspect == "weather":
        is_said = description.surroundings.weather == claim.value
        return judge_weather(picture, claim) if is_said else None
    if claim.aspect == "snow":
        return _judge_snow(picture, description, claim)
    if claim.aspect in ("style", "viewpoint"):
        return _judge_style(picture, claim)
    if claim.move is not None:
        return judge_move(picture, description, claim)
    if claim.aspect in ("view", "framing"):
        return judge_camera(picture, description, claim)
    if claim.aspect in ("place", "steep", "clouds", "sky", "waves"):
        return judge_place(picture, description, claim)
    if claim.aspect == "colour":
        return _judge_painted(picture, description, claim)
    if claim.aspect in ("effect", "dust"):
        return _judge_effect(picture, description, claim, effects)
    return None


def _judge_style(picture: Picture, claim: Claim) -> str | None:
    """Nothing is drawn in a style; a film is in black and white."""
    if claim.value == GREYSCALE:
        return None if picture.is_grey() else "there are colours"
    return claim.value


def _judge_effect(
    picture: Picture, description: SceneDescription, claim: Claim, effects: dict[str, str]
) -> str | None:
    """An effect, or dust behind what drives."""
    staged = {one for one, _ in picture.scene.particles.kinds}
    kind = str(claim.value) if claim.aspect == "effect" else "dust"
    if kind == "string lights" and kind not in staged:
        kind = "blinking lights"
    if f"{kind} into" in staged:
        kind = f"{kind} into"
    if kind not in staged:
        return "nothing raises it"
    if claim.aspect == "dust" and is_room(description.surroundings.place or "grass"):
        return "only at the feet of who moves"
    if f"{claim.word} fill" in description.prompt.casefold() and kind in FILLING:
        return effects.get(kind) or judge_filling(picture, kind)
    return effects.get(kind)


def _judge_snow(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    if claim.word in SNOW_CAPPED:
        is_capped = capped_share(picture, "mountain") >= _LEAST_CAPPED
        return None if is_capped else "no white top in view"
    is_of_mountains = claim.word.startswith("snow") and claim.word != "snow"
    has_mountains = "mountain" in description.surroundings.backdrops
    if is_of_mountains and has_mountains and not _is_of_ground(claim, description):
        return "the mountains are bare"
    return judge_snow(picture) if description.surroundings.has_snow else None


def _is_of_ground(claim: Claim, description: SceneDescription) -> bool:
    """Whether the noun after a word names a place other than mountains: "a snowy meadow"."""
    others = claims_after(claim, description)
    is_other = any(one.aspect == "name" or "mountain" in one.word for one in others)
    return not is_other and any(one.aspect in ("place", "steep") for one in others)


def _judge_painted(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """The colour of the ground or the sky."""
    said = description.surroundings
    for named, is_sky in ((said.colour, False), (said.sky, True)):
        if named is None or claim.word not in named.name.split():
            continue
        for number in USUAL:
            view = picture.views[number]
            where = view.is_sky if is_sky else view.number == GROUND
            if said.place == "plain" and not is_sky:
                where = where | view.is_sky  # a backdrop goes all around
            if where.mean() >= _LEAST_PAINTED:
                pixels = picture.colours(number)[where]
                if share_like(pixels, named.rgb) >= 0.3:
                    return None
        return f"no {claim.word} {'sky' if is_sky else 'ground'} to be seen"
    return None
