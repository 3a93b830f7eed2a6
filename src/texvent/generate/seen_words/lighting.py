"""Whether the picture shows how its light is said to be: its colour, hardness, direction ..."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from texvent.generate.seen_words.picture import USUAL, VISIBLE, Picture
from texvent.scenes.description import Claim, Illumination, SceneDescription
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.compose import ComposedScene
from texvent.scenes.staging.surroundings.light.said_light import tint_of

BRIGHT, SUNNY, CLEAR_SKY = 0.42, 0.32, 0.08
"""Mean luma of a bright picture; of one in sunshine where so much of it is sky."""
MOST_DIM, MOST_GLOOMY = 0.28, 0.38
"""Mean luma of a dim and of a gloomy picture."""
LEAST_SHADOW, DEEP = 0.02, 0.12
"""Share of the picture that shadows darken visibly; by how much, where a word names them."""
MOST_SOFT = 0.005
"""The same share of a picture in soft light."""
LEAST_TINT = {"warm": 0.28, "golden": 0.32, "cold": 0.02}
LEAST_COLOURED = 0.4
"""How much of its tint the mean colour has, as a share of its luma."""
LEAST_GAIN = 0.1
"""How much of that the tint of the light must have brought."""
LEAST_BACK, MOST_BACK = 0.15, 0.7
"""How much darker, in luma, things must be than in light from the other side; their luma as a share
of that of the rest, at most. So bright a background is the sky."""
LEAST_SIDE, LEAST_OWN_SIDE = 0.2, 0.12
"""How much brighter the lit half of a thing is: than lit from the other side, and than the other
half."""
MOST_TURNED = 0.8
"""Cosine by which the camera turns at most while light comes from one side of it."""
LEAST_THING = 0.004
"""Share of the picture that a thing covers whose sides are compared."""
_MIDDLE = USUAL[1]
"""View that is compared with one in other light."""
_LUMA = np.array([0.299, 0.587, 0.114])
_LAMPLIT = ("night", "moonlight", "lamp")


def judge_lighting(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Why a word for how the light is, such as "warm" or "backlit", is not seen; None = it is."""
    light, value = description.light, claim.value
    if light.tint is not None and value == light.tint.name:
        return _judge_tint(picture, light)
    if value == "soft":
        is_soft = shadow_share(picture, VISIBLE) <= MOST_SOFT
        return None if is_soft else "there are hard shadows"
    if value == "hard":
        return _judge_hard(picture, light)
    if value in ("bright", "gloomy", "dim"):
        return _judge_brightness(picture, value)
    return _judge_direction(picture, value)


def _judge_tint(picture: Picture, light: Illumination) -> str | None:
    """The mean colour must have the tint, and have it from the light."""
    tint = np.array(tint_of(light))
    along = tint - tint.mean()
    along /= max(float(np.linalg.norm(along)), 1e-9)
    seen = picture.colours(_MIDDLE)
    luma = max(float(seen.mean(axis=0) @ _LUMA), 1e-9)
    name = light.tint.name if light.tint is not None else ""
    if float(seen.mean(axis=0) @ along) < LEAST_TINT.get(name, LEAST_COLOURED) * luma:
        return "hardly to be told"
    is_lit = ~picture.views[_MIDDLE].is_sky
    gained = seen - picture.changed(partial(_untinted, tint=tint), _MIDDLE)
    if not is_lit.any() or float(gained[is_lit].mean(axis=0) @ along) < LEAST_GAIN * luma:
        return "hardly to be told"
    return None


def _untinted(scene: ComposedScene, tint: Float64Array) -> ComposedScene:
    """The scene in white light."""
    base, lamps = scene.animated_environment.base, scene.lamps.still.copy()
    lamps[:, 3:6] /= tint
    white = replace(
        base,
        sun_colour=(base.sun_colour / tint).astype(np.float32),
        ambient=(base.ambient / tint).astype(np.float32),
    )
    return replace(
        scene,
        animated_environment=replace(scene.animated_environment, base=white),
        lamps=replace(scene.lamps, still=lamps),
    )


def _judge_hard(picture: Picture, light: Illumination) -> str | None:
    is_lamplit = light.kind in _LAMPLIT or light.brightness == "dim"
    least = SUNNY if sky_share(picture) >= CLEAR_SKY else BRIGHT
    if not is_lamplit and picture.brightness() < least:
        return "the picture is dull"
    return None if shadow_share(picture, DEEP) >= LEAST_SHADOW else "no shadow to be seen"


