"""Whether what words say of things is seen: colour, size, material, parts, side, number."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.generate.seen_words.colours import share_like
from texvent.generate.seen_words.materials import judge_material
from texvent.generate.seen_words.picture import USUAL, Picture, View, lies_around
from texvent.generate.seen_words.positions import judge_depth, judge_together, lies_by_itself
from texvent.scenes.description import Claim, NamedColour, SceneDescription
from texvent.scenes.evidence import MOST_COUNTED, is_exact_count, is_to_move
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.vocabulary.acts import WEARABLE
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.projection import project
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import ACTS

LEAST_COLOURED, LEAST_DRESSED = 0.25, 0.12
"""Share of a thing's pixels that have the colour that is said of it; of a person's, who is dressed
in it."""
_FRAMES = ("bicycle", "motorcycle")
"""What has its colour on its frame or tank alone: most of it are wheels."""
BUILDING_M, MOST_WALL = 4.0, 0.8
"""Height from which on a thing is told by its edges, and share of the picture that it may cover."""
LEAST_WORN = 0.08
"""The same for what another wears or holds, whose pixels are counted with the wearer's."""
LEAST_DETAIL = 0.14
"""Share of the picture's width or height below which a thing's parts are not told."""
LEAST_TEXTURED = 0.18
"""The same for its material."""
MOST_SHARED = 0.25
"""Share of a copy's box in the picture that another may cover while they are told apart."""
LEAST_NAMED, LEAST_NAMED_SHARE = 0.12, 0.012
"""Extent of a single thing, as a share of the picture's width or height, and share of the picture
that it covers, below which strangers do not name it while it rests."""
LEAST_OUTLINE = 0.07
"""Difference from its surroundings, and within it, that a thing is told by, as a share of white."""
LARGE_ANIMAL = 0.3
"""Share of the picture's width or height below which an animal is told by its outline alone."""
PATTERN_SIZE = 0.2
"""Share of the picture's width or height below which no stripes are told."""
TALLER = 1.12
"""Height of who is tall, in heights of another."""
_PATTERNED = frozenset({"zebra", "tiger", "leopard"})
_ANIMALS = frozenset(name for name, one in NOUNS.items() if is_living(one) and not is_person(one))
_ONE_SIDED = frozenset(
    {"headlight", "headlights", "tail light", "tail lights", "windscreen", "windshield", "face",
     "door", "rack", "roof rack", "neck", "trunk"}
)  # fmt: skip
"""Parts that are seen from some sides only."""
_SIDES = {"left": (0.0, 0.48), "right": (0.52, 1.0), "centre": (0.3, 0.7)}
"""Side → least and greatest place of its middle, in picture widths."""
MOST_BENT = 0.12
"""Spread of a row across it, as a share of that along it."""
_GIGANTIC = frozenset({"giant", "gigantic", "enormous", "colossal", "towering"})
_HIGH = frozenset({"tree", "pine", "palm", "house", "building", "skyscraper"})
_GIANT_M, _LEAST_TREE = 6.0, 0.02
"""Height of a giant among trees and houses, and share of the picture that these cover."""
_GARMENTS = frozenset({"coat", "jacket", "sweater"})
_AT_FRONT = frozenset({"apron", "tie", "bow tie", "bib", "necklace", "medal"})
"""What is worn before the chest."""
FRONT_COSINE, LEAST_FRONT_VIEWS = 0.5, 3
"""Cosine between a heading and the way to the camera of who is seen from the front; views."""
SIDE_COSINE = -0.1
"""The same from which on lamps of an end are seen: from the side, as glow."""
_LAMP_ENDS = {"headlight": 1.0, "tail light": -1.0, "taillight": -1.0, "brake light": -1.0}
_OPAQUE = frozenset({"glass", "crystal", "ice"})


def judge_thing(
    picture: Picture, description: SceneDescription, claim: Claim, index: int
) -> str | None:
    """Why what a word says of an object is not seen, or None."""
    if claim.aspect == "name":
        fault = _judge_garment(picture, description, index) or _judge_tool(description, index)
        return fault or _judge_small(picture, description, index)
    if claim.aspect == "colour":
        return _judge_colour(picture, description, index)
    if claim.aspect in ("size", "material") and _is_substituted(description, index):
        return "is something else"
    if claim.aspect == "size":
        return _judge_size(picture, description, claim.word, index)
    if claim.aspect == "material":
        return _judge_material(picture, description, claim.word, index)
    if claim.aspect == "part":
        return _judge_part(picture, description, claim, index)
    if claim.aspect == "side":
        return _judge_side(picture, description, index)
    if claim.aspect == "count":
        order = _judge_order(picture, claim.word, index)
        return order or _judge_count(picture, description, claim, index)
    return None


