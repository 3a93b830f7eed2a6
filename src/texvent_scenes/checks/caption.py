"""Caption of a staged clip: its place, bodies and camera in words, as they are drawn.

Each line is measured on the scene, not read from the prompt, so that both can be compared.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

import numpy as np

from texvent.camera import PosedCamera
from texvent_scenes.checks.bodies.looks import is_ball
from texvent_scenes.checks.clip.body_boxes import BodyBoxes
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.checks.in_view import View
from texvent_scenes.checks.surroundings.places import share_of_sky
from texvent_scenes.checks.surroundings.water import wet_share
from texvent_scenes.checks.views.surfaces import join_words, list_surfaces, tell_look
from texvent_scenes.models.activities import (
    ACTIVITIES,
    ANIMAL_ACTIVITIES,
    HAND_GESTURES,
    HAND_NOUNS,
    PERSON_NOUNS,
    TRAVELLING,
)
from texvent_scenes.models.nouns import AFLOAT, VARIANTS
from texvent_scenes.models.shapes import bounds, moved
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Ground, Texture
from texvent_scenes.spec.data import HANDLED
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.surroundings.lighting import DARK
from texvent_scenes.staging.surroundings.threads import let_go_s
from texvent_scenes.words import list_plurals

_LEAST_SHARE, _MOST_SCENERY = 0.004, 4
"""Share of the image of a piece of scenery that is named; most nouns that are."""
_STAYS, _STIRS, _TURNS, _HALF = 0.05, 0.01, math.radians(4.0), 0.6
"""Way of a body that stays, in its sizes and m; way of a part that moves, in those; turn that is
told; share of a body, of which less is seen than of one that is hidden by half."""
_SWUNG = 0.8
"""Way of the middle of what leans, in its sizes, per rad."""
_OVER = math.radians(120.0)
"""Angle from which on a thing that leans turns round."""
_SUPPORTED_M, _GROUND_M, _APART = 0.06, 0.12, 0.15
"""Gap to the support of a body, and height up to which it is on the ground, m; gap to what has let
it go from which on it is in the air, in its heights."""
_HAD = {"wear": "worn", "hold": "held", **dict.fromkeys(HANDLED, "held")}
"""Relation to a thing → the word for having it; of others, it is carried."""
_BESIDE_M = 0.08
"""Gap between a thing and what has it from which on it is told, m."""
_AFLOAT = 0.15
"""Height of its lowest point, in its heights, up to which what waves lift is on the water."""
_CAMERA_M, _ZOOM, _STEEP = 0.03, 1.04, 0.85
"""Way and ratio of focal lengths of a camera that are told; upward part of the sight of one that
looks straight down or up."""
_BENT, _BENT_SHARE = 1.1, 0.1
"""Path over way from which on a way has legs; share of its longest side that a leg has at least."""
_ROLLED_DEG = 3.0
"""Least roll of a camera that is told."""
_IDLE = ("move", "stand")
"""Activities without a word of their own: the way tells them."""
_ACTS = ACTIVITIES.keys() | ANIMAL_ACTIVITIES.keys() | HAND_GESTURES.keys() | TRAVELLING
"""Activities that parts of a body show; of others, as "orbit", the way tells."""
_PARTS, _THIRD, _WIDE = ("at its left", "in its middle", "at its right"), 1.0 / 6.0, 0.25
"""Parts of the picture; half the width of its middle one, in widths of the picture; share of the
picture from which on a body is in no part alone."""
_SIDES = ("from behind", "from the side", "from the front")


def caption(
    staged: StagedClip, views: Mapping[int, View], *, shows_light: bool = True
) -> tuple[str, ...]:
    """Lines on the place, on each object and on the camera.

    Args:
        staged: the clip.
        views: instance id → the most that is seen of it.
        shows_light: whether the picture tells the light that is said.
    """
    surfaces = list_surfaces(staged)
    bodies = [line for index in range(len(staged.description.objects))
              if (line := _tell_object(staged, index, views, surfaces))]  # fmt: skip
    return (_tell_place(staged, shows_light=shows_light), *bodies, _tell_camera(staged))


def _tell_place(staged: StagedClip, *, shows_light: bool) -> str:
    """Place, light, weather, effects, scenery in view and share of the sky."""
    scene, said = staged.scene, staged.description
    name = said.place.name if said.place.name in scene.place.names else scene.place.names[0]
    kind = said.light.kind if shows_light else None
    usual = "indoors" if scene.place.is_room else "by day"
    facts = [f"{name} {_LIGHTS.get(kind, f'by {kind}') if kind else usual}"]
    weather, amount = said.place.weather, said.place.weather_amount
    strength = "heavy " if amount > 1.0 else "light " if amount < 1.0 else ""
    facts += sorted(f"{strength * (one == weather)}{one}"
                    for one in {weather, *scene.particles.kinds} - {None, "clear"})  # fmt: skip
    facts += ["clouds"] if said.place.clouds and kind not in DARK else []
    facts += ["wet ground"] if scene.environment(0.0).wetness else []
    if seen := _list_scenery(staged):
        facts.append(f"with {join_words(seen)}")
    if not scene.place.is_room and scene.place.ground is not Ground.UNDERWATER:
        times = staged.times[:: len(staged.times) // 2]
        share = max(share_of_sky(scene, one, scene.camera(one)) for one in times)
        facts.append(f"sky in {share:.0%} of the picture" if share >= 0.01 else "no sky in view")
    if (rate_hz := scene.animated_environment.flicker_hz) is not None:
        facts.append(f"light that changes at {rate_hz:.3g} Hz")
    return ", ".join(facts)


_LIGHTS = {"night": "at night", "dusk": "at dusk", "dawn": "at dawn", "sunny": "in the sun",
           "overcast": "under an overcast sky", "stormy": "under dark clouds",
           "morning": "in the morning", "afternoon": "in the afternoon",
           "lamp": "by the light of a lamp"}  # fmt: skip
"""Light → its words, if they are not "by" and its name."""


def _list_scenery(staged: StagedClip) -> list[str]:
    """Nouns of scenery in view, those that take most of the picture."""
    shares = dict[str, float]()
    for one in staged.scene.scenery:
        seen = max(one.share_of(staged.scene.camera(time_s)) for time_s in staged.times[::4])
        noun = _plain(one.rule.noun)
        shares[noun] = shares.get(noun, 0.0) + seen * (seen >= _LEAST_SHARE)
    most = sorted((one for one in shares if shares[one]), key=lambda one: -shares[one])
    return [list_plurals(one)[0] for one in most[:_MOST_SCENERY]]


def _plain(noun: str) -> str:
    """Noun of a variant: "goose" of "flying goose"."""
    return VARIANTS.get(noun, noun)


def _tell_object(
    staged: StagedClip, index: int, views: Mapping[int, View],
    surfaces: Mapping[int, Counter[tuple[str, Texture]]],
) -> str:  # fmt: skip
    """An object: number, colours, acts, way, place and visibility of its copies in view."""
    own = [one for one in staged.scene.actors if one.object_index == index]
    seen = [one for one in own if views[one.instance].pixels]
    noun = _plain(staged.description.objects[index].noun)
    if not own:
        held = {name for one in staged.scene.actors for prop in one.props for name in prop.nouns}
        return "" if noun in held else f"{noun}: no body of its own"
    if not seen:
        return f"{noun}: never in view"
    first = max(seen, key=lambda one: views[one.instance].pixels)
    body = staged.boxes[index][own.index(first)]
    count = f"{len(seen)} {list_plurals(noun)[0]}" if len(seen) > 1 else noun
    surface = sum((surfaces[one.instance] for one in seen if one.instance in surfaces), Counter())
    who = ", ".join(filter(None, [tell_look(surface), _tell_size(first)]))
    facts = [_tell_acts(staged, first, body), _tell_place_of(staged, first, body)]
    facts += [_tell_side(staged, first, body, views[first.instance]), _tell_props(first)]
    facts += [_tell_visibility(staged, body, views[first.instance])]
    which = ", the largest" if len(seen) > 1 else ""
    return f"{count} ({who}){which}: {'; '.join(filter(None, facts))}"


def _tell_size(one: Actor) -> str:
    """Its greatest extent, upwards or along the ground."""
    along, height = max(one.model.length, one.model.width), one.model.height
    return f"{_round(height)} m high" if height >= along else f"{_round(along)} m long"


def _tell_acts(staged: StagedClip, one: Actor, body: BodyBoxes) -> str:
    """Its activities in their order, and the way that it goes."""
    states = [one.track.at(time_s).activity for time_s in staged.fine_times]
    has_acts = one.noun.name in PERSON_NOUNS | HAND_NOUNS or one.noun.acts
    shown = _ACTS | one.noun.acts
    acts = [act for act, _ in groupby(states) if has_acts and act in shown and act not in _IDLE]
    facts = [f"acts: {', then '.join(dict.fromkeys(acts))}"] if acts else []
    way = _tell_way(staged, one)
    if way == "stays" and not acts and staged.departure(one).max() > _STIRS * one.size_m:
        way = "stays, parts of it move"
    rates = [each.fastest_hz for each in staged.scene.lamps.lit
             if each.actor.instance == one.instance and not _SWITCHING & {*acts}]  # fmt: skip
    facts += [f"its light changes at {max(rates):.3g} Hz"] if any(rates) else []
    return ", ".join((*facts, way))


_SWITCHING = frozenset(
    one for name, act in ANIMAL_ACTIVITIES.items() if act.to_state for one in (name, act.to_state)
)
"""Acts that say themselves when a light changes."""


def _tell_way(staged: StagedClip, one: Actor) -> str:
    """Ways to a side, to the camera and up; turns of who stays."""
    places = np.asarray([one.middle(time_s) for time_s in staged.fine_times])
    path = float(np.linalg.norm(np.diff(places, axis=0), axis=1).sum())
    least_m = max(_STAYS * one.size_m, 0.5 * _STAYS)
    leans = _tell_lean(staged, one, float(np.ptp(places, axis=0).max()))
    if leans or path <= least_m:
        turned = np.unwrap([one.track.at(time_s).yaw for time_s in staged.fine_times])
        angle = float(np.ptp(turned))
        return leans or (f"turns by {math.degrees(angle):.0f}°" if angle >= _TURNS else "stays")
    net = places[-1] - places[0]
    speed = _round(path / max(staged.duration_s, 1e-9))
    if float(np.linalg.norm(net)) < 0.3 * path:
        return f"goes along a way of {_round(path)} m that turns back at {speed} m/s"
    camera = staged.scene.camera(staged.duration_s / 2.0)
    is_steep = abs(float(camera.rotation[2][2])) > _STEEP
    ahead = (-camera.rotation[1] if is_steep else camera.rotation[2]) * [1.0, 1.0, 0.0]
    ahead /= max(float(np.linalg.norm(ahead)), 1e-9)
    ends = ("towards the lower edge", "towards the upper edge")
    depth = ends if is_steep else ("towards the camera", "away from the camera")
    names = (("to the left", "to the right"), depth, ("down", "up"))
    axes = np.array([[ahead[1], -ahead[0], 0.0], ahead, [0.0, 0.0, 1.0]])
    ways = [(abs(way), f"{_round(abs(way))} m {name[int(way > 0)]}")
            for way, name in zip(axes @ net, names, strict=True)]  # fmt: skip
    is_bent = path > _BENT * float(np.linalg.norm(net))
    least = (_BENT_SHARE if is_bent else 0.3) * max(length for length, _ in ways)
    return f"goes {join_words([words for length, words in ways if length >= least])} at {speed} m/s"


def _tell_lean(staged: StagedClip, one: Actor, way_m: float) -> str:
    """Angle by which the upright axis of a thing leans on the spot, and how often; "" = none."""
    states = [one.track.at(time_s) for time_s in staged.fine_times]
    rolls = is_ball(one) or any(each.activity == "roll" for each in states)
    lives = one.noun.name in PERSON_NOUNS or (one.noun.acts and one.noun.speed_m_s)
    if lives or rolls:
        return ""
    axes = np.asarray([each.to_world()[:, 2] for each in states])
    off = axes - axes.mean(axis=0)
    along = off @ np.linalg.svd(off, full_matrices=False)[2][0]
    ends = axes[int(along.argmin())], axes[int(along.argmax())]
    angle = math.acos(min(max(float(ends[0] @ ends[1]), -1.0), 1.0))
    if angle < _TURNS or way_m > _SWUNG * angle * one.size_m:
        return ""
    side = np.sign(along - 0.5 * (along.max() + along.min()))
    crossed = np.asarray(staged.fine_times)[1:][np.diff(side) != 0]
    is_told = len(crossed) > 1
    rate_hz = 0.5 * (len(crossed) - 1) / np.ptp(crossed) if is_told else 0.0
    rate = f" at {_round(rate_hz)} Hz" * is_told
    if angle > _OVER:
        return f"turns round{rate}"
    return f"tilts {'to and fro ' * is_told}by {math.degrees(angle):.0f}°{rate}"


def _tell_place_of(staged: StagedClip, one: Actor, body: BodyBoxes) -> str:
    """Support of it at the middle of the clip, or its height above the ground."""
    at = len(staged.times) // 2
    carried = _tell_carrier(staged, one, staged.times[at])
    if carried and not carried.startswith("in the air"):
        return carried
    low = body.middle[at] - 0.5 * body.size[at]
    tied = ((each.object_index, each.track.anchor) for each in staged.scene.actors)
    carries = {n for n, anchor in tied if anchor is not None and anchor.carrier is one.track}
    held_in = {(each.subject, n) for each in staged.description.relations
               for n in each.targets if each.kind == "in"}  # fmt: skip
    for index, copies in enumerate(staged.boxes):
        for other in copies:
            if index not in carries and index != one.object_index and _bears(other, body, at):
                is_low = body.middle[at, 2] < other.middle[at, 2] + 0.5 * other.size[at, 2]
                way = "in" if is_low and (one.object_index, index) in held_in else "on"
                return f"{way} the {_plain(staged.description.objects[index].noun)}"
    loose = carried * bool(low[2] > _GROUND_M)
    if inside := loose or _find_holder(staged, one, body, at):
        return inside
    place = staged.scene.place
    if place.ground in (Ground.NONE, Ground.UNDERWATER):
        return ""
    if place.is_room and one.noun.name in nouns_with("hangs from a ceiling"):
        return "under the ceiling"
    is_wet = place.has_surface and wet_share(staged.scene, body.middle[at][None, :2]) > 0.0
    ground = "water" if is_wet else "floor" if place.is_room else "ground"
    is_afloat = one.noun.habitat == "water" or one.noun.name in AFLOAT
    if low[2] > (_AFLOAT * one.model.height if is_wet and is_afloat else _GROUND_M):
        until_s = let_go_s(staged.description.objects[one.object_index], staged.duration_s)
        is_hung = until_s is not None and staged.times[at] < until_s
        return f"{'hangs on a thread ' * is_hung}{_round(low[2])} m above the {ground}"
    return f"{'in' if is_wet and low[2] < -_GROUND_M else 'on'} the {ground}"


def _tell_carrier(staged: StagedClip, one: Actor, time_s: float) -> str:
    """Carrier at an instant, by its relation: in a hand, on a body; "" = there is none."""
    anchor = one.track.anchor
    carriers = [] if anchor is None else [
        other for other in staged.scene.actors if other.track is anchor.carrier
    ]  # fmt: skip
    if not carriers or _is_pushed(one, carriers[0], time_s):
        return ""
    noun, gap_m = _plain(carriers[0].noun.name), _gap_between(one, carriers[0], time_s)
    is_apart = gap_m > _APART * one.model.height
    if not one.track.grab_s <= time_s < one.track.release_s:
        return f"in the air, {_round(gap_m)} m from the {noun}" if is_apart else f"at the {noun}"
    kinds = (
        each.kind
        for each in staged.description.relations
        if each.subject == carriers[0].object_index and one.object_index in each.targets
    )
    way = next((_HAD[kind] for kind in kinds if kind in _HAD), "carried")
    return f"{way} by the {noun}" + f", {_round(gap_m)} m from it" * (gap_m > _BESIDE_M)


def _is_pushed(one: Actor, carrier: Actor, time_s: float) -> bool:
    """Whether it goes along the ground beside what takes it along, or at a person's feet."""
    own, other = one.corners(time_s), carrier.corners(time_s)
    middle = 0.5 * (own.min(axis=0) + own.max(axis=0))[:2]
    is_over = (other.min(axis=0)[:2] <= middle).all() and (middle <= other.max(axis=0)[:2]).all()
    is_beside = carrier.noun.name in PERSON_NOUNS or not is_over
    return bool(own[:, 2].min() <= _GROUND_M and is_beside)


