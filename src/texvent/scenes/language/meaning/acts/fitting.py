"""Verbs of several senses: the one that fits who does it and where, or none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import Effect, ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.capabilities import can_do, is_hand, is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.vocabulary.acts import BOARDS, WEARABLE
from texvent.scenes.language.vocabulary.motion import WINDS
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import VerbForm
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.machine_acts import COLLAPSE, HANG, PULSE
from texvent.scenes.models.protocol import Noun

_PULSING = frozenset({"beat", "pulse", "throb", "pulsate"})
PAW = "paw"
SEEN_AS_SAID = frozenset({*_PULSING, "flap", "taxi", "dig"})
"""Verbs whose fitting motion is just what they say: what flaps its wings stays where it is."""
_ON_GROUND = ("drive", "walk", "run", "jump")
_STEPS = ("climb", "ascend", "descend")
_HELD_ON_TO = frozenset({"ladder", "wall", "tree", "rope", "pole", "fence", "cliff", "mast"})
"""What is climbed with hands and feet."""
_STAIRS = frozenset({"stair", "stairs", "staircase", "stairway"})
_WAY = {"descend": "down"}
DOLLS = frozenset({"toy robot", "doll", "teddy bear"})
"""Figures without joints, which slide where they walk."""
UNSEATED = DOLLS | WEARABLE
"""Things that do not sit where they are, as a vase does."""
_TOPPLING = frozenset({"domino", "bowling pin"})
"""What falls over where it stands."""
_BLOWN = frozenset({"move", "stir", "blow", "dance", "shake"})
_BY_ITSELF = ("rise", "sink", "land")
_OUT_OF = ("into", "in", "from", "off", "through", "under", "towards", "toward")


def fit_verb(verb: Verb, noun: Noun, clause: Clause) -> Verb | None:
    """The verb as this thing does it; None if what the verb means is not shown.

    A climber of a ladder climbs and a toy robot that walks slides; a rover that climbs a slope
    drives; a man who rises does not take off, a keeper who dives does not swim, a batter who swings
    at a ball hangs on no rope, and a plane that taxis stays on the ground.
    """
    if verb.base in _BLOWN and noun.habitat == "fixed" and _is_windy(clause):
        return replace(verb, kind="sway")
    other = _choose_manoeuvre(verb, noun, clause) or _choose_own(verb, noun)
    other = other or _choose_kind(verb, noun, clause)
    other = other or _choose_other(verb, noun)
    if other is not None:
        return other
    prepositions = {phrase.preposition.text for phrase in clause.phrases}
    is_on_ground = noun.motion in _ON_GROUND and noun.habitat == "ground"
    if is_on_ground and verb.base in _BY_ITSELF:
        return None
    if verb.base == "crawl" and noun.motion == "fly":
        return None
    if is_on_ground and verb.base == "dive" and not prepositions & set(_OUT_OF):
        return None
    if is_living(noun) and verb.base == "swing" and "at" in prepositions:
        return None
    if is_person(noun) and verb.base == "slip":
        return None
    return verb


def hang_up(draft: Draft, clause: Clause, subjects: Sequence[int], targets: Sequence[int]) -> bool:
    """As in "a lamp hangs from the ceiling": on a cord, below a piece of it."""
    del targets
    found = [
        phrase
        for phrase in clause.phrases
        if phrase.preposition.text in ("from", "on", "under", "below")
        and any(one.head is not None and one.head.lemma == "ceiling" for one in phrase.groups)
    ]
    things = [n for n in subjects if not is_living(draft.noun(n))]
    if not found or clause.verb_word.lemma not in _HANGING or things != list(subjects):
        return False
    for index in things:
        item = draft.objects[index]
        item.noun = _HUNG.get(item.noun, item.noun)
        item.motions = [ObjectMotion(HANG)]
    clause.verb_word.is_used = bool(things)
    for phrase in found:
        mark_used([phrase.preposition, *(one for group in phrase.groups for one in group.words)])
        clause.phrases.remove(phrase)
    return bool(things)


_HANGING = frozenset({"hang", "dangle", "suspend", "be"})
_HUNG = {"lamp": "pendant lamp", "desk lamp": "pendant lamp", "fan": "ceiling fan"}
"""What hangs in place of what stands."""


def _choose_own(verb: Verb, noun: Noun) -> Verb | None:
    """As in "a bird flaps", "a heart beats", "a dog digs", "a plane taxis": just what is said."""
    if verb.base in ("flap", "beat") and noun.motion == "fly" and is_living(noun):
        return replace(verb, kind="hover")
    if verb.base in _PULSING and not noun.is_working:
        kind = "hover" if noun.motion == "swim" and is_living(noun) else PULSE
        return None if is_living(noun) and kind == PULSE else replace(verb, kind=kind)
    if verb.base == "dig" and PAW in noun.acts:
        return replace(verb, kind=PAW)
    if verb.base == "taxi" and noun.motion == "fly":
        return replace(verb, kind="slide")
    return None


def has_phrase(clause: Clause, preposition: str) -> bool:
    """Whether a preposition leads a phrase of the clause."""
    return any(phrase.preposition.text == preposition for phrase in clause.phrases)


def throw_up_earth(draft: Draft, kind: str, verb: Verb, index: int) -> None:
    """What digs with its paws throws up earth."""
    if kind == PAW and verb.base == "dig":
        draft.effects.append(Effect("dust", index))


def _choose_kind(verb: Verb, noun: Noun, clause: Clause) -> Verb | None:
    """The verb with the motion by which this thing does it; None if that is the usual one."""
    objects = {group.head.lemma for group in clause.objects if group.head is not None}
    is_on_ground = noun.motion in _ON_GROUND and noun.habitat == "ground"
    if _climbs(verb, noun, objects):
        return replace(verb, kind="climb", pace=1.0, direction=_WAY.get(verb.base))
    if noun.name in _TOPPLING and verb.kind == "fall":
        return replace(verb, kind="topple")
    if noun.name in DOLLS and verb.kind in ("walk", "run"):
        return replace(verb, kind="slide", pace=0.5 * verb.pace)
    if verb.base in _STEPS and (is_on_ground or noun.motion == "roll"):
        return replace(verb, kind="move")
    if verb.base in ("chase", "pursue") and not is_living(noun):
        return replace(verb, kind="move")
    if (
        verb.base == "roll"
        and is_living(noun)
        and "down" not in {one.preposition.text for one in clause.phrases}
    ):
        return replace(verb, kind="roll over")
    if verb.base == "roll over" and not is_living(noun):
        return replace(verb, kind="roll")
    if verb.base == "roll" and noun.motion in ("sail", "paddle"):
        return replace(verb, kind="sway")
    return None


def _choose_other(verb: Verb, noun: Noun) -> Verb | None:
    """As in "a radio sits on a shelf", "a fan runs", "a kayaker paddles", "a robot weaves"."""
    if verb.base in ("paddle", "row") and is_person(noun) and noun.name != "surfer":
        return replace(verb, kind="row", pace=1.0)
    if verb.kind == "sit" and not is_living(noun):
        return replace(verb, kind="stand")
    if verb.base == "run" and noun.is_working:
        return replace(verb, kind="work")
    if verb.kind in ("zigzag", "run") and noun.motion == "roll":
        return replace(verb, kind="move")
    if verb.kind == "drive" and noun.name in WHEELED:
        return replace(verb, kind="move")
    return None


WHEELED = frozenset({"mobile robot", "robot vacuum", "toy car", "toy train", "wheelchair"})
"""What rolls on wheels of its own and is no vehicle of roads."""


def _climbs(verb: Verb, noun: Noun, objects: set[str]) -> bool:
    """Whether it goes up or down a ladder, a tree, stairs ... with hands or feet."""
    if is_person(noun) and verb.base in _STEPS and objects & _STAIRS:
        return True
    is_able = is_person(noun) or (is_living(noun) and noun.motion in ("walk", "run"))
    return verb.base == "climb" and is_able and bool(objects & _HELD_ON_TO)


def fall_over(noun: Noun, motion: ObjectMotion, clause: Clause) -> ObjectMotion:
    """As in "a person falls": over, unless it is said from where; who bounces jumps."""
    is_from = any(phrase.preposition.text in _FROM_ABOVE for phrase in clause.phrases)
    is_from |= any(word.meaning.value == "sky" for word in clause.adverbs)
    if motion.kind == "bounce" and is_living(noun) and noun.habitat == "ground":
        return replace(motion, kind="jump")
    stands = (is_living(noun) and noun.habitat == "ground") or noun.name in _STANDING
    if motion.kind == "fall" and stands and not is_from:
        return replace(motion, kind="fall over" if is_person(noun) else "topple")
    return motion


def note_untouched(
    draft: Draft, clause: Clause, subjects: Sequence[int], targets: Sequence[int]
) -> None:
    """As in "a crane lifts a box", "a board tilted by hand": the box rises beside the crane."""
    if subjects:
        clause.verb_word.shown_as = f"{draft.noun(targets[0]).name} untouched"


_STANDING = frozenset(
    {"bicycle", "motorcycle", "scooter", "tree", "pine", "palm", "bare tree", "autumn tree",
     "cherry tree", "christmas tree", "ladder", "chair", "stool", "bookshelf", "wardrobe",
     "street lamp", "park lamp", "traffic light", "sign", "stop sign", "fence", "statue",
     "scarecrow", "easel", "tripod", "column", "broom", "refrigerator", "snowman",
     "cactus", "coat rack", "traffic cone", "shopping cart", "sunflower"}
)  # fmt: skip
"""What falls over where it stands, besides people and animals."""
_FROM_ABOVE = ("from", "off", "out of", "into", "through", "down")
MANOEUVRES = frozenset({"park", "drift", COLLAPSE})
"""Motions of vehicles and piles that are what the verb says of them."""


def _choose_manoeuvre(verb: Verb, noun: Noun, clause: Clause) -> Verb | None:
    """As in "a car parks", which drives there first, "drifts", "skids"; "a tower falls"."""
    if COLLAPSE in noun.acts and verb.kind in ("fall", "topple", "roll"):
        return replace(verb, kind=COLLAPSE, pace=1.0)
    if verb.base == "drift" and noun.motion in ("walk", "run"):
        return replace(verb, kind="slide")
    is_parked = clause.verb is not None and clause.verb.meaning.form is VerbForm.PAST
    if noun.motion != "drive" or noun.habitat != "ground":
        return None
    if verb.base == "park" and not is_parked:
        return replace(verb, kind="park")
    if verb.base in ("drift", "skid"):
        return replace(verb, kind="drift", pace=1.0)
    return None


_OF_TENNIS = frozenset(
    {"tennis racket", "tennis ball", "badminton racket", "shuttlecock", "ping-pong paddle", "net"}
)
_RACKET_SPORTS = frozenset({"tennis", "badminton", "squash"})


def is_played(kind: str, clause: Clause, draft: Draft) -> bool:
    """Whether a racket is near where one is swung: a waiter who serves has none."""
    said = {part for group in clause.subjects for part in group.text.split()}
    named = {item.noun for item in draft.objects}
    return kind not in ("swing racket", "serve") or bool(
        said & _RACKET_SPORTS or named & _OF_TENNIS
    )


_ACTED_BY_ANYTHING = frozenset({"push", "pull", "carry"})
"""What a vehicle or a machine does to another object."""
_ACTED_BY_LIVING = frozenset({"hold", "carry", "push", "pull", "kick", "hit", "throw", "catch"})
_FLOWN = frozenset({"airplane", "helicopter"})
"""What is flown from within."""
_RIDEABLE = frozenset({"drive", "sail"})


CARRIERS = frozenset(
    {"forklift", "pickup", "golf cart", "stroller", "shopping cart", "wheelbarrow"}
)
"""What moves a load by taking it along."""
_CARRIED_M = 0.6
"""Longest thing that a person who moves it carries; what is longer is pushed."""


_THROUGH = {"enter": ("towards", "go to it"), "exit": ("from", "go away from it"),
            "leave": ("from", "go away from it")}  # fmt: skip
"""Verb → relation to what is entered or left, and what is seen of it."""
_ENTERED = frozenset({"tunnel", "gate", "arch"})
"""Into what one is seen to go."""
_ENTERED_M = 1.5
"""Least length of what one may enter or leave."""


def fit_moving(verb: Verb, pair: tuple[Noun, Noun], target_m: float, word: Word) -> Verb | None:
    """The verb, where it moves a thing or leads into or out of it; None if this one cannot.

    A forklift takes it along; a crane or a robot arm that moves something is not shown. Who enters
    a house goes to it.
    """
    doer, target = pair
    if verb.base in _THROUGH and target.name in _ENTERED:
        relation, way = ("in", "into") if verb.base == "enter" else ("from", "out of")
        return replace(verb, kind="move", relation=relation, way=way)
    if verb.base in _THROUGH and target_m > _ENTERED_M:
        relation, word.shown_as = _THROUGH[verb.base]
        return replace(verb, kind="move", relation=relation)
    if verb.base == "move" and not is_person(doer) and doer.name not in CARRIERS:
        return None
    if verb.act == "carry" and doer.name in CARRIERS:
        return replace(verb, act=None, kind="move")
    return verb


_DRIVE = ("steer", "drive", "pilot")


def choose_act(verb: Verb, doer: Noun, target: Noun, target_m: float = 0.0) -> str | None:
    """What the verb means if this thing does it to that one; None if it cannot."""
    act = verb.act
    if verb.base == "move" and is_person(doer) and not is_living(target):
        return "carry" if target_m <= _CARRIED_M else "push"
    if act is None:
        return None
    if verb.base == "fly" and target.name in _FLOWN:
        return "ride" if is_living(doer) else None
    if verb.base == "fly" and target.habitat != "air":
        return None  # "flies off a branch"
    if act == "ride":
        is_mount = target.motion in _RIDEABLE or is_living(target) or target.name in BOARDS
        is_driven = verb.base in _DRIVE and is_living(target)  # a dog steers sheep
        return "ride" if is_living(doer) and is_mount and not is_driven else None
    if act == "wear":
        return "wear" if is_living(doer) and target.name in WEARABLE else None
    if act == "hit" and not (is_person(doer) or is_hand(doer)):
        return "collide"
    if is_living(doer) or is_hand(doer):
        return act if act in _ACTED_BY_LIVING else None
    return act if act in _ACTED_BY_ANYTHING else None


def fit_kind(verb: Verb, nouns: Sequence[Noun]) -> Verb:
    """The verb as things like these do it: what works does so in its place, a wheel spins."""
    is_working = any(noun.is_working for noun in nouns)
    is_by_itself = verb.kind in ("wave", "fly", "sway", "turn") and verb.base not in _UNSTEADY
    if is_by_itself and is_working:
        return replace(verb, kind="work")
    is_spun = all(not can_do(noun, "turn") and noun.name not in _LEAFED for noun in nouns)
    if verb.kind == "turn" and nouns and is_spun:
        return replace(verb, kind="spin", pace=0.5 * verb.pace)
    if verb.kind == "swim" and nouns and all(noun.habitat == "air" for noun in nouns):
        return replace(verb, kind="fly")
    if verb.kind == "fly" and nouns and all(noun.motion == "swim" for noun in nouns):
        return replace(verb, kind="swim")
    if verb.base == "glide" and not any(noun.habitat == "air" for noun in nouns):
        return replace(verb, kind="slide" if any(map(is_person, nouns)) else "move")
    return verb


_LEAFED = frozenset({"page", "book"})
"""What does not spin where it turns."""
_UNSTEADY = ("wobble", "rock", "tilt")
"""How the whole of a thing moves that works in its place: a top, a metronome."""


def is_plain_past(word: Word) -> bool:
    """Whether a past form stands for the present: "a man walked"; not for "a hoop held by"."""
    verb = word.meaning.value
    if word.meaning.form is not VerbForm.PAST or not isinstance(verb, Verb):
        return False
    return bool(verb.kind) and verb.act is None and verb.object_kind is None


def _is_windy(clause: Clause) -> bool:
    """As in "curtains move in the wind"."""
    groups = [group for phrase in clause.phrases for group in phrase.groups]
    return any(group.head is not None and group.head.text in WINDS for group in groups)
