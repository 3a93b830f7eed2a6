"""Whether what crosses a road, goes above roofs or stands in rows is seen to do so."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

import numpy as np

from texvent.generate.landmarks import ROAD, is_marked
from texvent.generate.seen_words.picture import Picture, View
from texvent.scenes.description import Claim, SceneDescription
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.scene import Environment, Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.claims.bodies import part_boxes
from texvent.scenes.staging.surroundings.road import RoadLine

LEAST_ACROSS = 0.7
"""Sine of the angle between a road and the way of who crosses it, at least."""
LEAST_LINED = 3
"""Things that make a row along a road."""
LEAST_IN_LINE = 0.7
"""Share of the things of one side that stand in line."""
ROW_M = 1.5
"""How far the things of a row stand out of its line at most, m."""
STANDS_M = (3.0, 8.0)
"""Least height of a camera in the stands, and least distance of what it sees, m."""
TRAVEL_M = 1.0
"""Way of a camera from which on it travels, m."""
ALOFT_M = 0.3
"""Height above what carries it from which on a foot is in the air, m."""
LEAST_OVER_PICTURE = 0.25
"""Way in the picture of what crosses it, over its width."""
_BARE = ("sky", "space", "plain")
"""Places where nothing but the picture's edges tells that something goes across."""
_CROSSES = re.compile(r"cross(es|ed|ing)?")


def judge_courses(picture: Picture, description: SceneDescription) -> dict[str, str]:
    """Words of ways and places that the picture does not show, and why.

    Args:
        picture: of the staged scene.
        description: what it was staged from.
    """
    found: dict[str, str] = {}
    for claim in description.claims:
        if claim.aspect == "course":
            reason, is_shown = _COURSES[claim.value]
            if not is_shown(picture, claim):
                found.setdefault(claim.word, reason)
        elif _crosses(description, claim):
            fault = _judge_crossing(picture, description, claim)
            if fault is not None:
                found.setdefault(claim.word, fault)
        is_stripes = any(description.objects[one].noun == "crosswalk" for one in claim.things)
        if claim.aspect == "name" and is_stripes and not _lies_on_roads(picture, claim):
            found.setdefault(claim.word, "it does not lie across the road")
    return found


def judge_goals(description: SceneDescription, unseen: Mapping[str, str]) -> dict[str, str]:
    """Verbs that need a place which is not seen, as in "crosses a river" → why.

    Args:
        description: what the scene was staged from.
        unseen: words that are not seen → why.
    """
    place = description.surroundings.place
    own = [one.word for one in description.claims if one.aspect == "place" and one.value == place]
    lost = next((word for word in own if word in unseen), None)
    if lost is None:
        return {}
    return {one.word: f"{lost} {unseen[lost]}" for one in description.claims
            if _crosses(description, one)}  # fmt: skip


