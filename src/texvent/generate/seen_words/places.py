"""Whether a place has what its word says: a slope, water that looks like water, a fence."""

from __future__ import annotations

import re

import numpy as np

from texvent.generate.landmarks import WATER, is_marked
from texvent.generate.seen_words.lighting import sky_share
from texvent.generate.seen_words.picture import USUAL, Picture, View
from texvent.scenes.description import Claim, SceneDescription
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor

MOST_RED = 0.04
"""How much more red than blue water may be, as a share of white."""
LEAST_CLOUDED = 0.1
"""Share of the picture that a sky of clouds covers."""
LEAST_RIVER, LEAST_SEA = 0.02, 0.08
"""Share of the picture that a river covers, and a sea or a lake: no line at the horizon."""
LEAST_EDGE = 0.05
"""Difference of water, or a road, from the ground beside."""
_WATER_WORDS = frozenset({"water", "waters"})
LEAST_ROAD = 0.05
"""Share of the picture that a road covers, no sliver at its edge."""
LEAST_FLYER = 0.05
"""Extent of what is in the sky, as a share of the picture's width or height."""
LEAST_GROUND = 0.05
"""Share of the picture that a ground such as grass covers."""
LEAST_TELLING = 0.012
"""Share of the picture that a thing covers by which a place is told."""
_GROUNDS = ("grass", "savanna", "gravel", "soil", "sand", "snow", "construction site")
_ROADS = ("road", "dirt road", "city")
_FLAT = "the ground is flat"
_LACKS: dict[str, tuple[str, ...]] = {
    _FLAT: (
        "slope",
        "mountainside",
        "mountain side",
        "mountain slope",
        "ski slope",
        "snowy slope",
        "hillside",
    ),
    "the water is calm": ("surf",),
    "a plain road": ("avenue",),
    "a wood of firs and broadleaf trees": ("jungle", "rainforest"),
    "no furrows": ("ploughed field", "plowed field"),
    "as a plain room": ("hall", "halls"),
    "a road of two lanes": ("motorway", "highway", "freeway", "expressway", "interstate"),
    "no stalks": (
        "wheat field",
        "cornfield of wheat",
        "field of wheat",
        "grain field",
        "barley field",
        "field of barley",
        "rye field",
    ),
    "no mud": ("mud",),
    "no aisle between shelves": (
        "aisle",
        "warehouse aisle",
        "supermarket aisle",
        "store aisle",
        "shop aisle",
        "grocery aisle",
        "library aisle",
    ),
    "a track or two": ("train yard", "rail yard", "railyard"),
    "seen from one": ("balconies", "rooftops", "terraces"),
    "as wide as a lake": ("pond",),
    "as wide as a river": ("brook", "creek", "canal", "ditch"),
}
"""What a place is shown as, or lacks → its words."""
_NEEDS: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(("backyard", "yard"), ("house", "fence", "wooden house", "garden fence")),
    **dict.fromkeys(("bedroom", "hotel room", "dormitory"), ("bed", "double bed")),
    "hospital room": ("bed", "hospital bed"),
    **dict.fromkeys(("station", "train station", "railway station", "subway station",
                     "metro station", "underground station"), ("railway track", "rail track")),
    "classroom": ("school desk",),
    **dict.fromkeys(("forest", "wood", "woods", "woodland", "pine forest", "grove"),
                    ("pine", "tree", "palm", "birch")),
    **dict.fromkeys(("warehouse", "storehouse"), ("shelf", "crate", "pallet")),
    **dict.fromkeys(("laboratory", "lab", "research lab", "chemistry lab", "science lab"),
                    ("lab bench", "centrifuge", "microscope", "beaker", "flask")),
    **dict.fromkeys(("park", "city park", "public park", "park path"),
                    ("tree", "pine", "birch", "park bench", "bench", "park lamp")),
    "stage": ("stage curtain", "spotlight"),
    **dict.fromkeys(("platform", "train platform", "station platform", "railway platform",
                     "subway platform"), ("railway track", "rail track", "train")),
    **dict.fromkeys(("library", "bookshop", "bookstore"), ("bookshelf", "shelf")),
    **dict.fromkeys(("cemetery", "graveyard", "churchyard"), ("gravestone", "tombstone", "grave")),
    "garden": ("flower", "fence", "garden fence"),
    **dict.fromkeys(("garage", "auto repair shop", "car workshop"), ("car lift",)),
    **dict.fromkeys(("gym", "gymnasium", "sports hall"), ("treadmill", "basketball hoop")),
    **dict.fromkeys(("street", "city street", "sidewalk", "pavement"),
                    ("building", "house", "skyscraper", "shop", "street lamp", "wooden house")),
}  # fmt: skip
"""Word → things one of which makes a lawn such a place."""
_WATERS = ("river", "lake", "sea", "beach")
_TOWNS = ("city", "town", "downtown", "cityscape", "skyline", "city skyline")
_PAVEMENTS = ("sidewalk", "pavement")
_STREETS = (*_PAVEMENTS, "street", "city street", "street corner", "intersection", "crossing",
            "crossroads", "junction")  # fmt: skip
