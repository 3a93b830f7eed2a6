"""Whether the light and the weather that words name are seen in the picture."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from texvent.generate.seen_words.lighting import (
    BRIGHT,
    CLEAR_SKY,
    DEEP,
    LEAST_SHADOW,
    SUNNY,
    judge_lighting,
    shadow_share,
    sky_share,
)
from texvent.generate.seen_words.picture import DARK, DENSE, USUAL, VISIBLE, Picture
from texvent.scenes.description import Claim, SceneDescription
from texvent.scenes.projection import project
from texvent.scenes.raycast.trace import GROUND
from texvent.scenes.staging.compose import ComposedScene
from texvent.scenes.staging.surroundings.light.lighting import LIGHTINGS
from texvent.scenes.staging.surroundings.light.said_light import choose_lighting
from texvent.scenes.staging.surroundings.places import is_room

MOST_LIT = 0.36
"""Mean luma of the picture up to which it is night where no sky is seen."""
LOW_SUN = 0.45
"""Sine of the sun's height below which it is low and shadows are long."""
LEAST_FOG = 0.10
"""Mean change of the levels of things, as a share of white, that fog is seen by."""
LEAST_FALL = 0.004
"""Share of the picture that rain or snowflakes cover."""
LEAST_SKY = 0.03
_CHANGING = ("sunny", "overcast", "dawn", "dusk")
"""Lights of the sky, which rooms do not show."""
_SUN_WORDS = frozenset({"sun", "moon"})
_NOON = frozenset({"noon", "midday"})
"""Words for a high sun, whose light is seen as sunshine is."""
_LAMP_OF = {
    "candle": ("candle", "candlelight", "candlelit"),
    "street lamp": ("gaslit", "gaslight", "street light glow", "street lighting", "streetlight"),
}
_NO_LAMP = frozenset({"neon", "fluorescent", "fluorescent light", "neon light"})