def _judge_crossing(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Over a road, or over the picture where no ground tells its way."""
    if description.surroundings.place in _BARE or _is_on_deck(description, claim):
        is_far = _goes_over_picture(picture, claim)
        return None if is_far else "it stays where it is in the picture"
    is_over = _goes_over_road(picture, claim)
    return None if is_over else "it does not go across the road"


def _is_on_deck(description: SceneDescription, claim: Claim) -> bool:
    """As in "a car crosses a bridge": over that, not over the road."""
    return any(
        one.kind == "on" and description.objects[one.targets[0]].noun in _DECKS
        for one in claim.relations
    )


_DECKS = frozenset({"bridge", "pier"})


def _goes_over_picture(picture: Picture, claim: Claim) -> bool:
    """Whether the middle of the things goes far in the picture itself, whatever the camera does."""
    own = [one for one, index in picture.scene.object_of.items() if index in claim.things]
    places = [
        float(picture.points[where, 0].mean())
        for where in (np.isin(view.instance, own) for view in picture.views)
        if where.any()
    ]
    return bool(places) and np.ptp(places) >= LEAST_OVER_PICTURE * picture.size.width


def _crosses(description: SceneDescription, claim: Claim) -> bool:
    """As in "a dog crosses": the road, where the scene has one."""
    return bool(
        claim.aspect == "motion" and claim.things and _CROSSES.fullmatch(claim.word)
    ) and any(
        motion is not None and motion.direction == "across"
        for one in claim.things
        for motion in (description.objects[one].motion, *description.objects[one].then)
    )


def _is_seen_from_stands(picture: Picture, claim: Claim) -> bool:
    """Whether the camera is up above the ground, and far from all that is looked at."""
    view = picture.views[0]
    place = view.camera.position
    ways = [one.middle(view.time_s) - place for one in picture.scene.actors]
    nearest = min((float(np.linalg.norm(way)) for way in ways), default=STANDS_M[1])
    return bool(place[2] >= STANDS_M[0] and nearest >= STANDS_M[1])


def _lies_on_roads(picture: Picture, claim: Claim) -> bool:
    """Whether the stripes of each crosswalk lie on a road."""
    actors = [one for one in picture.scene.actors if one.object_index in claim.things]
    return all(_lies_on_road(picture, one) for one in actors)


def list_walkers_in_air(picture: Picture) -> list[str]:
    """People who walk or stand with nothing below their feet, as sentences."""
    found = []
    for actor in picture.scene.actors:
        is_walker = actor.noun.name in PERSON_NOUNS and actor.noun.habitat == "ground"
        if is_walker and actor.tether is None and _is_in_air(picture, actor):
            found.append(f"the {actor.noun.name} is in the air")
    return list(dict.fromkeys(found))


def _road_line(environment: Environment) -> RoadLine:
    offset = (float(environment.road_offset[0]), float(environment.road_offset[1]))
    return RoadLine(environment.road_angle, offset, environment.road_curvature)


def _has_road(environment: Environment) -> bool:
    return is_marked(environment, np.zeros((1, 2)))[0] == ROAD


def _goes_over_road(picture: Picture, claim: Claim) -> bool:
    """Who crosses a road is on it at mid clip, and goes at a large angle to its line."""
    first, last = picture.views[0].time_s, picture.views[-1].time_s
    environment = picture.scene.environment(first)
    if not _has_road(environment):
        return True
    line = _road_line(environment)
    actors = [one for one in picture.scene.actors if one.object_index in claim.things]
    crossing = 0
    for actor in actors:
        begin, end = actor.middle(first)[:2], actor.middle(last)[:2]
        sides = line.across(begin), line.across(end)
        way = float(np.linalg.norm(end - begin))
        steep = abs(sides[1] - sides[0]) >= LEAST_ACROSS * way
        is_there = abs(line.across(actor.middle(0.5 * (first + last))[:2]))
        crossing += bool(steep and way > 0.0 and is_there < environment.road_half_width)
    return 2 * crossing >= len(actors)


def _is_beside_road(picture: Picture, claim: Claim) -> bool:
    """Whether the things are off the road in the beginning."""
    actors = [one for one in picture.scene.actors if one.object_index in claim.things]
    time_s = picture.views[0].time_s
    spots = np.array([one.middle(time_s)[:2] for one in actors]).reshape(-1, 2)
    kind, is_there = is_marked(picture.scene.environment(time_s), spots)
    return kind != ROAD or not is_there.any()


def _lies_on_road(picture: Picture, actor: Actor) -> bool:
    """Whether its stripes lie side by side across the road."""
    environment = picture.scene.environment(0.0)
    if not _has_road(environment):
        return False
    line = _road_line(environment)
    state = actor.trajectory.at(0.0)
    place = np.array(state.position[:2])
    turned = abs(np.sin(state.yaw - environment.road_angle))
    return bool(abs(line.across(place)) < 0.5 * environment.road_half_width and turned > 0.9)


def _is_over_roofs(picture: Picture, claim: Claim) -> bool:
    """Whether something in the air, or the camera, is above all that stands in view.

    A camera that flies over a city goes between its towers.
    """
    still = picture.scene.still.to_world
    if not len(still):
        return False
    tops = still[:, 2, 3] + np.linalg.norm(still[:, 2, :3], axis=1)
    seen = np.unique(np.concatenate([view.number for view in picture.views]))
    before = len(picture.scene.list_scenery()) - len(still)
    number = seen[(seen >= before) & (seen < before + len(still))] - before
    if not len(number):
        return False  # nothing stands below it
    roof = float(tops[number].max())
    half = picture.views[len(picture.views) // 2]
    if half.camera.position[2] > roof:
        return True
    flying = [one for one in picture.scene.actors if one.noun.habitat == "air"]
    first, last = picture.views[0].camera.position, picture.views[-1].camera.position
    if not flying and float(np.linalg.norm(last - first)) > TRAVEL_M:
        return True
    return any(float(part_boxes(one, half.time_s).hull[0][2]) > roof for one in flying)


def _stands_in_rows(picture: Picture, claim: Claim) -> bool:
    """Whether what lines a road stands in a line beside it, in view."""
    indices = set(claim.things)
    environment = picture.scene.environment(0.0)
    if not indices or not _has_road(environment):
        return False
    view = picture.views[len(picture.views) // 2]
    shown = set(np.unique(view.instance).tolist())
    own = [one for one, index in picture.scene.object_of.items() if index in indices]
    line = _road_line(environment)
    sides = np.array([line.across(_spot(view, one)) for one in own
                      if one in shown])  # fmt: skip
    for row in (sides[sides > 0.0], sides[sides < 0.0]):
        in_line = np.abs(row - np.median(row)) < ROW_M if len(row) else row
        if len(row) >= LEAST_LINED and float(np.mean(in_line)) >= LEAST_IN_LINE:
            return True
    return False


def _spot(view: View, instance: int) -> Float64Array:
    return np.asarray(view.shapes.to_world[view.owner == instance, :2, 3].mean(axis=0))


def _is_in_air(picture: Picture, actor: Actor) -> bool:
    """Whether at some instant there is nothing right below it, and it neither jumps nor falls."""
    others = [one for one in picture.scene.actors if one is not actor]
    lows = []
    for view in picture.views:
        low, high = part_boxes(actor, view.time_s).hull
        if actor.trajectory.at(view.time_s).activity not in ("move", "walk", "stand", "run"):
            continue
        lows.append(float(low[2]))
        carried = any(_carries(one, low, high, view.time_s) for one in others)
        if low[2] > ALOFT_M and not carried:
            return float(np.ptp(lows)) < ALOFT_M
    return False


def _carries(other: Actor, low: Float64Array, high: Float64Array, time_s: float) -> bool:
    base, top = part_boxes(other, time_s).hull
    return bool(np.all(base[:2] <= high[:2]) and np.all(top[:2] >= low[:2])
                and top[2] > low[2] - ALOFT_M)  # fmt: skip


_COURSES: Mapping[str, tuple[str, Callable[[Picture, Claim], bool]]] = {
    "over roofs": ("not above what stands there", _is_over_roofs),
    "across road": ("it does not go across the road", _goes_over_road),
    "beside road": ("it is on the road", _is_beside_road),
    "in rows": ("they stand in no row", _stands_in_rows),
    "in stands": ("the camera is not up there", _is_seen_from_stands),
}
"""Value of a claim of a course → what is said where it is not seen, and whether it is."""
