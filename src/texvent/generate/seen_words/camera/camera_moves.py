"""Whether the camera is seen to move, or to stand, as its words say."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from texvent.generate.seen_words.picture import Picture, View
from texvent.scenes.description import Claim, SceneDescription
from texvent.scenes.language.vocabulary.motion import PACE_ADJECTIVES, PACES
from texvent.scenes.projection import project, ray_directions
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.camera.main_actor import choose_main

LEAST_SHIFT = 0.05
"""Way of a point over the clip, as a share of the picture's width, that is seen as the camera's."""
LEAST_SHARE = 0.12
"""Share of the picture that goes so far at least where a camera moves."""
MOST_STILL = 0.004
"""Greatest way in the picture of a camera that stands, a share of its width."""
MOST_DRIFT = 0.35
"""How far what a camera follows may go in the picture, a share of its width."""
MOST_GROWTH = 1.6
"""How much farther off what is followed from behind may be at one instant than at another."""
LEAST_FAST = 0.2
"""Way of most of the picture in a second from which on a camera is fast, over its width."""
_FAST_WORDS = frozenset(
    word for table in (PACES, PACE_ADJECTIVES) for pace, words in table.items() if pace > 1.0
    for word in words
)  # fmt: skip
_STOPPING = re.compile(r"(stop|pause|halt|wait|rest)\w*")
_OF_PLACE = frozenset({"travel", "dolly", "truck", "pedestal", "crane", "orbit", "dolly zoom"})
_WITH_STATIC = frozenset({"static", "dutch", "travel", "handheld", "follow", "pan", "tilt", "zoom"})
"""Moves beside which a camera may be said to be fixed: to what goes, or where it only turns."""
_DIRECTIONS = frozenset({"left", "right", "up", "down", "in", "out"})
_FALLING_BACK = re.compile(r"\b(fall|drop)(s|ing)? (behind|back)\b")
_MOUNTED = frozenset({"mounted", "attached", "strapped", "fixed", "fastened"})
_VEHICLES = ("drive", "cycle", "sail", "fly")
_STANDS_ON = re.compile(
    r"\b(mounted|attached|strapped|fixed|fastened)( \w+)?( on| to| from)?( \w+){0,2}"
    r" (tripod|wall|ceiling|pole|post|stand|ground|mast|lamp post)\b"
)
_TURNS = frozenset({"pan", "tilt", "zoom", "roll"})


def judge_move(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Why a move of the camera is not seen, or None.

    Args:
        picture: of the staged scene.
        description: what it was staged from.
        claim: of a word that asks for a move.
    """
    said = {move.direction for move in description.shot.moves if move.kind == claim.move}
    if claim.word in _DIRECTIONS and claim.word not in said:
        return "the camera does not go that way"
    prompt = description.prompt.casefold()
    if _FALLING_BACK.search(prompt) and claim.word.startswith(("fall", "drop")):
        return "the camera does not stay behind"
    if claim.word in _MOUNTED and not _is_mounted(description, prompt):
        return "what it is mounted on is not to be told"
    if claim.word in _FAST_WORDS and not _is_fast(picture):
        return "the camera is not fast"
    first, last = picture.views[0], picture.views[-1]
    if claim.move == "static" and _STOPPING.fullmatch(claim.word) and not _stops(picture):
        return "the camera does not stop"
    if claim.move == "static":
        shot = description.shot.moves
        still = {move.phase for move in shot if move.kind == "static"}
        if any(move.kind not in _WITH_STATIC and move.phase in still for move in shot):
            return "the camera moves"
        is_alone = all(move.kind == "static" for move in shot)
        moves = is_alone and np.max(_shifts(picture, first, last), initial=0.0) > MOST_STILL
        return "the camera moves" if moves else None
    share = max(_share_moved(picture, first, one) for one in picture.views[1:])
    if claim.move in _OF_PLACE or claim.move in _TURNS:
        return "the picture hardly shifts" if share < LEAST_SHARE else None
    if claim.move == "follow":
        return _judge_follow(picture, description, share)
    return None


def _is_mounted(description: SceneDescription, prompt: str) -> bool:
    """Whether it stands on what stays, or goes as the vehicle does that it is on."""
    goes = any(one.kind == "travel" and one.means in _VEHICLES for one in description.shot.moves)
    return goes or _STANDS_ON.search(prompt) is not None


def _is_fast(picture: Picture) -> bool:
    """Whether between some two views most of the picture goes far for the time."""
    return any(
        float(np.median(shifts)) >= LEAST_FAST * (after.time_s - before.time_s)
        for before, after, shifts in _steps(picture)
        if len(shifts)
    )


def _stops(picture: Picture) -> bool:
    """Whether between some two views nothing of what stands goes."""
    return any(np.max(shifts, initial=0.0) <= MOST_STILL for _, _, shifts in _steps(picture))


def _steps(picture: Picture) -> Iterator[tuple[View, View, Float64Array]]:
    """Views that follow each other, and the ways between them."""
    for before, after in pairwise(picture.views):
        yield before, after, _shifts(picture, before, after)


def _shifts(picture: Picture, first: View, last: View) -> Float64Array:
    """[n] way in the picture of what stands, over its width, by the camera alone."""
    where = np.isfinite(first.depth) & (first.depth > 0.0) & (first.instance == 0)
    rays = ray_directions(first.camera, picture.size, picture.points[where])
    spots = first.camera.position + rays * first.depth[where, None]
    seen = project(last.camera, picture.size, spots)
    way = np.linalg.norm(seen[:, :2] - picture.points[where], axis=1) / picture.size.width
    # What has come beside or behind the camera has left the picture.
    return np.asarray(np.where(seen[:, 2] > 0.0, np.minimum(way, 1.0), 1.0))


def _share_moved(picture: Picture, first: View, last: View) -> float:
    is_moved: NDArray[np.bool_] = _shifts(picture, first, last) >= LEAST_SHIFT
    sky = int(first.is_sky.sum()) if _turned(first, last) else 0
    return float(is_moved.sum() + sky) / len(picture.points)


def _turned(first: View, last: View) -> bool:
    """Whether the camera turns or zooms, so that the sky shifts too."""
    angle = np.abs(np.asarray(first.camera.rotation) - np.asarray(last.camera.rotation)).max()
    return bool(angle > LEAST_SHIFT or abs(last.camera.focal / first.camera.focal - 1.0) > 0.03)


def _judge_follow(picture: Picture, description: SceneDescription, share: float) -> str | None:
    """Whether the camera goes along with something that goes on."""
    actors = picture.scene.actors
    if not actors:
        return "nothing that it follows is there"
    main = choose_main(description, actors)
    first, last = picture.views[0], picture.views[-1]
    way = np.linalg.norm(main.middle(last.time_s) - main.middle(first.time_s))
    if way < 0.25 * main.size_m:
        return "what it follows stays where it is"
    if share < LEAST_SHARE:
        return "the picture hardly shifts"
    places = np.array(
        [project(view.camera, picture.size, main.middle(view.time_s)) for view in picture.views]
    )
    is_behind = any(one.direction == "behind" for one in description.shot.moves)
    if is_behind and places[:, 2].max() > MOST_GROWTH * max(places[:, 2].min(), 1e-9):
        return "it does not stay as far behind"
    drift = float(np.ptp(places[:, :2], axis=0).max()) / picture.size.width
    return "what it follows does not stay in the picture" if drift > MOST_DRIFT else None