def _find_holder(staged: StagedClip, one: Actor, body: BodyBoxes, at: int) -> str:
    """Bearer that it is said to be in or on, if its middle is over or in that: an armchair."""
    for each in staged.description.relations:
        if each.subject == one.object_index and each.kind in ("in", "on"):
            for other in (other for n in each.targets for other in staged.boxes[n]):
                off = np.abs(body.middle[at] - other.middle[at])[:2] <= 0.5 * other.size[at, :2]
                low = body.middle[at, 2] - 0.5 * body.size[at, 2]
                if off.all() and low < other.middle[at, 2] + 0.5 * other.size[at, 2]:
                    noun = _plain(staged.description.objects[each.targets[0]].noun)
                    return f"{each.kind} the {noun}"
    return ""


def _gap_between(one: Actor, other: Actor, time_s: float) -> float:
    """Least gap between the boxes around the shapes of two bodies, m."""
    placed = [each.place(time_s) for each in (one, other)]
    boxes = [np.array([bounds([part]) for part in moved(each.parts, each.to_world)])
             for each in placed]  # fmt: skip
    first, second = boxes[0][:, None], boxes[1][None]
    off = np.maximum(np.maximum(first[..., 0, :] - second[..., 1, :],
                                second[..., 0, :] - first[..., 1, :]), 0.0)  # fmt: skip
    return float(np.linalg.norm(off, axis=-1).min())