def _is_substituted(description: SceneDescription, index: int) -> bool:
    """Whether something of another kind is shown for the word that names it."""
    names = {one.word for one in description.claims if one.aspect == "name" and index in one.things}
    return any(one.said in names and one.shown not in one.said for one in description.substituted)


def _judge_garment(picture: Picture, description: SceneDescription, index: int) -> str | None:
    """A coat that is worn colours the upper body, as a shirt does; an apron is seen from before."""
    noun = description.objects[index].noun
    bearers = () if copies_of(picture, index) else _bearers(picture, description, index)
    if noun in _GARMENTS and bearers:
        return "is shown as a shirt"
    if noun == "hoodie" and bearers:
        return "without a hood"
    if noun in WEARABLE and not bearers and lies_by_itself(picture, description, index):
        return "worn by nobody"
    if noun not in _AT_FRONT:
        return None
    wearers = [one for one in picture.scene.actors if one.instance in bearers]
    seen = [sum(_is_from_front(one, view) for view in picture.views) for one in wearers]
    return "seen from the side" if seen and max(seen) < LEAST_FRONT_VIEWS else None


def _judge_tool(description: SceneDescription, index: int) -> str | None:
    """Who types does so on a laptop."""
    motions = [one.motion.kind for one in description.objects if one.motion is not None]
    is_part = description.objects[index].noun == "keyboard" and "type" in motions
    return "is a laptop's" if is_part else None


def _judge_small(picture: Picture, description: SceneDescription, index: int) -> str | None:
    """One thing that rests is told by its shape, of which a small one has too little."""
    copies = copies_of(picture, index)
    said = description.objects[index].motion
    is_going = is_to_move(index, description) and said is not None and said.kind != "work"
    if len(copies) != 1 or is_going:
        return None
    if any(one.kind in ACTS and index in one.targets for one in description.relations):
        return None  # what is kicked is told by the kick
    shares = [float((view.instance == copies[0]).mean()) for view in picture.views]
    is_small = extent_of(picture, index) < LEAST_NAMED and max(shares) < LEAST_NAMED_SHARE
    return "too small" if is_small else None


def _is_from_front(actor: Actor, view: View) -> bool:
    yaw = actor.trajectory.at(view.time_s).yaw
    x, y = (np.asarray(view.camera.position) - actor.middle(view.time_s))[:2]
    return bool(x * np.cos(yaw) + y * np.sin(yaw) >= FRONT_COSINE * np.hypot(x, y))


def _judge_order(picture: Picture, word: str, index: int) -> str | None:
    """A row must be straight; nothing is piled."""
    names = set(word.split())
    if names & {"pile", "stack", "heap"}:
        return "not on top of each other"
    if not names & {"row", "rows", "line"}:
        return None
    at = [one.trajectory.at(0.0).position[:2] for one in picture.scene.actors
          if one.object_index == index]  # fmt: skip
    if len(at) < 3:
        return None
    spread = np.linalg.svd(np.array(at) - np.mean(at, axis=0), compute_uv=False)
    return None if spread[1] <= MOST_BENT * spread[0] else "not in a row"


def copies_of(picture: Picture, index: int) -> list[int]:
    """Instances of an object."""
    return [one for one, of in picture.scene.object_of.items() if of == index]


def _judge_colour(picture: Picture, description: SceneDescription, index: int) -> str | None:
    named = description.objects[index].colour
    copies = copies_of(picture, index)
    least = LEAST_COLOURED
    if not copies:
        copies, least = _bearers(picture, description, index), LEAST_WORN
    if named is None or not copies:
        return "not of that colour"
    if any(is_person(one.noun) for one in picture.scene.actors if one.object_index == index):
        least = LEAST_DRESSED
    if description.objects[index].noun.split()[-1] in _FRAMES:
        least = LEAST_DRESSED
    for one in copies:
        best = max(_coloured_share(picture, number, one, named) for number in USUAL)
        if 0.0 <= best < least:
            return f"not {named.name} in the picture"
    return None


