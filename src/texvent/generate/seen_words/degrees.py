"""Words of degree, such as "long", "heavy" and "flickering": what in the picture measures each."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from texvent.generate.seen_words.light import LEAST_SKY, without
from texvent.generate.seen_words.lighting import sky_share
from texvent.generate.seen_words.picture import USUAL, VISIBLE, Picture
from texvent.generate.seen_words.things import copies_of, extent_of
from texvent.scenes.description import Claim, SceneDescription
from texvent.scenes.models.lamps import LAMPS
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.projection import project
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.surroundings.road import RoadLine

LONG = 5.0
"""Length of what is long, in its widths."""
LONG_ROW = 12
"""Things of a row that is long."""
SMALL_BY_DISTANCE = 0.25
"""Extent of what is far, as a share of the picture's width or height, at most."""
HEAVY, LIGHT = 0.03, 0.02
"""Share of the picture that heavy rain changes at least, and a drizzle at most."""
LEAST_BEND = 0.03
"""Way of a bending road from the straight line between its ends, in picture widths."""
FAST_HZ = 10.0
"""Rate above which a flicker is not told from one still to the next."""
BRIGHT = 0.75
"""Share of the levels of a lamp below the one that tells how bright it is."""
NEXT = 2
"""Words after an adjective among which its noun stands."""
GLOWING = 0.9
"""Level of the brightest point of a lamp that is lit."""
_ALL_VIEWS = range(9)
_BENDS = "at most one bend"
_ONLY_FALLS = "shown as rain or snow without wind"
_KIND = "not to be told from its usual kind"

Judge = Callable[[Picture, SceneDescription, Claim], "str | None"]