def judge_light(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Why a word of light is not seen, or None."""
    if claim.aspect == "light":
        return _judge_kind(picture, description, claim)
    if claim.aspect == "lighting":
        return judge_lighting(picture, description, claim)
    if claim.aspect == "shadow":
        return _judge_shadows(picture, claim.word)
    if claim.aspect == "bright":
        return _judge_brightness(picture, claim.word)
    return None


def _judge_kind(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """For a time of day, a sky or a lamp."""
    kind, place = claim.value, description.surroundings.place or "grass"
    lighting = choose_lighting(place, description.light)
    if kind in _CHANGING and lighting.sun_direction != LIGHTINGS[kind].sun_direction:
        return "not to be told indoors" if is_room(place) else "not to be told here"
    if _SUN_WORDS & set(claim.word.split()) and not _is_sun_seen(picture):
        return "out of view"
    if kind in ("night", "moonlight"):
        has_sky = sky_share(picture) >= LEAST_SKY
        is_dark = picture.is_dark() and (has_sky or picture.brightness() <= MOST_LIT)
        is_night = is_dark or (has_sky and _is_sky_dark(picture))
        return None if is_night else "the picture is bright"
    if kind == "sunny" or _NOON & set(claim.word.split()):
        return _judge_sunshine(picture)
    if kind in ("dawn", "dusk") and sky_share(picture) < LEAST_SKY:
        return "no sky in view"
    if "sunlight" in claim.word and picture.brightness() < BRIGHT:
        return "the picture is dull"
    if kind == "lamp":
        return _judge_lamp(picture, claim.word)
    return None


def _is_sky_dark(picture: Picture) -> bool:
    """Whether the sky that is seen is as at night, whatever lamps light below it."""
    shades = []
    for number in USUAL:
        sky = picture.views[number].is_sky
        shades += list(picture.colours(number)[sky].mean(axis=1))
    return bool(np.mean(shades) <= DARK) if shades else False


def _judge_sunshine(picture: Picture) -> str | None:
    least = SUNNY if sky_share(picture) >= CLEAR_SKY else BRIGHT
    if picture.brightness() < least:
        return "the picture is dull"
    return _judge_shadows(picture, "")


def _judge_lamp(picture: Picture, word: str) -> str | None:
    if word.removesuffix("s") in _NO_LAMP:
        return "shown as the light of a lamp"
    names = picture.seen_nouns()
    for lamp, words in _LAMP_OF.items():
        if word.removesuffix("s") in words and lamp not in names:
            return f"no {lamp} in view"
    return None


def _judge_shadows(picture: Picture, word: str) -> str | None:
    least = DEEP if "shadow" in word else VISIBLE
    if shadow_share(picture, least) < LEAST_SHADOW:
        return "no shadow to be seen"
    height = picture.scene.environment(0.0).sun_direction[2]
    return "the sun is high" if "long" in word and height > LOW_SUN else None


def _judge_brightness(picture: Picture, word: str) -> str | None:
    if word == "dark":
        return None if picture.is_dark() else "the picture is bright"
    return None if picture.brightness() >= BRIGHT else "the picture is dull"


def _is_sun_seen(picture: Picture) -> bool:
    """Whether the disc of the sun or moon is in the picture, with nothing before it."""
    scene, size = picture.scene, picture.size
    for number in USUAL:
        view = picture.views[number]
        sun = scene.environment(view.time_s).sun_direction
        at = project(view.camera, size, np.asarray(view.camera.position) + 1e4 * sun)
        if at[2] <= 0.0 or not (0.0 <= at[0] < size.width and 0.0 <= at[1] < size.height):
            continue
        nearest = int(np.argmin(np.linalg.norm(picture.points - at[:2], axis=1)))
        if view.is_sky[nearest]:
            return True
    return False


def judge_weather(picture: Picture, claim: Claim) -> str | None:
    """Why fog, rain or snowfall is not seen, or None."""
    if claim.value == "fog":
        return _judge_fog(picture)
    shares = [
        float(np.mean(picture.difference(without(claim.value, None), number) > VISIBLE))
        for number in USUAL
    ]
    return None if max(shares) >= LEAST_FALL else "hardly to be seen"


def _judge_fog(picture: Picture) -> str | None:
    """Fog must pale things, or the ground and scenery where there are none."""
    for number in USUAL[1:]:
        view = picture.views[number]
        where = view.instance > 0
        if not where.any():
            where = ~view.is_sky
        if where.any() and picture.difference(_without_fog, number)[where].mean() >= LEAST_FOG:
            return None
    return "too thin to be seen"


def _without_fog(scene: ComposedScene) -> ComposedScene:
    clear = replace(scene.animated_environment.base, fog_distance=float("inf"))
    return replace(scene, animated_environment=replace(scene.animated_environment, base=clear))


def without(kind: str, source: int | None) -> Callable[[ComposedScene], ComposedScene]:
    """What takes the particles of an effect or a weather out of a scene."""

    def change(scene: ComposedScene) -> ComposedScene:
        staged = scene.particles
        kept = tuple(
            effect
            for effect, of in zip(staged.effects, staged.kinds, strict=True)
            if of != (kind, source)
        )
        kinds = tuple(of for of in staged.kinds if of != (kind, source))
        return replace(scene, particles=replace(staged, effects=kept, kinds=kinds))

    return change


_BRIGHTER = 1.35
"""Ratio of coded levels by which snow is told from rock."""


def judge_snow(picture: Picture) -> str | None:
    """Why snow on the ground is not seen, or None."""
    shares = []
    for number in USUAL:
        ground = picture.views[number].number == GROUND
        pixels = picture.colours(number)[ground]
        white = (np.ptp(pixels, axis=1) < 0.16) & (pixels.min(axis=1) > 0.35)
        shares.append(float(white.sum()) / len(ground))
    return None if max(shares) >= 0.05 else "no white ground in view"


def capped_share(picture: Picture, noun: str) -> float:
    """Share of what shows a noun that is much brighter than most of it, such as snow on rock."""
    scenery = picture.scene.list_scenery()
    shares = [0.0]
    for number in USUAL:
        view = picture.views[number]
        nouns = [
            picture.scene.class_names.get(int(view.owner[one]), "")
            or (scenery[one] if one < len(scenery) else "")
            for one in range(len(view.owner))
        ]
        wanted = [one for one, name in enumerate(nouns) if name == noun]
        luma = picture.colours(number)[np.isin(view.number, wanted)].mean(axis=1)
        if len(luma):
            shares.append(float(np.mean(luma > _BRIGHTER * np.median(luma))))
    return max(shares)


def changed_points(picture: Picture, kind: str, source: int | None) -> dict[int, np.ndarray]:
    """Per view, the image points at which an effect is seen."""
    return {number: picture.difference(without(kind, source), number) > VISIBLE for number in DENSE}