def _coloured_share(picture: Picture, number: int, instance: int, named: NamedColour) -> float:
    own = picture.views[number].instance == instance
    if not own.any():
        return -1.0
    return share_like(picture.colours(number)[own], named.rgb)


def _bearers(picture: Picture, description: SceneDescription, index: int) -> list[int]:
    """Instances of those who wear or hold an object that is a part of their model."""
    subjects = [one.subject for one in description.relations if index in one.targets]
    return [copy for subject in subjects for copy in copies_of(picture, subject)]


def _judge_size(
    picture: Picture, description: SceneDescription, word: str, index: int
) -> str | None:
    """A size is told beside another thing, which must be as much larger or smaller."""
    own = next((one for one in picture.scene.actors if one.object_index == index), None)
    if own is None:
        return "nothing to tell its size by"
    if word == "long":
        return None  # `degrees` measures it
    if word in ("tall", "high", "short"):
        return _judge_tall(picture, word, index)
    is_large = description.objects[index].scale > 1.0
    if word in _GIGANTIC and own.noun.motion in ("walk", "run") and own.model.height < _GIANT_M:
        higher = sorted(picture.seen_nouns(_LEAST_TREE) & _HIGH)
        if higher:
            return f"lower than a {higher[0]}"
    fault = "nothing to tell its size by"
    for other in picture.scene.actors:
        if other.object_index == index or not _is_seen(picture, other.instance):
            continue
        ratio = own.size_m / max(other.size_m, 1e-9)
        if (ratio > 1.0) != is_large or max(ratio, 1.0 / ratio) <= 1.3:
            continue
        seen = extent_of(picture, index) / max(extent_of(picture, other.object_index), 1e-9)
        if (seen > 1.0) == is_large:
            return None
        fault = "looks larger than it is" if seen > 1.0 else "looks smaller than it is"
    return fault


def _judge_tall(picture: Picture, word: str, index: int) -> str | None:
    """Things are tall by their shape, people and animals beside a lower one of their kind."""
    own = next(one for one in picture.scene.actors if one.object_index == index)
    height, across = own.model.height, max(own.model.length, own.model.width)
    if own.noun.motion not in ("walk", "run"):
        if not (height >= 1.6 * across and height >= 1.8) or word == "short":
            return f"not {word}"
        return None if _has_top_in_view(picture, own) else "with its top out of view"
    ratios = [height / one.model.height for one in picture.scene.actors
              if one.noun.motion == own.noun.motion]  # fmt: skip
    if word == "short":
        ratios = [1.0 / one for one in ratios]
    return None if max(ratios) >= TALLER else "nothing to tell its size by"


def _has_top_in_view(picture: Picture, own: Actor) -> bool:
    """Whether its upper edge is in the picture at some instant."""
    for view in picture.views:
        seen = project(view.camera, picture.size, own.corners(view.time_s))
        if np.all(seen[:, 2] > 0.0) and seen[:, 1].min() >= 0.0:
            return True
    return False


def _is_seen(picture: Picture, instance: int) -> bool:
    return any((picture.views[number].instance == instance).any() for number in USUAL)


def _judge_material(
    picture: Picture, description: SceneDescription, word: str, index: int
) -> str | None:
    if word in _OPAQUE:
        return "not clear to look through"
    if extent_of(picture, index) < LEAST_TEXTURED:
        return "too small to tell"
    has_colour = description.objects[index].colour is not None
    return judge_material(picture, word, copies_of(picture, index), has_colour=has_colour)


def _judge_part(
    picture: Picture, description: SceneDescription, claim: Claim, index: int
) -> str | None:
    if any(effect.source == index for effect in description.effects) and claim.motion is None:
        return "not told apart"
    is_lit = "light" in claim.word and description.light.kind in ("night", "moonlight", "dusk")
    if claim.word in _ONE_SIDED and not is_lit:
        return "not told apart"
    ends = {one: end for one, end in _LAMP_ENDS.items() if one in claim.word}
    if ends and not _is_end_seen(picture, index, next(iter(ends.values()))):
        return "on the side away from the camera"
    return None if extent_of(picture, index) >= LEAST_DETAIL else "too small to tell"


def _is_end_seen(picture: Picture, index: int, end: float) -> bool:
    """Whether the front (1) or the back (-1) of one of its copies is turned to the camera."""
    for actor in picture.scene.actors:
        if actor.object_index != index:
            continue
        for view in picture.views:
            yaw = actor.trajectory.at(view.time_s).yaw
            x, y = (np.asarray(view.camera.position) - actor.middle(view.time_s))[:2]
            if end * (x * np.cos(yaw) + y * np.sin(yaw)) > SIDE_COSINE * np.hypot(x, y):
                return True
    return not copies_of(picture, index)