def judge_degree(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Why a word of degree is not seen, or None: also where another check measures it."""
    for reason, words in UNMEASURED.items():
        if claim.word in words and claim.aspect not in _OTHER_SENSES:
            return reason
    for judge, words in MEASURED_HERE.items():
        if claim.word in words and claim.aspect not in _OTHER_SENSES:
            return judge(picture, description, claim)
    return None


def _judge_long(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """A thing is much longer than wide; a row has many things in it."""
    for index in claim.things:
        bodies = [one for one in picture.scene.actors if one.object_index == index]
        noun = description.objects[index].noun
        if not bodies:
            return f"the {noun} is part of something else"
        if noun.endswith(" row"):
            return f"a short {noun}"
        model = bodies[0].model
        sides = sorted((model.length, model.width))
        is_long = sides[1] >= LONG * sides[0] and sides[1] >= model.height
        if (len(bodies) == 1 and not is_long) or 1 < len(bodies) < LONG_ROW:
            return f"{noun} not long"
    return None


def _judge_far(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """What is far is small in the picture."""
    near = [one for one in claim.things if extent_of(picture, one) > SMALL_BY_DISTANCE]
    return f"the {description.objects[near[0]].noun} is near" if near else None


def _judge_rain(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    kind = description.surroundings.weather
    if kind != claim.value or kind not in ("rain", "snow"):
        return None
    shares = [float(np.mean(picture.difference(without(kind, None), number) > VISIBLE))
              for number in USUAL]  # fmt: skip
    if claim.word == "drizzle":
        return "as usual rain" if max(shares) > LIGHT else None
    return "as usual rain" if max(shares) < HEAVY else None


_ON_VEHICLES = frozenset({"beacon", "hazard lights", "turn signal"})
_LAMP_POINTS = 8
"""Points of the picture that a lamp on a vehicle covers at least, where one sees it flash."""


def _judge_flicker(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """The light, the lamp that is named, or what it lights, is brighter from still to still.

    What flickers faster than stills can tell is seen by a sensor wherever the lamp is.
    """
    lamps = [description.objects[index] for index in claim.things]
    if lamps and not {lamp.noun for lamp in lamps} & set(LAMPS):
        return None  # an eye that blinks
    if any((lamp.blink_hz or 0.0) > FAST_HZ for lamp in lamps):
        return None
    if any(effect.kind in _ON_VEHICLES for effect in description.effects):
        white = [
            int((picture.colours(number).max(axis=1) >= GLOWING).sum()) for number in _ALL_VIEWS
        ]
        if np.ptp(white) >= _LAMP_POINTS:
            return None
    levels: list[float] = []
    whole: list[float] = []
    for number in _ALL_VIEWS:
        colours = picture.colours(number)
        whole.append(float(colours.mean()))
        where = np.ones(len(colours), dtype=np.bool_)
        if claim.things:
            own = [one for index in claim.things for one in copies_of(picture, index)]
            where = np.isin(picture.views[number].instance, own)
        levels += [float(np.quantile(colours[where], BRIGHT))] if where.any() else []
    change = max(np.ptp(levels), np.ptp(whole)) if levels else 0.0
    return None if change >= VISIBLE else "no change of light to be seen"


def _judge_glow(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """A lamp that is lit is the brightest there is: some of its points are about white."""
    if any(description.objects[index].noun in PERSON_NOUNS for index in claim.things):
        return None  # who shines shoes
    own = [one for index in claim.things for one in copies_of(picture, index)]
    for number in USUAL:
        where = np.isin(picture.views[number].instance, own)
        if where.any() and float(picture.colours(number)[where].max(axis=1).max()) >= GLOWING:
            return None
    return "not bright in the picture" if claim.things else None


def _judge_bend(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """The line of the road in the picture differs from a straight one, or does not."""
    is_done = any(description.objects[index].noun in PERSON_NOUNS for index in claim.things)
    if description.surroundings.road == "crossing" or is_done:
        return None  # who bends a bar is no road
    is_bent = max(_find_bend(picture, number) for number in USUAL) >= LEAST_BEND
    if claim.word == "straight":
        return "the road bends" if is_bent else None
    return None if is_bent else "no bend to be seen"


def _find_bend(picture: Picture, number: int) -> float:
    view = picture.views[number]
    ground = picture.scene.environment(view.time_s)
    offset = (float(ground.road_offset[0]), float(ground.road_offset[1]))
    line = RoadLine(ground.road_angle, offset, ground.road_curvature)
    spots = np.array([(*line.at(float(along))[:2], 0.0) for along in np.linspace(-60, 60, 61)])
    seen = project(view.camera, picture.size, spots)
    edge = np.array([picture.size.width, picture.size.height])
    inside = (seen[:, 2] > 0.5) & np.all((seen[:, :2] >= 0) & (seen[:, :2] < edge), axis=1)
    if inside.sum() < 3:
        return 0.0
    return _greatest_sag(seen[inside, :2]) / picture.size.width


def _greatest_sag(spots: Float64Array) -> float:
    """Greatest distance of points from the line through the first and the last one."""
    chord = spots[-1] - spots[0]
    length = max(float(np.linalg.norm(chord)), 1e-9)
    away = spots - spots[0]
    return float(np.abs(away[:, 0] * chord[1] - away[:, 1] * chord[0]).max()) / length


def _judge_wind(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Wind is seen by what it moves."""
    is_blown = any(
        one.noun in _BLOWN or (one.motion is not None and one.motion.kind in _SWAYING)
        for one in description.objects
    )
    return None if is_blown or picture.scene.particles.kinds else "nothing is blown"


def _judge_empty(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Only a place is said to be empty as a whole: a glass or a chair may not be.

    A street or a night is empty where nobody goes or drives.
    """
    of = {one.aspect for one in claims_after(claim, description)}
    is_place = not claim.things and bool(of & {"place", "light"})
    goers = [one for one in picture.scene.actors if one.noun.motion not in ("stand", "sway")]
    is_left = is_place and not goers
    return None if description.surroundings.is_empty or is_left else "not to be told"


def claims_after(claim: Claim, description: SceneDescription) -> list[Claim]:
    """Words that stand at most `NEXT` words after an adjective: what it says something of."""
    after = description.prompt.casefold().replace("-", " ").partition(claim.word)[2].split()
    near = {one.strip(".,;") for one in after[:NEXT]}
    return [one for one in description.claims if near & {*one.word.split()}]


def _judge_sky(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """What is said of the sky needs a sky."""
    return None if sky_share(picture) >= LEAST_SKY else "no sky in view"


_BLOWN = frozenset({"flag", "kite", "windmill", "wind turbine", "pinwheel", "weather vane", "leaf",
                    "banner", "sail", "sailboat", "curtain", "windsock"})  # fmt: skip
_SWAYING = ("sway", "wave", "drift", "flutter")
_OTHER_SENSES = frozenset({"framing", "view", "name", "place", "colour"})
"""Aspects in which these words say something else: "a long shot", "pale blue"."""
MEASURED_HERE: Mapping[Judge, tuple[str, ...]] = {
    _judge_long: ("long",),
    _judge_far: ("far away", "distant", "in the distance"),
    _judge_rain: ("heavy rain", "downpour", "drizzle"),
    _judge_flicker: ("flickering", "flickers", "flicker", "flickered", "flashing", "blinking"),
    _judge_glow: ("glowing", "lit", "burning", "shining"),
    _judge_bend: ("curved", "curvy", "bending", "straight"),
    _judge_empty: ("empty",),
    _judge_wind: ("wind", "winds", "breeze", "gust", "gusts"),
    _judge_sky: ("overcast sky", "under an overcast sky", "cloudy", "cloudy sky", "clear sky",
                 "clear skies", "cloudless", "partly cloudy"),
}  # fmt: skip
"""What measures a word of degree → the words."""
UNMEASURED: Mapping[str, tuple[str, ...]] = {
    "how much is not told": ("slightly", "deep", "pale", "light", "vivid"),
    _BENDS: ("winding", "twisting"),
    _ONLY_FALLS: ("storm", "stormy", "rainstorm", "blizzard", "snowstorm"),
    _KIND: ("toy", "baby", "young"),
}  # fmt: skip
"""Why a word of degree is never shown → the words; with a colour, a shade is part of its name."""
