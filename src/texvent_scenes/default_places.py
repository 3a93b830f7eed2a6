"""Default places of scenes and of what is far in them, and ways along their corridors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.activities import MOUTH_ACTIVITIES
from texvent_scenes.models.places import PLACES, is_room
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.spec.scene import Direction, Place, SceneObject

_STRUCK_FAR = 5.0
"""Size of lightning that strikes far off."""
AFLOAT_MOTIONS = ("sail", "paddle")
AT_HAND = frozenset({"hold", "wear", "act on"})
IN_WATER = ("swim", "surf", "plunge", *AFLOAT_MOTIONS)
_PLACES_OF_TRAVEL = {"drive": "road", "cycle": "road", "sail": "sea", "swim": "underwater"}
_BEDS: dict[str | None, str] = {
    None: "underwater", "sea": "underwater",
    "lake": "lake bed", "pond": "lake bed", "river": "lake bed",
}  # fmt: skip
"""Waters, or no place, in which all dive → their beds."""
_NO_GROUND = ("sky", "space", "underwater", "lake bed")
_FAST_FLYER_M_S = 9.0
"""Speed above which what flies is shown in the sky, far from the ground."""
_BORNE = ("on", "in", "ride", "under", "above")
"""Relations of what something else keeps off the ground."""
_ALONG = frozenset({"walk", "run", "drive", "roll", "fly", "crawl", "slide"})
"""Motions that lead along a corridor."""
_AIMED = frozenset({"to", "towards", "at", "into", "through"})
"""Relations to what is farther along a corridor."""


def choose_place(description: SceneDescription, nouns: Mapping[str, Noun]) -> str:
    """The place that is said, or the usual one of the objects."""
    led = {n for one in description.relations if one.kind in AT_HAND for n in one.targets}
    led |= {
        one.subject
        for one in description.relations
        if one.kind in ("in", "on") and _swims(nouns[description.objects[one.subject].noun])
    }  # "on a puddle"
    members = [nouns[one.noun] for n, one in enumerate(description.objects) if n not in led]
    kinds = {one.motion.kind for one in description.objects if one.motion is not None}
    said, usual = description.place, _usual_place(members, description, kinds)
    dives = all(noun.habitat == "water" and noun.motion not in AFLOAT_MOTIONS for noun in members)
    dives = dives and bool(members) and "jump" not in kinds
    if dives and said.name in _BEDS:
        return _BEDS[said.name]
    if said.name == "sea":
        return "beach" if _stands_ashore(description, nouns) else "sea"
    if said.name == "sky" and any(noun.habitat == "fixed" for noun in members):
        return "grass"  # "a kite in the sky over a hill"
    travel = (one.means or "" for one in description.camera.moves if one.kind == "travel")
    of_travel = [_PLACES_OF_TRAVEL[means] for means in travel if means in _PLACES_OF_TRAVEL]
    if said.name is None and not of_travel and (said.has_snow or said.weather == "snow"):
        return "snow"
    if said.name is None and not of_travel:
        usual = "sea" if said.wave_height > Place.wave_height else usual
        usual = "city" if said.road is not None and not PLACES[usual].has_road else usual
        return "beach" if usual == "sea" and _stands_ashore(description, nouns) else usual
    return said.name or of_travel[0]


def _stands_ashore(description: SceneDescription, nouns: Mapping[str, Noun]) -> bool:
    """Whether something of the ground is neither in water nor on or in something else."""
    borne = {one.subject for one in description.relations if one.kind in _BORNE}
    borne |= {n for one in description.relations if one.kind in AT_HAND for n in one.targets}
    wet = {*IN_WATER, "hover", "float", "fly", "glide", "rise", "fall", "sink", "throw"}
    return any(
        _is_of_land(nouns[one.noun]) and n not in borne
        and not any(motion.kind in wet for motion in one.motions)
        for n, one in enumerate(description.objects)
    )  # fmt: skip


def _is_of_land(noun: Noun) -> bool:
    """Whether it stands on land: on feet or wheels, or as a sandcastle does."""
    return noun.habitat == "ground" or (trait_value("usual place", noun.name) == "beach")


def _swims(noun: Noun) -> bool:
    """Whether a noun is in water or on it."""
    return noun.habitat == "water" or noun.motion in AFLOAT_MOTIONS


def _usual_place(members: Sequence[Noun], description: SceneDescription, kinds: set[str]) -> str:
    """Usual place of objects with these motions."""
    habitats = {noun.habitat for noun in members}
    of_nouns = [trait_value("usual place", noun.name) or noun.place for noun in members]
    if (
        habitats == {"water"}
        or "plunge" in kinds
        or (habitats == {"ground"} and kinds & {"swim", "surf"})
    ):
        return "sea"
    if any(noun.motion in AFLOAT_MOTIONS for noun in members):
        return "sea" if "sea" in of_nouns else "lake"
    is_outdoors = description.place.weather in ("rain", "snow") or any(
        noun.name in nouns_with("outdoors") for noun in members
    )
    of_acts = [trait_value("place of activity", kind) for kind in sorted(kinds)]
    for place in filter(None, (*of_nouns, *of_acts)):
        is_wrong = (
            (is_outdoors and is_room(place))
            or ("ground" in habitats and place in _NO_GROUND)
            or ("fixed" in habitats and place == "sky")
        )
        if not is_wrong:
            return str(place)
    if "water" in habitats and kinds & {"swim", "jump"}:  # "a dolphin jumps through a hoop"
        return "sea"
    is_fast = all(noun.speed_m_s >= _FAST_FLYER_M_S for noun in members)
    rests = kinds <= {"stand", "sit", "lie", "rise", "sink"} | MOUTH_ACTIVITIES
    return "sky" if habitats == {"air"} and is_fast and not rests else "grass"


def lead_along(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Ways along a corridor of those who go somewhere in it: they come.

    Seen from behind, to things, or with smaller followers, whom they would hide, they go away.
    """
    tall = [nouns[one.noun].build(colour=None, scale=one.size, seed=0).height
            for one in description.objects]  # fmt: skip
    aimed = {one.subject for one in description.relations if one.kind in _AIMED}
    aimed |= {n for one in description.relations for n in (one.subject, *one.targets)
              if one.kind == "follow" and tall[one.subject] < tall[one.targets[0]]}  # fmt: skip
    is_back = description.camera.view == "back"

    def led(one: SceneObject, is_away: bool) -> SceneObject:
        if not one.motions or one.heading_deg is not None:
            return one
        first, *others = one.motions
        if first.kind not in _ALONG or first.direction not in (None, "down", "forward"):
            return one
        way: Direction = "away" if is_away else "towards"
        return replace(one, motions=(replace(first, direction=way), *others))

    objects = (led(one, is_back or n in aimed) for n, one in enumerate(description.objects))
    return replace(description, objects=tuple(objects))


def set_far(description: SceneDescription) -> SceneDescription:
    """Towering objects stand in the background of others that they are not related to."""
    towering, objects = nouns_with("towering"), description.objects
    related = {n for one in description.relations for n in (one.subject, *one.targets)}
    related |= {n for n in (description.index(description.camera.target),) if n is not None}
    if all(one.noun in towering for one in objects):
        return description
    far = (n for n, one in enumerate(objects)
           if one.noun in towering and (one.placement, one.position_m) == (None, None))  # fmt: skip
    return description.replaced({n: replace(objects[n], placement="far") for n in {*far} - related})


def strike_far(description: SceneDescription) -> SceneDescription:
    """Lightning strikes far off, unless the scene says what it strikes or how large it is."""
    related = {n for one in description.relations for n in (one.subject, *one.targets)
               if one.kind != "above"}  # fmt: skip
    new = {
        n: replace(one, size=_STRUCK_FAR, placement=one.placement or (
            "far" if len(description.objects) > one.count else None))
        for n, one in enumerate(description.objects)
        if one.noun in nouns_with("out of clouds") and n not in related and one.size == 1.0
        and one.position_m is None
    }  # fmt: skip
    return description.replaced(new)