def judge_outline(picture: Picture, instance: int) -> str | None:
    """Why a thing that is in view is not recognised: lost in the dark or the fog, or None."""
    if _is_cut_all_around(picture, instance):
        return "cut off"
    noun = picture.scene.class_names.get(instance, "")
    is_animal = noun in _ANIMALS - _PATTERNED
    size, contrast = 0.0, -1.0
    edge = np.array([picture.size.width, picture.size.height])
    for number in USUAL:
        view = picture.views[number]
        box = _box(picture, view, [instance])
        if box is None:
            continue
        size = max(size, float(((box[1] - box[0]) / edge).max()))
        own = view.instance == instance
        colours = picture.colours(number)
        inside, outside = colours[own], colours[lies_around(picture, own)]
        if len(outside):
            between = float(np.abs(inside.mean(axis=0) - outside.mean(axis=0)).max())
            is_plain = is_animal and size < LARGE_ANIMAL
            within = 0.0 if is_plain else float(inside.std(axis=0).max())
            contrast = max(contrast, between, within)
    if 0.0 <= contrast < LEAST_OUTLINE:
        return "not told from what is around it"
    return "too small" if noun in _PATTERNED and 0.0 < size < PATTERN_SIZE else None


def _is_cut_all_around(picture: Picture, instance: int) -> bool:
    """Whether a building is a wall that fills the picture all the time."""
    own = next((one for one in picture.scene.actors if one.instance == instance), None)
    if own is None or own.noun.habitat != "fixed" or own.model.height < BUILDING_M:
        return False
    return min(float(np.mean(view.instance == instance)) for view in picture.views) > MOST_WALL


def extent_of(picture: Picture, index: int) -> float:
    """Greatest extent of an object's copies, as a share of the picture's width or height."""
    copies = copies_of(picture, index)
    edge = np.array([picture.size.width, picture.size.height])
    best = 0.0
    for view in picture.views:
        box = _box(picture, view, copies)
        if box is not None:
            best = max(best, float(((box[1] - box[0]) / edge).max()))
    return best if copies else 1.0


def _box(picture: Picture, view: View, instances: Sequence[int]) -> Float64Array | None:
    """[2, 2] lowest and highest x and y of what is seen of instances; None = nothing."""
    own = np.isin(view.instance, instances)
    if not own.any():
        return None
    at = picture.points[own]
    return np.array([at.min(axis=0), at.max(axis=0)])


def _judge_side(picture: Picture, description: SceneDescription, index: int) -> str | None:
    side = description.objects[index].side
    if side in ("far", "near"):
        return judge_depth(picture, index, is_far=side == "far")
    centres = [
        float(box.mean(axis=0)[0]) / picture.size.width
        for view in picture.views
        if (box := _box(picture, view, copies_of(picture, index))) is not None
    ]
    if side == "row":
        return _judge_order(picture, "row", index)
    if side == "together":
        return judge_together(picture, index)
    if not centres or side not in _SIDES:
        return None
    middle = float(np.median(centres))
    low, high = _SIDES[side]
    return None if low <= middle <= high else f"not in the picture's {side}"


def _judge_count(
    picture: Picture, description: SceneDescription, claim: Claim, index: int
) -> str | None:
    """Copies that are counted one by one must be seen apart, at one instant at least."""
    copies = copies_of(picture, index)
    is_few = is_exact_count(claim) and 1 < len(copies) <= MOST_COUNTED
    if not is_few or description.objects[index].count != len(copies):
        return None
    for view in picture.views:
        boxes = [_box(picture, view, [one]) for one in copies]
        if all(box is not None for box in boxes) and _are_apart(
            [box for box in boxes if box is not None]
        ):
            return None
    return "overlap in the picture"


def _are_apart(boxes: Sequence[Float64Array]) -> bool:
    for number, one in enumerate(boxes):
        for other in boxes[:number]:
            common = np.minimum(one[1], other[1]) - np.maximum(one[0], other[0])
            areas = [float(np.prod(np.maximum(box[1] - box[0], 1.0))) for box in (one, other)]
            if (common > 0.0).all() and float(np.prod(common)) > MOST_SHARED * min(areas):
                return False
    return True