def _judge_brightness(picture: Picture, value: str) -> str | None:
    if value == "bright":
        return None if picture.brightness() >= BRIGHT else "the picture is dull"
    most = MOST_DIM if value == "dim" else MOST_GLOOMY
    return None if picture.brightness() <= most else "the picture is bright"


def _judge_direction(picture: Picture, value: str) -> str | None:
    """Where the light comes from is told by the sides of things."""
    if value == "above":
        return "not to be told from usual light"
    if value == "low":
        is_told = shadow_share(picture, VISIBLE) >= LEAST_SHADOW
        return None if is_told else "no shadow to be seen"
    right, _, forward = picture.views[_MIDDLE].camera.rotation
    for number in USUAL:
        if float(picture.views[number].camera.rotation[0] @ right) < MOST_TURNED:
            return "the camera turns"
    if value in ("back", "front"):
        return _judge_depth(picture, forward, is_behind=value == "back")
    sign = 1.0 if value == "left" else -1.0
    return None if _lights_side(picture, right, sign) else "hardly to be told"


def _judge_depth(picture: Picture, forward: Float64Array, *, is_behind: bool) -> str | None:
    """Things lit from behind are darker than in light from the front, and than the rest."""
    things = picture.views[_MIDDLE].instance > 0
    if not things.any() or things.all():
        return "hardly to be told"
    flat = forward * (1.0, 1.0, 0.0)
    across = flat / max(float(np.linalg.norm(flat)), 1e-9)
    seen = picture.colours(_MIDDLE) @ _LUMA
    turned = picture.changed(partial(_mirrored, across=across), _MIDDLE) @ _LUMA
    change = float(seen[things].mean() - turned[things].mean())
    if is_behind:
        is_dark = float(seen[things].mean()) <= MOST_BACK * float(seen[~things].mean())
        is_told = change <= -LEAST_BACK and is_dark and sky_share(picture) >= CLEAR_SKY
        return None if is_told else "hardly to be told"
    return None if change >= LEAST_BACK else "hardly to be told"


def _lights_side(picture: Picture, right: Float64Array, sign: float) -> bool:
    """Whether a thing is brighter on the side that the light comes from."""
    view = picture.views[_MIDDLE]
    seen = picture.colours(_MIDDLE) @ _LUMA
    mirrored = picture.changed(partial(_mirrored, across=right), _MIDDLE) @ _LUMA
    for one in np.unique(view.instance[view.instance > 0]):
        where = view.instance == one
        is_left = picture.points[where, 0] < np.median(picture.points[where, 0])
        if where.mean() < LEAST_THING or not is_left.any():
            continue
        own, gained = seen[where], (seen - mirrored)[where]
        by_light = sign * _left_less_right(gained, is_left)
        if by_light >= LEAST_SIDE and sign * _left_less_right(own, is_left) >= LEAST_OWN_SIDE:
            return True
    return False


def _left_less_right(values: Float64Array, is_left: NDArray[np.bool_]) -> float:
    return float(values[is_left].mean() - values[~is_left].mean())


def _mirrored(scene: ComposedScene, across: Float64Array) -> ComposedScene:
    """The scene lit from the other side of what the camera looks at, along a unit vector [3]."""
    animated, lamps = scene.animated_environment, scene.lamps.still.copy()
    sun = animated.base.sun_direction
    lamps[:, :3] -= 2.0 * np.outer((lamps[:, :3] - scene.camera_path.framing.target) @ across,
                                   across)  # fmt: skip
    base = replace(animated.base, sun_direction=sun - 2.0 * (sun @ across) * across)
    return replace(
        scene,
        animated_environment=replace(animated, base=base),
        lamps=replace(scene.lamps, still=lamps),
    )


def shadow_share(picture: Picture, least: float) -> float:
    """Share of the picture that shadows darken by so much, at the instant that shows most."""
    return max(
        float(np.mean(picture.difference(None, number, shadows=False) > least))
        for number in USUAL[1:]
    )


def sky_share(picture: Picture) -> float:
    """Share of the picture that is sky, at the instant that shows most of it."""
    return max(float(np.mean(picture.views[number].is_sky)) for number in USUAL)
