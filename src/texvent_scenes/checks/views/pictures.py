"""Picture check: words that change no pixels of small pictures, and motions of which nothing moves.

Each picture is compared with one of the scene without what a word says, or of another instant.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from texvent.sensor import SensorSize
from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.checks.surroundings.places import find_unseen_place, share_of_walls
from texvent_scenes.checks.views.surfaces import join_words
from texvent_scenes.defaults import NO_PLACE
from texvent_scenes.description import STANDING, SceneDescription, label_of
from texvent_scenes.models.effects import EFFECTS, LAMPS
from texvent_scenes.models.places import PLACES, PlaceModel, list_telling
from texvent_scenes.models.protocol import Pose
from texvent_scenes.raycast.render import render
from texvent_scenes.rendered_scene import Float64Array, Ground, RenderedScene, Texture
from texvent_scenes.spec.scene import Place
from texvent_scenes.staging.actors import Actor, PlacedModel, assemble
from texvent_scenes.staging.compose import ComposedScene
from texvent_scenes.staging.particles.choose import FALLING, Staged
from texvent_scenes.staging.particles.emitter import Emitter
from texvent_scenes.staging.surroundings.environment import build_environment
from texvent_scenes.staging.surroundings.road_line import RoadLine
from texvent_scenes.staging.tracks.phases import PATH_KINDS
from texvent_scenes.words import list_plurals

_SIZE, _LEAST_LEVELS, _WHITE, _LEAST_SHARE = SensorSize(120, 90), 6.0, 30.0, 0.002
"""Size of small pictures; difference of a pixel, of 255, that is seen, and that makes snow white;
share of those that are."""
_SEEN = {"has_snow": (_WHITE, _LEAST_SHARE), "clouds": (_LEAST_LEVELS, 0.02),
         "is_wet": (20.0, 0.03), "weather": (12.0, 0.01),
         "weather_amount": (12.0, 0.01)}  # fmt: skip
"""Kind → least difference and share that show it, if others than usual: of clouds no panes that
mirror them, of a wet ground more than a faint sheen, of heavy snow as much as makes it so."""
_SOFT = ((25.0, 0.006), (50.0, 0.002))
"""The same of what is soft, as dust, of which a faint trace shows nothing: one is enough."""
_FAINT = (3.0, 0.01)
"""Difference and share below which a change of pixels is not visible."""
_DRY = "the ground looks dry"
_UNTOLD = ("no pixel shows it", "so faint that it is hardly seen")
_GLEAM = (20.0, 0.004)
"""Difference and share of pixels that are brighter by what a wet ground mirrors in the dark."""
_DARK = ("night", "moonlight")
"""Light in which a wet ground is told by the lamps that it mirrors: dark it is anyway."""
_EMITTERS = {kind: one.emitters for kind, one in EFFECTS.items()}
_LEAST_SCENERY, _LEAST_TELLING, _STIRS = 0.02, 0.006, 0.0004
"""Least shares of a small picture that the scenery of a place changes, furniture of which half at
least is inside and that few rooms have, and what moves."""
_FULL = 0.16
"""Share of a small picture in which furniture tells that is cut off: shelves, and not feet."""
_ANY_ROOM = "indoor"
"""Place that bare walls tell."""
_LEAST_CLIP_S = 1.0
"""Length of a clip, s, in which motions get so far that they are judged."""
_FLOORS = (Texture.CONCRETE, Texture.PAVING, Texture.ASPHALT)
"""Grounds that many places have: only their scenery shows which one it is."""
_LEAST_HUE = 0.4
"""Difference of a channel, of the greatest, from which on two grounds are of different colours."""
_TELLING_WALLS, _LEAST_WALLS = (Texture.STONE,), 0.03
"""Walls that tell a room, as those of a cave; share of a picture that shows them."""
_TURNS = ("spin", "work", "rotate")
"""Motions that only a picture tells."""
_CARRIED = ("stand", "orbit")
"""Motions of a mark that turns with what it is on."""
_RESTS = ("stand", "stand open", "stand closed", "hang", "work", "sit", "lie", "show red",
          "show amber", "show green")  # fmt: skip
"""Motions that nothing needs to show."""
_VEILED, _VEILED_LEVELS = 0.001, 14.0
"""Least share of a small picture, and difference of its pixels, that show a body in fog or in the
dark."""
_POINT = 1e-6
"""Radius of particles that are too small to be seen, in sizes of an effect."""
_LATER_S = (0.13, 0.0171)
"""Times after which rotation shows, s: of both, no usual rate makes whole turns."""
_FINE = 13
"""Instants at which it is looked for motion: of fewer, one who hops may be on the ground at all."""
_SURROUNDINGS = ("colour", "sky", "weather", "clouds", "has_snow", "is_wet", "wave_height")
"""Fields of a place that pictures must show."""


@dataclass(frozen=True)
class SmallPictures:
    """Small pictures of a scene at instants, each drawn once."""

    scene: RenderedScene
    times: Sequence[float]
    """Instants, s."""
    _drawn: dict[float, Float64Array] = field(default_factory=dict, init=False)

    def at(self, time_s: float) -> Float64Array:
        """[height, width, 3] the picture at an instant, 0 to 255."""
        if time_s not in self._drawn:
            picture = render(self.scene, time_s, _SIZE, samples=1, shadows=False)
            self._drawn[time_s] = np.asarray(picture, dtype=np.float64)
        return self._drawn[time_s]

    def differ(
        self, other: RenderedScene, *, least: float = _LEAST_SHARE, levels: float = _LEAST_LEVELS
    ) -> bool:
        """Whether enough pixels are others in another scene, at one of the instants."""
        rest = SmallPictures(other, self.times)
        return any(_differ(self.at(one), rest.at(one), least, levels) for one in self.times)

    def gleam(self, other: RenderedScene) -> bool:
        """Whether enough pixels are brighter than in another scene, at one of the instants."""
        rest = SmallPictures(other, self.times)
        gains = ((self.at(one) - rest.at(one)).max(axis=-1) for one in self.times)
        return any(np.mean(one >= _GLEAM[0]) >= _GLEAM[1] for one in gains)

    def change(self) -> bool:
        """Whether enough pixels are others a moment after one of the instants."""
        return any(_differ(self.at(one), self.at(one + later_s))
                   for later_s in _LATER_S for one in self.times)  # fmt: skip

    def stay(self) -> bool:
        """Whether the pictures of all instants are the same."""
        first, *others = map(self.at, self.times)
        is_so = any(_differ(first, one, _STIRS) for one in others)
        return not is_so and not self.change()


def _differ(
    first: Float64Array, second: Float64Array, least: float = _LEAST_SHARE,
    levels: float = _LEAST_LEVELS,
) -> bool:  # fmt: skip
    """Whether enough pixels of two pictures differ."""
    return bool(np.mean(np.abs(first - second).max(axis=-1) >= levels) >= least)


def find_unshown(
    scene: ComposedScene, description: SceneDescription, times: Sequence[float]
) -> Iterator[Violation]:
    """Words of light, sky, ground, weather, effects, rotation and a place that leave no trace."""
    place, said, drawn = scene.place, description.place, SmallPictures(scene, times)
    for name, value, other in _list_without(scene, description):
        is_soft = name != "weather" and any(
            one.body == "medium" for one in _EMITTERS.get(str(value), ())
        )
        bounds = _SOFT if is_soft else (_SEEN.get(name, (_LEAST_LEVELS, _LEAST_SHARE)),)
        is_told = any(drawn.differ(other, least=least, levels=levels) for levels, least in bounds)
        if name == "is_wet" and description.light.kind in _DARK:
            is_told = drawn.gleam(other)
        if not is_told:
            is_kind = name in ("light", "weather", "effect")
            line = name.split("_")[-1] if value is True else f"{name} {value}"
            is_faint = drawn.differ(other, least=_FAINT[1], levels=_FAINT[0])
            is_ground = name == "is_wet"  # it is darker, which is no sheen
            line = f"{line.replace('_', ' ')}: {_DRY if is_ground else _UNTOLD[is_faint]}"
            yield Violation(name, value if is_kind else "", line)
            if name == "sky" and not any(one.colour == value for one in description.objects):
                yield Violation("colour", value, "")
    for one in description.objects:
        if one.is_lit and one.noun not in LAMPS:
            yield Violation("is_lit", "", f"lights of the {one.noun}")
    if said.weather == "fog" or description.light.kind in _DARK:
        yield from _find_veiled(scene, description, drawn)
    yield from _find_rest(scene, description, drawn)
    yield from _find_unturned(scene, description, times)
    is_said = not any(one.startswith(NO_PLACE) for one in description.notes)
    other = replace(scene, still=assemble([]))
    is_bare = is_said and not drawn.differ(other, least=_LEAST_SCENERY)
    if is_said and place.is_room and not _is_told(scene, said.name or "", times):
        is_bare = is_bare or not drawn.differ(other, least=_FULL)
    if is_bare and place.scenery and not said.is_empty and _is_shared(scene, times):
        line = f"{said.name}, of which {_tell_seen(scene, times)}"
        yield Violation("place", said.name or "", line)
    yield from find_unseen_place(
        scene, said, is_bare=is_bare, times=times,
        names_sky=description.is_sentence
        and bool(re.search(r"\bsk(y|ies)\b", description.prompt.casefold())),
    )  # fmt: skip


def _find_veiled(
    scene: ComposedScene, description: SceneDescription, drawn: SmallPictures
) -> Iterator[Violation]:
    """Bodies that leave no trace in fog or in the dark."""
    cause = "fog" if description.place.weather == "fog" else "the dark"
    for index, one in enumerate(description.objects):
        rest = tuple(each for each in scene.actors if each.object_index != index)
        hidden = replace(scene, actors=rest)
        if len(rest) < len(scene.actors) and not drawn.differ(
            hidden, least=_VEILED, levels=_VEILED_LEVELS
        ):
            yield Violation("noun", one.noun, f"the {one.noun}: {cause} hides it")


def _find_unturned(
    scene: ComposedScene, description: SceneDescription, times: Sequence[float]
) -> Iterator[Violation]:
    """Rotations of bodies that look the same from all sides, each seen alone and from one place."""
    path = replace(scene.camera_path, moves=(), tie=None)
    for index, one in enumerate(description.objects):
        on = [each.subject for each in description.relations
              if each.kind == "on" and index in each.targets]  # fmt: skip
        marks = {n for n in on if (description.objects[n].motion or STANDING).kind in _CARRIED}
        own = tuple(each for each in scene.actors if each.object_index in {index} | marks)
        kind = one.motion.kind if one.motion and not one.motions[1:] else ""
        if kind not in _TURNS or not own:
            continue
        alone = replace(scene, actors=own, still=assemble([]), particles=Staged(()))
        alone = alone if path.journey else replace(alone, camera_path=path)
        if not SmallPictures(alone, times).change():
            line = f"the {one.noun}'s turning: it looks the same from all sides"
            yield Violation("motion", kind, line)


def _is_told(scene: ComposedScene, place: str, times: Sequence[float]) -> bool:
    """Whether furniture is in the image by which one tells a room."""
    own = [one for one in scene.scenery if one.rule.noun in list_telling(place)]
    own_camera = [scene.camera(time_s) for time_s in times]
    shares = [sum(one.share_of(camera) for one in own) for camera in own_camera]
    return max(shares) >= _LEAST_TELLING


def _tell_seen(scene: ComposedScene, times: Sequence[float]) -> str:
    """Parts of a place in view that do not tell it: its walls, its ground, what many have."""
    cameras = [scene.camera(time_s) for time_s in times]
    shares: dict[str, float] = {}
    for one in scene.scenery:
        own = max(map(one.share_of, cameras))
        shares[one.rule.noun] = shares.get(one.rule.noun, 0.0) + own
    seen = [list_plurals(noun)[0] for noun, share in shares.items() if share >= _LEAST_TELLING]
    rest = ["walls", "the floor"] if scene.place.is_room else ["the ground"]
    verb = "is" if [*seen, *rest] == ["the ground"] else "are"
    return f"only {join_words([*seen, *rest])} {verb} in view"


def _is_shared(scene: ComposedScene, times: Sequence[float]) -> bool:
    """Whether a place without its scenery looks like others: as grass, or as an empty room."""
    place = scene.place
    if place.is_room:
        is_telling = place.walls in _TELLING_WALLS or place.corridor_m > 0.0
        is_telling |= scene.place is PLACES[_ANY_ROOM]
        return not (is_telling and max(share_of_walls(scene, at) for at in times) >= _LEAST_WALLS)
    alike = (one for one in PLACES.values() if one.ground is place.ground)
    first = next(one for one in alike if one.surface is place.surface)
    is_common = place.surface in _FLOORS or place.ground is Ground.CITY
    is_water = place.has_shore and place.colours[0] == first.colours[0]  # a pond, as a river
    return is_common or not (place is first or is_water or _has_own_colour(place, first))


def _has_own_colour(place: PlaceModel, usual: PlaceModel) -> bool:
    """Whether the ground of a place differs in hue from that of another place."""
    own, other = (np.array(one.colours[0]) / max(one.colours[0]) for one in (place, usual))
    return bool(np.abs(own - other).max() >= _LEAST_HUE)


def _find_rest(
    scene: ComposedScene, description: SceneDescription, drawn: SmallPictures
) -> Iterator[Violation]:
    """Motions of bodies that neither move nor take a posture, or of which no picture tells."""
    times = drawn.times
    fine = [float(one) for one in np.linspace(times[0], times[-1], _FINE)]
    for index, one in enumerate(description.objects):
        own = [actor for actor in scene.actors if actor.object_index == index]
        kind = one.motion.kind if one.motion and not one.motions[1:] else _RESTS[0]
        if not own or kind in _RESTS:
            continue
        name = label_of(description, index)
        if not any(_is_changed(actor, fine) for actor in own):
            yield Violation("motion", kind, f"the {name}'s {kind}: nothing of it moves")
        elif kind in PATH_KINDS and times[-1] >= _LEAST_CLIP_S and drawn.stay():
            yield Violation("motion", kind, f"the {name}'s {kind}: the picture stays the same")


def _is_changed(actor: Actor, times: Sequence[float]) -> bool:
    """Whether its parts are in other places at another instant, or than at rest, or shine so."""
    first, *others = (actor.place(time_s) for time_s in times)
    rest = PlacedModel(actor.own_parts(Pose(0.0, 0.0, 0.0, "stand")), first.to_world, 0)
    drawn = [assemble([one]) for one in (first, *others, rest)]
    states = [np.column_stack([one.to_world.reshape(-1, 12), one.emission]) for one in drawn]
    return not all(
        one.shape == states[0].shape and np.allclose(one, states[0], atol=1e-3)
        for one in states[1:]
    )


def _list_without(
    scene: ComposedScene, description: SceneDescription
) -> Iterator[tuple[str, Any, ComposedScene]]:
    """Kind and value of what is said of surroundings, and the scene without it."""
    said, base, staged = description.place, scene.animated_environment.base, scene.particles
    x, y = map(float, base.road_offset)
    road = RoadLine(base.road_angle, (x, y), tuple(map(tuple, base.road_crossings)))

    def without(**fields: Any) -> ComposedScene:
        other = build_environment(
            replace(description, **fields), place=scene.place, road=road,
            room_m=scene.camera_path.room_m, corridor_m=scene.camera_path.corridor_m,
            distance_m=scene.camera_path.framing.distance_m,
        )  # fmt: skip
        return replace(scene, animated_environment=other)

    for name in _SURROUNDINGS:
        value, usual = getattr(said, name), getattr(Place, name)
        is_so = name == "has_snow" and scene.place.ground is Ground.SNOW  # by itself
        is_so |= name == "clouds" and value == 0.0  # where the sky is in view it is so
        is_so |= name == "is_wet" and (said.weather == "rain" or not value)
        if value != usual and value not in FALLING and not is_so:
            yield name, value, without(place=replace(said, **{name: usual}))
    if said.weather_amount > Place.weather_amount:
        usual = without(place=replace(said, weather_amount=Place.weather_amount))
        pairs = [*zip(staged.effects, staged.kinds, strict=True)]
        fewer = tuple(one.thinned(said.weather_amount) if own == said.weather else one
                      for one, own in pairs)  # fmt: skip
        yield "weather_amount", said.weather_amount, replace(
            usual, particles=replace(staged, effects=fewer))  # fmt: skip
    if description.light.kind not in (None, "day"):
        yield "light", description.light.kind, without(light=replace(description.light, kind=None))
    for kind in dict.fromkeys((said.weather, *(one.kind for one in description.effects))):
        pairs = [*zip(staged.effects, staged.kinds, strict=True)]
        rest = tuple(effect for effect, own in pairs if own != kind)
        if len(rest) < len(staged.effects):
            name = "weather" if kind == said.weather else "effect"
            yield name, kind, replace(scene, particles=replace(staged, effects=rest))
        if any(one.light for one in _EMITTERS.get(str(kind), ())):  # by its flames, not its light
            dim = tuple(_dimmed(one) if own == kind else one for one, own in pairs)
            yield "effect", kind, replace(scene, particles=replace(staged, effects=dim))


def _dimmed(emitter: Emitter) -> Emitter:
    """An emitter of which nothing is seen that shines, though it lights what is around."""
    dim = replace(emitter.style, radius=(_POINT, _POINT))
    return replace(emitter, style=dim) if emitter.style.emission[0] else emitter
