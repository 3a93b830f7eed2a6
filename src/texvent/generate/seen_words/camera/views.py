"""Whether the camera stands and looks as its words say."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np

from texvent.generate.seen_words.camera.view_objects import find_close_up, find_looker, is_of_head
from texvent.generate.seen_words.picture import Picture, View
from texvent.generate.sights import LEAST_SIZE
from texvent.scenes.description import Claim, SceneDescription
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.projection import project
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.main_actor import choose_main

STEEP_DOWN, SLANT_DOWN = 0.85, 0.3
"""Sine of the angle at which the camera looks down in a top view, and at least from the air."""
LOW_M = 0.7
"""Height at which a camera is low in any case, m."""
KNEE_M, LOOKING_UP = 1.8, 0.05
"""Height up to which it is low if it looks up, m; and sine of the angle at which it does."""
LEAST_CLOSE = 0.5
"""Share of the picture's width or height that a thing in close-up fills."""
MOST_WIDE = 0.5
"""The same up to which a shot is wide."""
LEAST_UP = 0.15
"""How much higher than the camera something seen from below is, per metre of distance."""
_FROM_WHOM = re.compile(r"\b(from|of|through)( the eyes of)? (a|an|the|its|his|her)( \w+){1,3}")
_BELOW = ("below", "underneath", "worm eye", "worm eye view", "worm eye shot")
EYES_M, MOST_SLANT = (0.15, 2.4), 0.3
"""Heights of a camera at the level of eyes, m; and sine of the angle at which it looks at most."""
HEIGHTS_M = {"waist": (0.7, 1.25), "chest": (0.9, 1.6), "shoulder": (1.0, 1.7)}
"""Part of a person → heights of a camera at its level, m."""
MOST_DOWN = 0.3
"""Sine of the angle at which a low camera looks down at most."""
MOST_OF_CLIP = 0.6
LEAST_SHOULDER, LEAST_ASIDE, LEAST_BEYOND = 0.9, 0.12, 0.02
"""Of a view over a shoulder: height of who is looked past, in pictures; how far that one is from
the middle, in widths of the picture; share of the picture that things beyond cover."""
LEAST_EXTREME, MOST_SKY = 0.5, 0.02
"""Shares of the picture that a thing in extreme close-up and the sky cover, at least and most."""
LEAST_PORTRAIT = 4.0
"""Least height of a person of whom the head fills the picture, in heights of the picture."""
_BEARINGS = {"side": (-0.6, 0.6), "front": (0.6, 1.0), "back": (-1.0, -0.6),
             "shoulder": (-1.0, -0.5)}  # fmt: skip
"""View → least and most cosine of the angle between its heading and the way to the camera."""
_LEVEL_VIEWS, MOST_STEEP = ("front", "side", "back"), 0.42
"""Views from one side, and sine of the angle at which their camera looks down at most."""
_SIZES = {"close": (1.5, math.inf), "medium": (0.7, 2.4), "full": (0.4, 1.05)}
"""Framing → least and most height, in heights of the picture; a person in close-up is cut."""