_TOWN_HOUSES = frozenset({"building", "house", "skyscraper", "wooden house"})
LEAST_HILLS = 0.03
"""Share of the picture that hills cover by which a hilly land is told."""
_OF_ROOFS, LEAST_ROOF = frozenset({"roof parapet", "roof unit"}), 0.03
"""What stands on a roof, and the share of the picture by which that is told."""
LEAST_TOWN = 0.03
"""Share of the picture that houses of the scenery cover by which a town is told."""
_SHORES = ("beach", "shore", "coast", "seaside", "seashore", "shoreline", "coastline", "lakeside",
           "riverbank", "river bank")  # fmt: skip
_STREAMS = frozenset({"pour", "pour into", "drip", "fountain", "falling water"})
"""Effects that are water of themselves."""
LEAST_LAND = 0.03
"""Share of the picture that is land beside the water, where a shore is."""


_LEAPING = frozenset({"jump", "flip", "skateboard trick", "snowboard trick", "ski trick"})


def _leaps(description: SceneDescription) -> bool:
    """As in "jumps in the air": who leaves the ground is there for a moment."""
    return any(
        motion is not None and motion.kind in _LEAPING
        for one in description.objects
        for motion in (one.motion, *one.then)
    )


def judge_place(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Why a word of a place is not seen, or None."""
    if claim.aspect == "steep":
        return _FLAT
    if claim.aspect == "clouds" and sky_share(picture) < LEAST_CLOUDED:
        return "hardly any sky in view"
    if claim.aspect != "place":
        return _judge_waves(picture, description, claim) if claim.aspect == "waves" else None
    fault = _find_lack(picture, claim)
    if fault is not None:
        return fault
    place = description.surroundings.place
    if claim.value == "sky" and place != "sky":
        is_overhead = claim.word == "overhead"
        said = _find_said_of(description, claim.word) if is_overhead else None
        is_seen = _is_anything_aloft(picture, must_fly=is_overhead, said=said)
        is_seen = is_seen or (not is_overhead and _leaps(description))
        return None if is_seen else "nothing is seen there"
    is_poured = any(kind in _STREAMS for kind, _ in picture.scene.particles.kinds)
    if claim.word == "water" and is_poured:
        return None
    if claim.word in _WATER_WORDS and place not in (*_WATERS, "underwater"):
        return None if place in ("sky", "space", None) else "no water in view"
    if claim.value in _WATERS and place in _WATERS:
        is_ashore = _is_one_of(claim.word, _SHORES) or claim.word.startswith("beach")
        least = LEAST_RIVER if place == "river" else LEAST_SEA
        return _judge_water(picture, least) or (_judge_land(picture) if is_ashore else None)
    if claim.value in _ROADS and claim.word not in _TOWNS:
        return _judge_way(picture, claim.word, place)
    is_ground = claim.value == place and place in _GROUNDS
    return "out of view" if is_ground and picture.ground_share() < LEAST_GROUND else None


def _judge_waves(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Water is in view; what waves break against stands in it."""
    fault = _judge_water(picture)
    if fault is not None:
        return fault
    after = description.prompt.casefold().partition(claim.word)[2].split()
    if not after or after[0] not in ("against", "into", "over", "onto", "on"):
        return None
    phrase = " ".join(after[1:6])
    for name in description.claims:
        if name.aspect != "name" or not re.search(rf"\b{re.escape(name.word)}\b", phrase):
            continue
        met = [one for one in picture.scene.actors if one.object_index in name.things]
        spots = np.array([one.middle(0.0)[:2] for one in met]).reshape(-1, 2)
        kind, is_wet = is_marked(picture.scene.environment(0.0), spots)
        if met and not (kind == WATER and is_wet.any()):
            return f"they do not reach the {met[0].noun.name}"
    return None


def _find_lack(picture: Picture, claim: Claim) -> str | None:
    """What the place that a word names never has here, or not in this picture; None: nothing."""
    for reason, words in _LACKS.items():
        if _is_one_of(claim.word, words):
            return reason
    if claim.word in _TOWNS and not _has_houses(picture):
        return "hardly a house in view"
    if claim.value == "rooftop" and picture.scenery_share(_OF_ROOFS) < LEAST_ROOF:
        return "not told as a roof"
    needed = _NEEDS.get(claim.word)
    names = picture.seen_nouns(LEAST_TELLING) if needed or claim.value == "hills" else set()
    if needed is not None and not names & set(needed) and not _has_kerb(picture, claim):
        return f"no {' or '.join(needed)}"
    sky = max(float(view.is_sky.mean()) for view in picture.views)
    is_hilly = "green hill" in names and picture.scenery_share({"green hill"}) >= LEAST_HILLS
    if claim.value == "hills" and (not is_hilly or sky < LEAST_GROUND):
        return "not told as hills"
    return None


def _has_houses(picture: Picture) -> bool:
    """Whether houses, of the scenery or named, are in view."""
    is_scenery = picture.scenery_share(_TOWN_HOUSES) >= LEAST_TOWN
    return is_scenery or bool(picture.seen_nouns(LEAST_TOWN) & _TOWN_HOUSES)


def _has_kerb(picture: Picture, claim: Claim) -> bool:
    """Whether a street without houses is told by its roadway and pavement."""
    strips = [[float(part.mean()) for part in picture.strip(number)] for number in USUAL]
    return _is_one_of(claim.word, _STREETS) and max(map(min, strips)) >= LEAST_ROAD


def _is_one_of(word: str, words: tuple[str, ...]) -> bool:
    return word in words or word.removesuffix("s") in words


def _judge_water(picture: Picture, least: float = LEAST_RIVER) -> str | None:
    """Water that mirrors a red sky looks like soil: it must be as blue as it is red."""
    for number in USUAL:
        water, beside = picture.strip(number)
        if water.mean() < least:
            continue
        colours = picture.colours(number)
        red, _, blue = colours[water].mean(axis=0)
        if blue >= red - MOST_RED and _differ(colours[water], colours[beside]):
            return None
    return "not to be told from the ground"


def _judge_land(picture: Picture) -> str | None:
    """A shore has land beside the water."""
    shares = [float(picture.strip(number)[1].mean()) for number in USUAL]
    return None if max(shares) >= LEAST_LAND else "no land in view"


def _judge_way(picture: Picture, word: str, place: str | None) -> str | None:
    """A road, or the pavement beside it."""
    if place not in _ROADS:
        return "no street in view" if _is_one_of(word, _STREETS) else None
    if _is_one_of(word, _PAVEMENTS) and place == "city":
        beside = max(float(picture.strip(number)[1].mean()) for number in USUAL)
        return None if beside >= LEAST_GROUND else "out of view"
    return _judge_road(picture, is_trodden=place == "dirt road")


def _judge_road(picture: Picture, *, is_trodden: bool) -> str | None:
    """A road differs from the ground beside it, which must be in view where the road is earth."""
    for number in USUAL:
        road, beside = picture.strip(number)
        if road.mean() < LEAST_ROAD:
            continue
        colours = picture.colours(number)
        is_told = not is_trodden or beside.mean() >= LEAST_EDGE
        if is_told and _differ(colours[road], colours[beside]):
            return None
    return "not to be told from the ground"


def _differ(strip: Float64Array, beside: Float64Array) -> bool:
    """Whether water or a road is told from the ground beside it, if there is any."""
    if not len(beside):
        return True
    return bool(np.abs(strip.mean(axis=0) - beside.mean(axis=0)).max() >= LEAST_EDGE)


def _find_said_of(description: SceneDescription, word: str) -> tuple[int, ...] | None:
    """Objects whose name stands right before a word, as in "clouds overhead"; None: nothing."""
    prompt = description.prompt.casefold()
    named = [one for one in description.claims if one.aspect == "name"]
    return next((one.things for one in named if f"{one.word} {word}" in prompt), None)


def _is_anything_aloft(
    picture: Picture, *, must_fly: bool, said: tuple[int, ...] | None = None
) -> bool:
    """Whether something in view, no speck, is above the ground and above all that stands there.

    Where the prompt says of which objects it is `said`, one of these.
    """
    actors = picture.scene.actors
    for view in picture.views:
        tops = [float(one.corners(view.time_s)[:, 2].max()) for one in actors if not _flies(one)]
        for actor in (one for one in actors if _flies(one) or not must_fly):
            if said is not None and actor.object_index not in said:
                continue
            height = actor.trajectory.at(view.time_s).position[2]
            is_high = height > max(actor.model.height, 0.3) and (
                not _flies(actor) or height >= max(tops, default=0.0)
            )
            if is_high and _extent(picture, view, actor.instance) >= LEAST_FLYER:
                return True
    return False


def _flies(actor: Actor) -> bool:
    return actor.noun.habitat == "air"


def _extent(picture: Picture, view: View, instance: int) -> float:
    """Of a thing in a view, as a share of the picture's width or height."""
    at = picture.points[view.instance == instance]
    if not len(at):
        return 0.0
    edge = np.array([picture.size.width, picture.size.height])
    return float((np.ptp(at, axis=0) / edge).max())