def _bears(other: BodyBoxes, body: BodyBoxes, at: int) -> bool:
    """Whether a shape of one body is right under another."""
    low = body.middle[at] - 0.5 * body.size[at]
    parts = other.parts + (other.middle[at] - other.middle[0])
    tops, middle = parts[:, 1, 2], body.middle[at][:2]
    is_under = ((parts[:, 0, :2] <= middle) & (middle <= parts[:, 1, :2])).all(axis=1)
    return bool((is_under & (np.abs(tops - low[2]) <= _SUPPORTED_M)).any()) and low[2] > _GROUND_M


def _tell_side(staged: StagedClip, one: Actor, body: BodyBoxes, view: View) -> str:
    """Side of a body with a heading that the camera sees first of it."""
    if not one.noun.speed_m_s or is_ball(one):
        return ""
    shown = next((n for n, count in enumerate(view.at) if count), 0)
    at = round(shown * (len(staged.times) - 1) / max(len(view.at) - 1, 1))
    camera = staged.scene.camera(staged.times[at])
    if abs(float(camera.rotation[2][2])) > _STEEP:
        return "seen from above or below"
    sight = (body.middle[at] - camera.position)[:2]
    cosine = float(-sight @ body.ahead[at]) / max(float(np.linalg.norm(sight)), 1e-9)
    return f"seen {_SIDES[int(np.digitize(cosine, (-0.7, 0.7)))]}"


