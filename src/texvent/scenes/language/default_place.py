"""The place of a scene that the prompt leaves open, or states only in part."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.language.place_cues import NO_CUES, PlaceCues
from texvent.scenes.language.vocabulary.place_cues import ENCLOSED
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Noun

_FAST_FLYER_M_S = 4.0
"""What flies faster than this is shown in the sky, far from the ground."""
_PIER = "pier"
"""What stands in the water, with what is on it."""
_AFLOAT_MOTIONS = ("sail", "paddle")

_AT_GROUND = ("stand", "sit", "lie", "rise", "sink")
"""What flyers do at the ground: they take off from it and land on it."""
_IN_WATER = ("swim", "surf")
"""What people and animals of the land do in water only."""
SHORE, BEACH = "lake", "beach"
"""Where what stands on land is beside a lake, or the sea: water with land before it."""
_PLACE_OF_ACT = {"ski": "snow", "snowboard": "snow", "fish": SHORE,
                 "park": "parking lot", "skydive": "sky", "snowboard trick": "snow",
                 "ski trick": "snow", "stand on skis": "snow",
                 "ice skate": "ice rink"}  # fmt: skip
"""What people do in one place only → where."""
_USUAL_PLACES_OF_ACTS: dict[str, tuple[str, ...]] = {
    "indoor": ("mop", "vacuum", "sweep", "iron", "type", "play piano", "play cello", "play harp",
               "play video games", "play chess", "bowl", "tango", "make pottery", "count money",
               "shuffle cards", "play wii",
               "type on keyboard", "arrange flowers", "get haircut",
               "cut nails", "massage legs", "tie tie", "bandage arm",
               "eat noodles", "eat cake", "eat meal", "eat salad", "blow out cake",
               "lift trophy", "knit"),
    "bedroom": ("make bed",),
    "kitchen": ("cook", "cook eggs", "cook sausages", "cook meat", "cook vegetables",
                "flip pan", "wash dishes", "sharpen knife"),
    "bathroom": ("shave", "brush teeth", "wash face", "wash hair", "dry hair", "comb hair",
                 "put on makeup", "put on lipstick", "wash hands", "take shower", "fill brows",
                 "do laundry"),
    "gym": ("deadlift", "box", "pull-up", "plank", "push-up", "sit-up", "dunk"),
    "square": ("skate", "skateboard trick", "roller skate"),
}  # fmt: skip
"""Place → what people usually do there, where nothing else tells of a place."""
_PLACE_OF_TRAVEL = {"drive": "road", "cycle": "road", "sail": "sea", "swim": "underwater"}
"""How a camera travels → where it does so."""
_USUAL_PLACES: dict[str, tuple[str, ...]] = {
    "road": ("car", "suv", "bus", "truck", "van", "pickup", "motorcycle", "bicycle", "tractor"),
    "city": ("taxi", "police car", "fire engine", "traffic light", "street lamp", "building"),
    "savanna": ("ostrich", "elephant", "zebra", "lion", "giraffe", "tiger"),
    "sand": ("palm", "cactus", "flamingo"),
    "snow": ("penguin",),
    "construction site": ("crane", "excavator", "worker", "traffic cone"),
    "indoor": (
        "table", "chair", "sofa", "bed", "cup", "bottle", "clock", "candle", "lamp", "fan",
        "basketball", "pendulum", "bookshelf", "tennis ball", "spiral disc", "zoetrope",
        "marble run", "watch movement", "filament printer", "ironing board", "goldfish bowl",
        "gift", "pancake", "popcorn", "fried egg", "noodles", "steak", "sushi", "croissant",
        "trophy", "medal", "dartboard", "bowling pin", "pool cue", "ping-pong paddle", "yarn ball",
    ),
    "laboratory": (
        "lab bench", "flask", "beaker", "test tube", "petri dish", "centrifuge", "bunsen burner",
        "prism", "double pendulum", "tuning fork", "led matrix",
    ),
    "gym": ("punching bag", "dumbbell", "barbell", "boxing glove"),
    "plain": ("sphere", "cube", "cylinder", "cone", "box", "wheel", "rocket", "hand",
              "siemens star", "dotted disc"),
    "forest": ("bear", "wolf", "fox", "deer"),
    "grass": ("tent",),
    "square": ("skateboarder",),
    "tennis court": ("tennis player",),
    "basketball court": ("basketball player",),
    "boxing hall": ("boxer",),
    "stage": ("conductor", "ballerina", "flamenco dancer"),
    "kitchen": ("chef",),
    "sea": ("iceberg",),
}  # fmt: skip
"""Place → nouns that are usually found there; what is not listed is shown on grass."""


_OUTDOORS = frozenset(
    {"tree", "pine", "palm", "birch", "bush", "hedge", "house", "barn", "castle", "lighthouse",
     "car", "bus", "truck", "horse", "cow", "sheep", "street lamp", "fence", "bench", "tent",
     "temple", "church", "tractor", "taxi", "train", "tram", "steam locomotive", "bridge", "ship",
     "airplane", "helicopter", "excavator", "waterfall", "tower", "volcano", "golf club",
     "building", "skyscraper", "shop", "clock tower", "factory building", "fire hydrant",
     "parking meter", "stop sign", "traffic light", "golfer", "baseball", "frisbee",
     "baseball bat", "baseball batter", "baseball player", "wooden house", "windmill",
     "crosswalk", "mountain"}
)  # fmt: skip
"""Nouns that are not found in a room."""
_NEUTRAL = ("grass", "plain")
"""Places that say nothing where the program chose them."""
_FIELDS = ("wheat field", "soil")
"""Where vehicles of farms are that work, on no road."""
_FARM_VEHICLES = frozenset({"tractor"})
_DIVERS = ("scuba diver",)
_SEA_BED = ("rock", "seaweed", "coral", "anchor", "chest", "treasure chest", "starfish", "crab",
            "arch", "ruin", "statue", "coral branch", "anemone")  # fmt: skip
"""What is under water beside what swims there."""
_UNREMARKABLE = "plain"
"""The place that needs no note where the program chose it: bare ground."""
_NAMES = {"snow": "snow", "sand": "sand", "hills": "hills", "grass": "grass", "sky": "the sky",
          "space": "space", "indoor": "a room",
          "underwater": "under water", "sea": "the sea", "soil": "bare soil"}  # fmt: skip
"""Place → its name in a sentence, where that is not the word itself with "a"."""
_INSIDE = ("indoor", "living room", "kitchen", "bedroom", "office", "workshop", "gym",
           "laboratory")  # fmt: skip


def choose_place(
    description: SceneDescription, nouns: Mapping[str, Noun], cues: PlaceCues = NO_CUES
) -> str:
    """The place of the scene: as stated, or the usual one for its objects.

    Fish "in the sea" are shown under water, and a house "by the sea" on the beach. What is not
    stated is never inside where a word tells of outdoors, and never outdoors where one tells of a
    room; where words tell of both, the objects decide.
    """
    usual = _choose_by_objects(description, nouns)
    if description.surroundings.place is not None:
        return usual
    is_open = usual in _NEUTRAL or (usual == SHORE and cues.outdoor == "sea")
    if usual in _NEUTRAL and _floats_in_space(description):
        return "space"
    if usual in _NEUTRAL and not (cues.is_outdoors or cues.is_indoors):
        usual = _choose_by_acts(description) or usual
    if cues.is_outdoors and cues.outdoor in _FIELDS and usual == "road":
        return cues.outdoor if _is_of_farms(description) else usual
    if cues.outdoor == "space" and usual not in _NEUTRAL:
        return usual
    if cues.is_outdoors and cues.outdoor and (usual in ENCLOSED or is_open):
        found = {noun.habitat for noun in _list_members(description, nouns)}
        is_ashore = found <= {"ground", "fixed"}
        return BEACH if cues.outdoor == "sea" and is_ashore else cues.outdoor
    if cues.is_indoors and cues.indoor and (usual not in ENCLOSED or usual == "indoor"):
        return cues.indoor
    return usual


def _choose_by_acts(description: SceneDescription) -> str | None:
    """Where what its people do is usually done; None = anywhere, or outdoors among its things."""
    kinds = {one.motion.kind for one in description.objects if one.motion is not None}
    if _OUTDOORS.intersection(one.noun for one in description.objects):
        return None
    found = (place for place, acts in _USUAL_PLACES_OF_ACTS.items() if kinds.intersection(acts))
    return next(found, None)


def _is_of_farms(description: SceneDescription) -> bool:
    """Whether all vehicles that are usually on roads work on farms, too."""
    on_roads = {one.noun for one in description.objects} & set(_USUAL_PLACES["road"])
    return on_roads <= _FARM_VEHICLES


def _list_members(description: SceneDescription, nouns: Mapping[str, Noun]) -> list[Noun]:
    """Nouns of its objects, but of those that others have with them."""
    carried = {
        target
        for relation in description.relations
        if relation.kind in ("carry", "hold", "wear")
        for target in relation.targets
    }
    return [
        nouns[scene_object.noun]
        for index, scene_object in enumerate(description.objects)
        if index not in carried
    ]


def _choose_by_objects(description: SceneDescription, nouns: Mapping[str, Noun]) -> str:
    """The place as stated, or where its objects usually are."""
    said = description.surroundings
    members = _list_members(description, nouns)
    is_in_water = any(
        one.motion is not None
        and one.motion.kind in _IN_WATER
        and nouns[one.noun].habitat == "ground"
        for one in description.objects
    )
    swimmers = [noun for noun in members if noun.name not in (*_DIVERS, *_SEA_BED)]
    is_submerged = bool(swimmers) and all(
        noun.habitat == "water" and noun.motion not in _AFLOAT_MOTIONS for noun in swimmers
    )
    is_submerged = is_submerged and not _leaps(description)
    stated = _fit_stated(description, members, nouns, is_submerged=is_submerged)
    if stated is not None:
        return stated
    if _is_of_clouds(description):
        return "sky"
    if is_submerged:
        return "underwater"
    if is_in_water:
        return "sea"
    for move in description.shot.moves:
        if move.kind == "travel" and move.means in _PLACE_OF_TRAVEL:
            return _PLACE_OF_TRAVEL[move.means]
    if "city" in said.backdrops:
        return "city"
    kinds = {move.kind for one in description.objects for move in (one.motion, *one.then) if move}
    if kinds & _RACKET_ACTS and {one.noun for one in description.objects} & _OF_TENNIS:
        return "tennis court"
    of_act = [place for one in description.objects if (place := _place_of_act(one, nouns))]
    if said.has_snow or of_act:
        return "snow" if said.has_snow else of_act[0]
    rests = all(
        one.motion is not None
        and (one.motion.kind in _AT_GROUND or one.motion.kind in nouns[one.noun].acts)
        for one in description.objects
    )
    return _choose_usual(members, rests=rests, is_wet=said.weather in ("rain", "snow"))


_RACKET_ACTS = frozenset({"swing racket", "serve"})
_OF_TENNIS = frozenset({"tennis racket", "tennis ball", "tennis player"})
_ALOFT = frozenset({"fly", "hover", "float", "fall", "rise", "sink", "throw", "blow", "orbit"})
"""Motions in which what lives on the ground is in the air."""
_AT_SEA = frozenset({"swim", "surf", "sail", "paddle", "float", "dive", "row", "sink"})
"""Motions in which it is in the water."""
_WEIGHTLESS = frozenset({"float", "hover", "fly", "orbit", "tumble"})
"""Motions of an astronaut in space."""
_OFFSHORE = frozenset({_PIER, "bridge", "lighthouse", "oil rig", "iceberg", "rock", "island"})
"""Things that stand in the sea."""


_AFLOAT = ("in", "slide")
"""Shore and kind of the motion of things that drift on water."""


def _needs_ground(
    description: SceneDescription, nouns: Mapping[str, Noun], kinds: frozenset[str]
) -> bool:
    """Whether something stands in no sky, and no sea: who watches a balloon drift overhead.

    What flies, floats or falls by itself needs none, nor who is in or on it; `kinds` are the
    motions in which others do so, too.
    """
    borne = {
        index
        for index, one in enumerate(description.objects)
        if nouns[one.noun].habitat in ("air", "water")
        or one.noun in _OFFSHORE
        or any(move is not None and move.kind in kinds for move in (one.motion, *one.then))
    }
    for one in description.relations:
        if one.kind in _BEARING and borne.intersection(one.targets):
            borne.add(one.subject)
        elif one.kind in ("hold", "carry") and one.subject in borne:
            borne.update(one.targets)
    return not borne >= set(range(len(description.objects)))


_BEARING = frozenset({"in", "on", "ride", "ride along"})
"""Relations of what goes through the air in or on something else."""
_NO_GROUND = ("space", "underwater", "sky")


def _place_of_act(one: SceneObject, nouns: Mapping[str, Noun]) -> str | None:
    """Where a thing does what it does: who skis is in snow, a plane taxis at an airport."""
    kind = one.motion.kind if one.motion is not None else ""
    if kind == "slide" and nouns[one.noun].motion == "fly":
        return "runway"
    return _PLACE_OF_ACT.get(kind)


def _leaps(description: SceneDescription) -> bool:
    """As in "a dolphin jumps", "a whale blows": out of the water."""
    if any(one.kind == "fountain" for one in description.effects):
        return True
    return all(one.motion is not None and one.motion.kind == "jump" for one in description.objects)


def _floats_in_space(description: SceneDescription) -> bool:
    """As in "an astronaut floats"."""
    return any(
        one.noun == "astronaut" and one.motion is not None and one.motion.kind in _WEIGHTLESS
        for one in description.objects
    )


def _is_of_clouds(description: SceneDescription) -> bool:
    """As in "timelapse of clouds"."""
    return description.is_timelapse and {one.noun for one in description.objects} == {"cloud"}


def _fit_stated(
    description: SceneDescription,
    members: Sequence[Noun],
    nouns: Mapping[str, Noun],
    *,
    is_submerged: bool,
) -> str | None:
    """The place as stated; ground below sky, or water beside land, as its things need it."""
    place = description.surroundings.place
    names = {noun.name for noun in members}
    if place == "subway station" and names & _TRAINS and not names & PERSON_NOUNS:
        return "train station"
    has_pier = any(noun.name == _PIER for noun in members)
    if place == "sky" and _needs_ground(description, nouns, _ALOFT):
        usual = _choose_usual(members, rests=False, is_wet=False)
        return "grass" if usual in ENCLOSED or usual in _NO_GROUND else usual
    if place in ("sea", "lake", "river") and is_submerged:
        return "underwater"
    if has_pier and place in (None, "sea", BEACH):
        return "sea"
    ways = {(one.motion.shore, one.motion.kind) for one in description.objects if one.motion}
    goes_in = any(shore is not None and (shore, kind) != _AFLOAT for shore, kind in ways)
    at_sea = _AT_SEA | {kind for shore, kind in ways if (shore, kind) == _AFLOAT}
    if place == "sea" and (goes_in or _needs_ground(description, nouns, at_sea)):
        return BEACH
    return place


_TRAINS = frozenset({"train", "steam locomotive", "tram"})
"""What is too large for a hall: a station with one, and nobody on its tracks, is outdoors."""
_ON_SNOW = frozenset({"stand on skis", "ski", "snowboard", "ski trick", "snowboard trick"})


def with_snow(description: SceneDescription) -> SceneDescription:
    """As in "skis down a hill", "snowboards through a forest": snow lies there, unasked."""
    kinds = {one.motion.kind for one in description.objects if one.motion is not None}
    said = description.surroundings
    if not kinds & _ON_SNOW or said.place in (None, "snow", *ENCLOSED):
        return description
    return replace(description, surroundings=replace(said, has_snow=True))


def report_place(description: SceneDescription, place: str) -> SceneDescription:
    """The description with a note where the program chose the place."""
    is_snow_told = place == "snow" and description.surroundings.has_snow
    if description.surroundings.place is None and place != _UNREMARKABLE and not is_snow_told:
        article = "an" if place[0] in "aeiou" else "a"
        name = _NAMES.get(place, f"{article} {place}")
        note = f"no place is said: {name} is chosen"
        return replace(description, notes=(*description.notes, note))
    return description


_OF_BATHROOMS = frozenset({"toilet", "bathtub", "shower", "shower curtain", "wash stand"})
"""Nouns that tell whose sink it is."""


def _choose_usual(members: Sequence[Noun], *, rests: bool, is_wet: bool) -> str:
    if not members:
        return "grass"
    if {noun.habitat for noun in members} == {"water"}:
        return "sea"
    if any(noun.motion in _AFLOAT_MOTIONS for noun in members):
        return SHORE
    is_seen_through = any(noun.name == "window" for noun in members)
    is_outdoors = (is_wet and not is_seen_through) or any(
        noun.name in _OUTDOORS for noun in members
    )
    if _OF_BATHROOMS.intersection(noun.name for noun in members) and not is_outdoors:
        return "bathroom"
    for noun in members:
        usual = [place for place, found in _USUAL_PLACES.items() if noun.name in found]
        place = usual[0] if usual else noun.place
        is_on_ground = place in _NO_GROUND and any(one.habitat == "ground" for one in members)
        if place and not is_on_ground and not (is_outdoors and place in _INSIDE):
            return place
    flyers = [noun for noun in members if noun.name != "cloud"] or members
    if all(noun.habitat == "air" and noun.speed_m_s >= _FAST_FLYER_M_S for noun in flyers):
        return "grass" if rests else "sky"
    return "grass"
