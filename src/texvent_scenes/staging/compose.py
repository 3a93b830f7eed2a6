"""Scene description to animated 3-D scene: actors, scenery, camera and light."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from texvent.camera import PosedCamera
from texvent.sensor import SensorSize
from texvent_scenes.description import SceneDescription, label_of
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.nouns import AFLOAT, NOUNS
from texvent_scenes.models.places import PLACES, SEEN_FROM_AFAR, PlaceModel, list_telling
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import MEDIUM_RECORD, Environment, Ground, Primitives
from texvent_scenes.spec.scene import CameraMove, Motion, object_ids
from texvent_scenes.staging.actors import Actor, PlacedModel, assemble, join_primitives, seeded
from texvent_scenes.staging.camera.angles import is_said_room
from texvent_scenes.staging.camera.camera_placement import place_camera
from texvent_scenes.staging.camera.camera_track import CameraTrack
from texvent_scenes.staging.camera.journey import plan_travel
from texvent_scenes.staging.interactions.breaking import break_up
from texvent_scenes.staging.interactions.following import follow_ways
from texvent_scenes.staging.particles.choose import (
    Staged,
    stage_effects,
)
from texvent_scenes.staging.particles.effect import Setting
from texvent_scenes.staging.placement.crossing_turns import part_turns
from texvent_scenes.staging.placement.object_placement import ObjectPlacer
from texvent_scenes.staging.placement.zones import keep_to_zones, zone_of
from texvent_scenes.staging.surroundings.environment import (
    AnimatedEnvironment,
    build_environment,
    contrasting,
    water_line,
)
from texvent_scenes.staging.surroundings.lamps import LampPlan, plan_lamps
from texvent_scenes.staging.surroundings.lighting import DARK, choose_lighting, is_unlit_room
from texvent_scenes.staging.surroundings.markings import list_astride
from texvent_scenes.staging.surroundings.pieces import SceneryItem, ViewClearance
from texvent_scenes.staging.surroundings.road_line import (
    RoadLine,
    find_road,
    lay_across,
    list_flyers_above,
    show_crossing,
)
from texvent_scenes.staging.surroundings.scenery import scatter
from texvent_scenes.staging.surroundings.threads import list_strings, thread_at

VIEW_INSTANTS = 7
"""Instants of the clip at which scenery must not hide anything."""


_NO_MEDIA = np.zeros(0, MEDIUM_RECORD)
_OFF_THE_BED = 0.5
"""Height of swimmers above the bed of the sea, as a multiple of their own."""
_SUNK, _WADING, _AWASH, _DRAUGHT = -0.18, -0.55, -0.4, -0.3
"""Height of the origin of swimmers at the surface, in their sizes; of those with legs; of rocks;
of the foot of things afloat."""


@dataclass(frozen=True)
class ComposedScene:
    """A scene as a continuous function of time; implements `rendered_scene.RenderedScene`."""

    actors: tuple[Actor, ...]
    still: Primitives
    """Scenery: the same at every instant."""
    particles: Staged
    """Weather, smoke, sparks, pieces ..."""
    camera_path: CameraTrack
    place: PlaceModel
    animated_environment: AnimatedEnvironment
    lamps: LampPlan
    class_names: dict[int, str]
    """Instance id → noun: of the actors first, then of traffic and people of the scenery."""
    not_shown: tuple[str, ...] = ()
    """Parts that cannot be shown, such as "the man's jump after 5 s (the clip ends at 2 s)"."""
    notes: tuple[str, ...] = ()
    """Decisions that the scene leaves open, as sentences, such as where the roads cross."""
    missing: frozenset[int] = frozenset()
    """Objects that are not held and have no place."""
    scenery: tuple[SceneryItem, ...] = ()
    """The pieces of which `still` is made."""
    threads: tuple[tuple[PlacedModel, float], ...] = ()
    """Those on which bodies hang, each until an instant, s."""
    has_highlights: bool = False
    """Whether light above white is kept; see `rendered_scene.Environment`."""
    object_ids: Mapping[int, str] = field(default_factory=dict)
    """Instance id → id of the object in the scene; copies of one object share it."""

    def primitives(self, time_s: float) -> Primitives:
        """All shapes at that instant: actors, then scenery, then weather."""
        acting = assemble([self.lamps.place(actor, time_s) for actor in self.actors])
        small = [effect.at(time_s) for effect in self.particles.effects]
        hanging = assemble([thread_at(*one, time_s) for one in self.threads])
        shapes = join_primitives([acting, self.still, hanging, *small])
        factor = np.float32(self.animated_environment.flicker(time_s))
        return replace(shapes, emission=shapes.emission * factor)

    def camera(self, time_s: float) -> PosedCamera:
        """The camera at that instant."""
        return self.camera_path.at(time_s)

    def environment(self, time_s: float) -> Environment:
        """Surroundings and light at that instant."""
        effects = self.particles.effects
        lamps = np.concatenate([self.lamps.at(time_s), *(one.lamps(time_s) for one in effects)])
        lamps["light"] *= self.animated_environment.flicker(time_s)
        media = np.concatenate([_NO_MEDIA, *(one.media(time_s) for one in effects)])
        surroundings = self.animated_environment.at(time_s)
        return replace(surroundings, lamps=lamps, media=media, has_highlights=self.has_highlights)

    @property
    def flicker_hz(self) -> float | None:
        """Highest frequency at which any light goes up and down, Hz; None = all is steady."""
        rates = (self.animated_environment.flicker_hz, self.lamps.blink_hz)
        return max((rate for rate in rates if rate is not None), default=None)


def compose_scene(
    description: SceneDescription,
    *,
    seed: int,
    size: SensorSize,
    duration_s: float,
    nouns: Mapping[str, Noun] = NOUNS,
) -> ComposedScene:
    """An animated scene from a description; the same arguments give the same scene.

    Args:
        description: the scene, with what it leaves open decided.
        seed: decides the layout; another seed gives another one of the same scene.
        size: image size, pixels, for the framing.
        duration_s: length of the clip, s; moves are spread over it.
        nouns: table of models.
    """
    place = description.place.name or "grass"
    levels = _choose_levels(PLACES[place], description, nouns)
    travel = plan_travel(description, place, duration_s)
    placer = ObjectPlacer(
        description, nouns, seed=seed, duration_s=duration_s, level_m=levels, travel=travel
    )
    actors = _lead(description, place, placer.place_all(), duration_s, has_route=travel is not None)
    ground = contrasting(PLACES[place], description, actors)
    camera_path = place_camera(
        description, actors, place, seed=seed, aspect=size.height / size.width,
        duration_s=duration_s, travel=travel,
    )  # fmt: skip
    view = _describe_view(description, ground, camera_path, actors, duration_s, size)
    if ground.has_road:
        actors = lay_across(actors, view.road)
    view = view if travel is None else replace(view, road=travel.road, travel=travel)
    items = _label(_scatter_all(description, view, actors, nouns, seed), len(actors), nouns)
    names = {one.instance: one.noun.name for one in actors}
    names |= {one.instance: one.rule.noun for one in items if one.instance}
    ids = object_ids(description)
    animated_environment = build_environment(
        description, place=ground, road=view.road, distance_m=camera_path.framing.distance_m,
        room_m=camera_path.room_m, corridor_m=camera_path.corridor_m,
    )  # fmt: skip
    lamps = plan_lamps(
        description, actors, place=ground,
        strength=choose_lighting(ground, description.light).lamps,
        instant_s=0.5 * duration_s, framing=camera_path.framing, items=items,
    )  # fmt: skip
    setting = Setting(
        actors, camera_path, place, duration_s, seed, is_dark=description.light.kind in DARK
    )  # fmt: skip
    particles = stage_effects(description, setting)
    still = assemble([item.place() for item in items])
    if is_unlit_room(ground, description):  # lamps and screens of the room are off
        still = replace(still, emission=np.zeros_like(still.emission))
    return ComposedScene(
        tuple(actors), still, particles, camera_path, ground, animated_environment, lamps, names,
        tuple(dict.fromkeys([*placer.not_shown, *_list_late(description, duration_s)])),
        (*dict.fromkeys(placer.notes), *_tell_roads(description, ground, view.road),
         *_tell_dark(description, ground), *_tell_bays(items, actors, duration_s)),
        placer.orphans, tuple(items),
        list_strings(description, actors, animated_environment.base.ceiling_m, duration_s),
        object_ids={one.instance: ids[one.object_index] for one in actors},
    )  # fmt: skip


def _lead(
    description: SceneDescription, place: str, actors: list[Actor], duration_s: float, *,
    has_route: bool,
) -> list[Actor]:  # fmt: skip
    """Actors in lanes and on pavements, followers behind leaders, and broken bodies in pieces."""
    if not has_route:
        actors = part_turns(description, PLACES[place], actors)
        actors = keep_to_zones(description, PLACES[place], actors, duration_s)
    return break_up(description, follow_ways(description, actors, duration_s), duration_s)


def _tell_dark(description: SceneDescription, place: PlaceModel) -> Iterator[str]:
    """That the lamps of a room are off."""
    if is_unlit_room(place, description):
        yield (
            f"the {description.place.name} is dark at {description.light.kind}: the lamps and "
            'screens of its own are off (is_lit of the place, or the light "lamp", has them on)'
        )


def _tell_bays(
    items: Sequence[SceneryItem], actors: Sequence[Actor], duration_s: float
) -> Iterator[str]:
    """Vehicles that rest across the lines of bays, since no row fits all of them."""
    for name in list_astride(items, actors, duration_s):
        yield f"the {name} stands across the lines of the bays: no row of bays fits all vehicles"


def _tell_roads(
    description: SceneDescription, place: PlaceModel, road: RoadLine
) -> Iterator[str]:  # fmt: skip
    """Places of the roads, for positions in metres."""
    camera, said = description.camera, description.place
    places = [one.position_m for one in description.objects]
    is_metric = any(one is not None for one in (*places, camera.position_m, said.road_m))
    if not place.has_road:
        return
    if is_metric:
        x, y = (round(value, 6) + 0.0 for value in road.offset)
        yield (
            f"the middle of the road goes through ({x:.3g}, {y:.3g}) m at "
            f"{math.degrees(road.angle) % 360.0:.3g} degrees; it has two lanes of "
            f"{place.road_m:.3g} m, and traffic keeps to the right"
        )
    for x, y, _ in road.crossings:
        yield f"the roads cross at ({round(x, 6) + 0.0:.3g}, {round(y, 6) + 0.0:.3g}) m"


def _list_late(description: SceneDescription, duration_s: float) -> Iterator[str]:
    """Motions and camera moves that would begin when the clip is over."""
    end = f"(the clip ends at {duration_s:g} s)"
    movers: list[tuple[str, Sequence[Motion | CameraMove]]] = [
        (f"the {label_of(description, n)}", one.motions)
        for n, one in enumerate(description.objects)
    ]
    for who, moves in [*movers, ("the camera", description.camera.moves)]:
        for one in moves:
            if one.start_s is not None and one.start_s >= duration_s:
                yield f"{who}'s {one.kind} after {one.start_s:g} s {end}"


def _describe_view(
    description: SceneDescription,
    place: PlaceModel,
    path: CameraTrack,
    actors: Sequence[Actor],
    duration_s: float,
    size: SensorSize,
) -> ViewClearance:
    times = [duration_s * step / (VIEW_INSTANTS - 1) for step in range(VIEW_INSTANTS)]
    if place.has_shore:
        road = water_line(place, actors, path, list_flyers_above(description, actors))
    else:
        road = find_road(description, place, actors, float(path.framing.target[1]))
        standing = [one for one in actors if not one.is_mover]
        spots = np.array([one.middle(0.0)[:2] for one in standing]).reshape(-1, 2)
        cameras = [path.at(t) for t in times]
        road = show_crossing(road, description.place, cameras, size, spots, place.road_m)
    has_strip = place.has_road or place.ground is Ground.RIVER
    points = [
        np.vstack([actor.corners(t)[::2] for actor in actors]) if actors else np.zeros((0, 3))
        for t in times
    ]
    return ViewClearance(
        [path.at(t) for t in times], points, path.framing.distance_m,
        place.road_m if has_strip else None, road, path.room_m,
        has_shore=place.ground is Ground.LAKE, clip_s=duration_s,
    )  # fmt: skip


def _scatter_all(
    description: SceneDescription,
    view: ViewClearance,
    actors: Sequence[Actor],
    nouns: Mapping[str, Noun],
    seed: int,
) -> list[SceneryItem]:
    """Scenery of the place.

    Nouns that the prompt counts are not used as scenery: "two trees" are two trees.
    """
    said = {*description.absent, *(scene_object.noun for scene_object in description.objects)}
    kinds = {kind_of(nouns[one]) for one in said if one in nouns}
    unsaid = {
        name: one
        for name, one in nouns.items()
        if name not in said and not (kind_of(one) and kind_of(one) in kinds)
    }
    surroundings = description.place
    place = surroundings.name or "grass"
    rules = [
        rule for rule in PLACES[place].scenery if rule.is_structure or not surroundings.is_empty
    ]
    if any(zone_of(one.noun) == "rails" for one in actors) and place != "railway":
        is_outside = not (PLACES[place].is_room or PLACES[place].is_backdrop)
        rails = (rule for rule in PLACES["railway"].scenery if rule.is_structure)
        rules.extend(rails if is_outside and PLACES[place].ground is not Ground.NONE else ())
    for backdrop in surroundings.backdrops:
        own = PLACES[SEEN_FROM_AFAR.get(backdrop, backdrop)].scenery
        far = [rule for rule in own if rule.where == "far"]
        # What stands before the mountains on land would stand in the sea.
        rules.extend(far if far and PLACES[place].ground is Ground.SEA else own)
    telling = list_telling(place) if is_said_room(description, place) else ()
    draw = partial(seeded, seed, "scenery", place)
    return scatter(rules, view, actors, unsaid, draw=draw, telling=telling)


def kind_of(noun: Noun) -> str:
    """Kind of which scenery shows none beside what a scene names: people or traffic."""
    is_traffic = zone_of(noun) == "road" and noun.speed_m_s > 0.0
    return "people" if noun.name in PERSON_NOUNS else "traffic" if is_traffic else ""


def _label(items: Sequence[SceneryItem], last: int, nouns: Mapping[str, Noun]) -> list[SceneryItem]:
    """The pieces; people and traffic, which detectors find, with ids after the `last` one."""
    labelled = [number for number, one in enumerate(items) if kind_of(nouns[one.rule.noun])]
    ids = dict(zip(labelled, itertools.count(last + 1), strict=False))
    return [replace(one, instance=ids.get(number, 0)) for number, one in enumerate(items)]


def _choose_levels(
    place: PlaceModel, description: SceneDescription, nouns: Mapping[str, Noun]
) -> dict[str, float]:
    """Height of origins above the ground: habitat or noun → multiple of an object's size.

    "clear" is in metres, on top of that, for what flies.
    """
    if place.ground is Ground.NONE:
        everything = {nouns[scene_object.noun].name: 0.0 for scene_object in description.objects}
        return {"air": 2.0, "water": 0.0, **everything}
    levels = {"air": 1.5, "water": 0.5, "clear": place.flight_m}
    if place.ground is Ground.UNDERWATER:
        swimming = [one for one in description.objects if one.motion and one.motion.kind == "swim"]
        divers = [one.noun for one in swimming if nouns[one.noun].habitat == "ground"]
        return {**levels, "water": 0.9, **dict.fromkeys(divers, _OFF_THE_BED)}
    if place.has_surface:
        swimmers = {noun.name: _SUNK for noun in nouns.values() if noun.habitat == "water"}
        wading = {
            one.noun for one in description.objects if one.motion and one.motion.kind == "swim"
        } - {*swimmers, *PERSON_NOUNS}
        swimmers |= dict.fromkeys(wading, _WADING)
        if place.ground is Ground.SEA:
            swimmers |= dict.fromkeys(nouns_with("awash"), _AWASH)
        swimmers |= {"afloat": _DRAUGHT, **dict.fromkeys(AFLOAT, 0.0)}
        return {**levels, "water": 0.0, **swimmers}
    return {**levels, **dict.fromkeys(AFLOAT, 0.25)}