def judge_camera(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Why a view or a framing is not seen, or None."""
    down = [-float(view.camera.rotation[2, 2]) for view in picture.views]
    if claim.value == "top" and max(down) < STEEP_DOWN:
        return "the camera does not look straight down"
    if claim.value == "aerial" and float(np.median(down)) < SLANT_DOWN:
        return "the camera does not look down"
    if claim.word == "up" and -min(down) < LOOKING_UP:
        return "the camera does not look up"
    if claim.value in _LEVEL_VIEWS and float(np.median(down)) > MOST_STEEP:
        return "the camera looks down"
    if claim.value == "low":
        return _judge_low(picture) or _judge_below(picture, description, claim)
    if claim.value == "level":
        return _judge_level(picture, claim.word)
    if claim.value == "wide" and _greatest_extent(picture) > MOST_WIDE:
        return "things fill the picture"
    if claim.value == "first person":
        return _judge_own_eyes(picture, description)
    if claim.value in (*_BEARINGS, *_SIZES):
        return _judge_of_thing(picture, description, claim)
    return None


def _judge_of_thing(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """A view or a framing of the main thing, or of what a close-up is said to be of."""
    if not picture.scene.actors:
        return "nothing is there to look at"
    if claim.value == "close":
        return _judge_close(picture, description, claim)
    main = choose_main(description, picture.scene.actors)
    return _judge_looked_at(picture, main) or _judge_main(picture, main, claim)


def _judge_close(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """A close-up shows what it is said to be of: hands, and not whom they belong to."""
    main, part = find_close_up(picture, description)
    if part is not None and not (is_of_head(part) and _is_portrait(picture, main)):
        return f"shows more than {part}"
    return _judge_looked_at(picture, main) or _judge_main(picture, main, claim)


def _is_portrait(picture: Picture, main: Actor) -> bool:
    heights = [_height_in_picture(picture, main, view) for view in picture.views]
    return main.noun.name in PERSON_NOUNS and float(np.median(heights)) >= LEAST_PORTRAIT


def _judge_main(picture: Picture, main: Actor, claim: Claim) -> str | None:
    """From where it looks at its main thing, or how large that is."""
    if claim.value in _BEARINGS:
        return _judge_bearing(picture, main, str(claim.value))
    framing = "extreme" if claim.word.startswith("extreme close") else str(claim.value)
    return _judge_size(picture, main, framing)


def _judge_looked_at(picture: Picture, main: Actor) -> str | None:
    """What the camera is about must be in view for most of the clip, and no speck."""
    same = [one.instance for one in picture.scene.actors if one.object_index == main.object_index]
    edge = np.array([picture.size.width, picture.size.height])
    told = 0
    for view in picture.views:
        at = picture.points[np.isin(view.instance, same)]
        told += len(at) > 0 and float((np.ptp(at, axis=0) / edge).max()) >= LEAST_SIZE
    is_told = told >= MOST_OF_CLIP * len(picture.views)
    return None if is_told else f"no {main.noun.name} to be told most of the time"


def _judge_low(picture: Picture) -> str | None:
    """Whether the camera is low, and does not look down on the ground."""
    for view in picture.views:
        height, up = float(view.camera.position[2]), float(view.camera.rotation[2, 2])
        is_flat = height <= LOW_M and up >= -MOST_DOWN
        if is_flat or (height <= KNEE_M and up >= LOOKING_UP):
            return None
    return "the camera is not low"


def _judge_below(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """From below one looks up at a thing: its middle is well above the camera."""
    actors = picture.scene.actors
    if not claim.word.endswith(_BELOW) or not actors:
        return None
    main = choose_main(description, actors)
    for view in picture.views:
        x, y, z = main.middle(view.time_s) - view.camera.position
        if z >= LEAST_UP * math.hypot(x, y):
            return None
    return f"the {main.noun.name} is not seen from below"


def _judge_level(picture: Picture, word: str) -> str | None:
    """Whether the camera is as high as that part of a person, and looks about level."""
    least, most = next((own for part, own in HEIGHTS_M.items() if part in word.split()), EYES_M)
    for view in picture.views:
        height, up = float(view.camera.position[2]), float(view.camera.rotation[2, 2])
        if least <= height <= most and abs(up) <= MOST_SLANT:
            return None
    return "the camera is not at that height"


def _judge_own_eyes(picture: Picture, description: SceneDescription) -> str | None:
    """Whether the camera goes itself, as who looks through it, who is not in the picture."""
    if not any(move.kind == "travel" for move in description.shot.moves):
        return "the camera looks on"
    looker = find_looker(picture, description)
    if looker is not None:
        return f"the {looker} is seen from outside"
    found = _FROM_WHOM.search(description.prompt.casefold())
    names = [one for one in description.claims if one.aspect == "name"]
    for claim in names if found else ():
        is_there = any(one.object_index in claim.things for one in picture.scene.actors)
        if is_there and found and re.search(rf"\b{re.escape(claim.word)}\b", found.group(0)):
            return f"the {claim.word} itself is in the picture"
    return None


def _judge_bearing(picture: Picture, main: Actor, view_from: str) -> str | None:
    """From the side, front or back: the angle between what it looks at and the camera."""
    if view_from == "shoulder" and not _looks_past(picture, main):
        return "nothing is seen beyond a shoulder"
    if not (main.noun.speed_m_s > 0.0 and main.noun.habitat != "fixed"):
        return None  # a vase has no front
    least, most = _BEARINGS[view_from]
    fits = 0
    for view in picture.views:
        yaw = main.trajectory.at(view.time_s).yaw
        x, y = (view.camera.position - main.middle(view.time_s))[:2]
        cosine = (x * math.cos(yaw) + y * math.sin(yaw)) / max(math.hypot(x, y), 1e-9)
        fits += least <= cosine <= most
    is_seen = fits >= MOST_OF_CLIP * len(picture.views)
    return None if is_seen else f"the {main.noun.name} is seen from another side"


def _looks_past(picture: Picture, main: Actor) -> bool:
    """Whether who is looked past is large and at the picture's edge, with something beyond."""
    view = picture.views[len(picture.views) // 2]
    own = view.instance == main.instance
    if not own.any() or _height_in_picture(picture, main, view) < LEAST_SHOULDER:
        return False
    aside = abs(float(picture.points[own, 0].mean()) / picture.size.width - 0.5)
    beyond = (view.instance > 0) & ~own
    return aside >= LEAST_ASIDE and float(beyond.mean()) >= LEAST_BEYOND


def _fills(picture: Picture, main: Actor) -> bool:
    """Whether what it looks at covers most of the picture, and no horizon is in view."""
    same = [one.instance for one in picture.scene.actors if one.object_index == main.object_index]
    shares = [float(np.isin(view.instance, same).mean()) for view in picture.views]
    sky = min(float(view.is_sky.mean()) for view in picture.views)
    has_horizon = sky >= MOST_SKY and picture.ground_share() >= MOST_SKY
    return max(shares) >= LEAST_EXTREME and not has_horizon


def _judge_size(picture: Picture, main: Actor, framing: str) -> str | None:
    """How large what it looks at is in the picture."""
    if framing == "extreme":
        return None if _fills(picture, main) else "it does not fill the picture"
    if main.noun.name in PERSON_NOUNS:
        heights = [_height_in_picture(picture, main, view) for view in picture.views]
        tallest = float(np.median(heights))
    else:
        own = [one.instance for one in picture.scene.actors
               if one.object_index == main.object_index]  # fmt: skip
        tallest = _greatest_extent(picture, own)
        if framing == "close":
            return None if tallest >= LEAST_CLOSE else "things are small in the picture"
    least, most = _SIZES[framing]
    if tallest < least:
        return f"the {main.noun.name} is further away"
    return f"the {main.noun.name} is nearer" if tallest > most else None


def _height_in_picture(picture: Picture, main: Actor, view: View) -> float:
    """Height of its box, in heights of the picture, of which it may reach out."""
    seen = project(view.camera, picture.size, main.corners(view.time_s))
    if np.any(seen[:, 2] <= 0.0):
        return math.inf
    return float(np.ptp(seen[:, 1])) / picture.size.height


def _greatest_extent(picture: Picture, instances: Sequence[int] | None = None) -> float:
    """Of any of the things in any view, as a share of the picture's width or height."""
    edge = np.array([picture.size.width, picture.size.height])
    best = 0.0
    for view in picture.views:
        for one in np.unique(view.instance[view.instance > 0]):
            if instances is None or one in instances:
                at = picture.points[view.instance == one]
                best = max(best, float((np.ptp(at, axis=0) / edge).max()))
    return best