def _tell_props(one: Actor) -> str:
    """Things in its hands."""
    props = [*dict.fromkeys(prop.nouns[0] for prop in one.props if prop.nouns)]
    return f"with a {join_words(props)}" if props else ""


def _tell_visibility(staged: StagedClip, body: BodyBoxes, view: View) -> str:
    """Share of the picture, and how long and how much of it is seen."""
    share = view.pixels / (staged.size.width * staged.size.height)
    right = float(body.seen[len(body.seen) // 2, 0]) * staged.scene.camera(staged.times[0]).focal
    part = _PARTS[int(np.digitize(right, (-_THIRD, _THIRD)))]
    facts = [
        f"{share:.1%} of the picture, {part}" if share < 0.1 else f"{share:.0%} of the picture"
    ]
    if view.share < _HALF:
        facts.append(f"{1.0 - view.share:.0%} of it hidden")
    seen = np.mean(np.array(view.at) > 0)
    if seen < 0.9:
        facts.append(f"in view for {seen:.0%} of the clip")
    return ", ".join(facts)


def _tell_camera(staged: StagedClip) -> str:
    """Height, direction of sight, ways and turns of the camera."""
    cameras = [staged.scene.camera(time_s) for time_s in staged.times]
    first, last = cameras[0], cameras[-1]
    pitch = math.degrees(math.asin(float(np.clip(first.rotation[2][2], -1.0, 1.0))))
    has_ground = staged.scene.place.ground not in (Ground.NONE, Ground.UNDERWATER)
    is_driven = any(one.means == "drive" for one in staged.description.camera.moves)
    facts = ["in a vehicle of which nothing is drawn"] if is_driven else []
    facts += [f"{_round(first.position[2])} m above the ground"] if has_ground else []
    level = "level" if abs(pitch) < 3.0 else f"{abs(pitch):.0f}° {'up' if pitch > 0 else 'down'}"
    facts += [f"looks {level}"]
    roll = math.degrees(_roll_of(first))
    facts += [f"rolled by {abs(roll):.0f}°"] if abs(roll) >= _ROLLED_DEG else []
    moves = [*_list_camera_moves(cameras), *_list_zooms(first, last)]
    return f"camera: {', '.join(facts)}, {join_words(moves) if moves else 'stays'}"


def _roll_of(camera: PosedCamera) -> float:
    """Angle of its right axis above the horizon, rad; that of a camera on its head is over 90°."""
    right, down, _ = camera.rotation
    return math.atan2(float(right[2]), -float(down[2]))


def _list_camera_moves(cameras: Sequence[PosedCamera]) -> Iterator[str]:
    """Ways along the axes of its first pose, and turns about them."""
    first, last = cameras[0], cameras[-1]
    way = first.rotation @ (last.position - first.position)
    names = (("left", "right"), ("up", "down"), ("backward", "forward"))
    for length, (less, more) in zip(way, names, strict=True):
        if abs(length) >= max(_CAMERA_M, 0.2 * float(np.abs(way).max())):
            yield f"goes {_round(abs(length))} m {more if length > 0 else less}"
    ahead = np.array([one.rotation[2] for one in cameras])
    yaw = np.unwrap(np.arctan2(ahead[:, 1], ahead[:, 0]))
    pitch = np.arcsin(np.clip(ahead[:, 2], -1.0, 1.0))
    roll = np.unwrap([_roll_of(one) for one in cameras])
    if float(np.ptp(roll)) >= _TURNS:
        yield f"rolls by {math.degrees(float(np.ptp(roll))):.0f}°"
    for angles, (less, more) in ((yaw, ("right", "left")), (pitch, ("down", "up"))):
        turn, range_rad = float(angles[-1] - angles[0]), float(np.ptp(angles))
        if abs(turn) >= _TURNS:
            yield f"turns {abs(math.degrees(turn)):.0f}° {more if turn > 0 else less}"
        elif range_rad >= 0.25 * _TURNS:
            yield f"sways by {math.degrees(range_rad):.1f}°"


def _list_zooms(first: PosedCamera, last: PosedCamera) -> Iterator[str]:
    ratio = last.focal / first.focal
    if max(ratio, 1.0 / ratio) >= _ZOOM:
        yield f"zooms {'in' if ratio > 1.0 else 'out'} {_round(max(ratio, 1.0 / ratio))} times"


def _round(value: float) -> str:
    """Two digits, or all before the point."""
    return f"{value:.2g}" if abs(value) < 99.5 else f"{value:.0f}"
