"""Which sense a noun has beside its neighbours: "fountains of lava" are no fountains."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.language.grammar.syntax import NounGroup
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, mark_used


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_VESSELS = _words(
    """bowl cup mug glass bottle jar jug vase pot pan bucket basket box crate chest barrel bag sack
    handbag suitcase tray plate dish can tin carton urn kettle teapot aquarium cage tank pallet cart
    wheelbarrow trolley shelf bookshelf table drawer truck wagon bouquet bunch necklace card map
    salad soup sandwich cake bread pizza picture poster book newspaper page model"""
)
"""What holds the things that "of" names, or is made of them, and is itself there."""
_WATERS = _words("sea ocean river stream lake pond pool canal creek waterfall")
_SHAPES = _words(
    """fountain sea ocean river stream wall tower mountain hill island forest jungle storm shower
    column train curtain carpet blanket ring rain cloud jet bridge bed pyramid"""
)
_NATURAL = frozenset({"water", "sand", "snow", "ice", "dust", "grass"})
_SUBSTANCES = _words(
    "lava ash flame fire smoke steam light star spark ember dust mud blood foam magma"
)
"""What makes a shape before a noun of another kind: "a lava fountain", "an ash cloud"."""
_PARTS_OF = {
    "forest": _words("tree pine palm"), "jungle": _words("tree palm"),
    "wall": _words("brick rock"), "tower": _words("brick rock"),
}  # fmt: skip
"""Shape → things of which it is really made."""
_PARTS = frozenset({"trunk", "bow", "boot", "hood", "crown", "bark", "palm", "nail", "horn", "cap",
                    "head", "hand", "spring", "key", "drum", "crane", "mouse", "bat",
                    "frame", "body", "shell", "skeleton"})  # fmt: skip
"""What is a part of the thing that "of" names, and no thing by itself."""

_LIKE_PARTS = _words("face head back foot arm hand mouth leg eye neck nose tongue finger")
"""Parts of bodies that other things are said to have: "the foot of the hill"."""

_KIN = frozenset({"mother", "father", "parent", "brother", "sister", "friend"})
"""Whom an animal has too: "its mother" is no woman."""
RELATIVES = _KIN | _words(
    """mom mum dad son daughter wife husband grandmother grandfather grandma grandpa aunt uncle
    cousin twin partner opponent oponent teammate rival colleague classmate neighbour neighbor boss
    assistant coach student pupil child kid baby girlfriend boyfriend bride groom buddy"""
)
"""Whom one has: "her sister" is not the girl that was named."""


def is_figurative(group: NounGroup, preposition: str | None) -> bool:
    """Whether the head of a noun group is not there itself.

    "A stream of cars" is no stream, and "the trunk of a tree" no chest; a bowl of apples is a bowl.
    """
    head = group.head_word
    name = _name(head)
    if name in _SHAPES and any(
        word.pos is Pos.NOUN and _name(word) in _SUBSTANCES for word in group.modifiers[-1:]
    ):
        return True
    determiner = group.determiner.text if group.determiner is not None else ""
    is_of_ship = name == "bow" and determiner == "the" and preposition is not None
    if is_of_ship or (name in _KIN and determiner == "its"):
        return True
    for phrase in group.phrases:
        if phrase.preposition.text == "of" and phrase.groups:
            if name in _LIKE_PARTS and _is_unshown(phrase.groups[0].head):
                return True
            return _is_made_of(head, name, phrase.groups[0])
    return False


def _is_unshown(inner: Word | None) -> bool:
    """As in "the face of a wave": of nothing that has a body or is seen."""
    if inner is None or inner.pos is Pos.PRONOUN:
        return False
    return inner.read_as(Role.NOUN) is None and inner.role in (Role.UNKNOWN, Role.PLACE)


def _is_made_of(head: Word, name: str, content: NounGroup) -> bool:
    """Whether "X of Y" names something that only has the shape of X."""
    inner = content.head
    if inner is None or inner.role in (Role.PICTURE, Role.FUNCTION):
        return False
    if content.determiner is not None or content.owner is not None:
        return name in _PARTS
    said, thing = _name(inner), inner.read_as(Role.NOUN)
    is_really = thing is not None and thing.value in _PARTS_OF.get(name, ())
    if is_really or inner.written[:1].isupper() or inner.read_as(Role.MATERIAL) is not None:
        return False
    if head.read_as(Role.PLACE) is not None or head.role is Role.WEATHER:
        return name in _SHAPES | _WATERS and said not in _NATURAL
    is_vessel = head.read_as(Role.NOUN) is None or name in _VESSELS
    return not is_vessel and (name in _SHAPES | _PARTS or said in _SUBSTANCES)


def _name(word: Word) -> str:
    return word.lemma.split()[-1]


_BESIDE: dict[str, tuple[tuple[frozenset[str], str], ...]] = {
    "net": ((frozenset({"goal", "puck", "hockey stick", "football"}), "goal"),),
    "calf": tuple(
        (frozenset({one}), one) for one in ("elephant", "whale", "giraffe", "hippo", "rhino")
    ),
    "pup": ((frozenset({"seal"}), "seal"), (frozenset({"wolf"}), "wolf")),
    "cub": tuple((frozenset({one}), one) for one in ("lion", "tiger", "polar bear", "wolf", "fox")),
}
"""Word → things beside which it is another thing: the calf of an elephant is no cow."""


_DOERS: dict[str, tuple[frozenset[str], str]] = {
    "pitcher": (
        _words("throw pitch toss hurl wind wind up fling release deliver catch"),
        "baseball player",
    ),
    "fan": (_words("wave cheer clap sing jump celebrate shout chant watch scream sit"), "person"),
    "bowler": (_words("throw bowl run roll"), "cricketer"),
}
"""Word → verbs whose subject is a person of that name."""
_GLAZED = frozenset(
    {"window", "car", "bus", "truck", "taxi", "van", "train", "tram", "building", "door", "house",
     "aquarium", "shop window"}
)  # fmt: skip


def is_pane(group: NounGroup, draft: Draft, preposition: str | None = None) -> bool:
    """As in "rain on the glass of a car window", "a bus with a crack in the glass": no vessel."""
    head, determiner = group.head_word, group.determiner
    if head.text != "glass" or determiner is None or determiner.text not in ("the", "its"):
        return False
    inner = [one.head.lemma for phrase in group.phrases for one in phrase.groups if one.head]
    named = {item.noun for item in draft.objects}
    is_flat = preposition in ("down", "against", "across", "behind", "through")
    return "glass" not in named and (is_flat or bool(_GLAZED & {*inner, *named}))


_OTHERWISE_BESIDE: dict[str, frozenset[str]] = {
    "bow": _words("ship boat sailboat yacht ferry kayak canoe submarine"),
    "stern": _words("ship boat sailboat"),
    "net": _words("boat ship fish sailboat fisherman"),
}
"""Word → things beside which it is none of its usual sense: the bow of a ship shoots no arrows."""
_OF_VEHICLES = _words(
    """door seat hood bonnet trunk boot mirror engine bumper wheel window roof windshield windscreen
    horn deck cabin mast ladder"""
)
"""What "the doors", "its seats" mean beside a vehicle: parts of it, which stand nowhere else."""
_VEHICLE_MOTIONS = frozenset({"drive", "sail", "fly"})
_OF_FURNITURE = {"door": _words("refrigerator oven cupboard wardrobe microwave safe locker"),
                 "drawer": _words("desk dresser cabinet"),
                 "screen": frozenset({"tv", "laptop", "monitor", "computer", "tablet",
                                      "cell phone"})}  # fmt: skip
"""Part → things of which it is one, once they are named."""


def is_part_of_named(group: NounGroup, draft: Draft) -> bool:
    """As in "A black sedan stops. Its doors open": no doors by themselves."""
    head, determiner = group.head_word, group.determiner
    if determiner is None or determiner.text not in _KNOWN or _name(head) in _named(draft):
        return False
    inner = [one.head for phrase in group.phrases for one in phrase.groups if one.head]
    wholes = [draft.nouns[item.noun] for item in draft.objects]
    meanings = [one.read_as(Role.NOUN) for one in inner]
    models = [draft.nouns.get(str(one.value)) for one in meanings if one is not None]
    wholes += [one for one in models if one is not None]  # traffic is no one thing
    if inner and not any(meanings):
        return False
    is_of_vehicle = any(
        one.motion in _VEHICLE_MOTIONS and one.habitat != "air" and not is_living(one)
        for one in wholes
    )
    if head.lemma in _OF_VEHICLES and is_of_vehicle and not _has_rooms(draft):
        return True
    return any(one.name in _OF_FURNITURE.get(head.lemma, ()) for one in wholes)


def _named(draft: Draft) -> set[str]:
    return {item.noun for item in draft.objects}


def _has_rooms(draft: Draft) -> bool:
    """Whether a house is there too, which has doors and windows."""
    return bool(_named(draft) & {"house", "building", "garage", "shop"})


_KNOWN = ("the", "its", "their", "his", "her")
_OF_GROUND = frozenset({"stones", "cobbles", "pebbles", "tiles", "boards"})
"""Bare plurals with "the" that name what one walks on."""


def is_other_sense(group: NounGroup, draft: Draft, preposition: str | None) -> bool:
    """As in "curls of wood", "a fisherman casts a net": not what the word usually names."""
    head, determiner = group.head_word, group.determiner
    if head.text in ("wood", "streams") and determiner is None:
        return True
    if head.written == "Earth":
        return True
    named = {item.noun for item in draft.objects} | {item.said for item in draft.objects}
    if named & _OTHERWISE_BESIDE.get(head.lemma, frozenset()):
        return True
    is_known = determiner is not None and determiner.text == "the"
    return head.text in _OF_GROUND and is_known and preposition in ("over", "on", "across")


def is_of_drinks(group: NounGroup, preposition: str | None) -> bool:
    """As in "a tray of glasses", "two glasses of wine": no spectacles."""
    if group.head_word.text != "glasses":
        return False
    return preposition == "of" or any(one.preposition.text == "of" for one in group.phrases)


def choose_sense(head: Word, noun: str, draft: Draft, verb: str = "") -> str:
    """The noun that a word names among the things named before it, as the subject of a verb."""
    verbs, person = _DOERS.get(head.lemma, (frozenset(), ""))
    if verb in verbs and person in draft.nouns:
        return person
    named = {item.noun for item in draft.objects}
    for others, sense in _BESIDE.get(head.lemma, ()):
        if named & others and sense in draft.nouns:
            return sense
    return noun


_TURNED = _words("spin rotate turn revolve whirl slow stop")
_TURNING = _words("spinning rotating turning revolving sector sectors segment segments stripes")
_GROWING = _words("expanding growing widening looming approaching")
_OF_BARS = _words("black white dark bright grey gray vertical moving drifting sweeping")
_SWEPT = _words("move sweep drift slide rotate jump cross translate")
"""What a counter is not, and does not do."""
_PATTERNS = {"ring": "expanding ring", "disc": "looming disc", "square": "looming disc"}


def choose_pattern(group: NounGroup, noun: str, verb: str) -> str:
    """As in "a rotating disc", "an expanding ring": the pattern that moves so."""
    said = {word.text for word in group.modifiers}
    if noun == "bar counter" and (said & _OF_BARS or verb in _SWEPT):
        mark_used(word for word in group.modifiers if word.text == "vertical")
        return "vertical bar"
    inner = {one.head.text for phrase in group.phrases for one in phrase.groups if one.head}
    if noun in _PATTERNS and said & _GROWING:
        mark_used(word for word in group.modifiers if word.text in _GROWING)
        is_ring = noun == "ring" or group.head_word.lemma == "circle"
        return "expanding ring" if is_ring else _PATTERNS[noun]
    if noun == "disc" and (said | inner) & _TURNING | {verb} & _TURNED:
        mark_used(word for word in group.modifiers if word.text in _TURNING)
        return "spinning disc"
    return noun


def is_no_pattern(group: NounGroup, noun: str, preposition: str | None, draft: Draft) -> bool:
    """As in "a shirt with vertical stripes", "a cat opens its eyes": part of something else."""
    if noun == "grating":
        if preposition == "with" and any(one.noun == "spinning disc" for one in draft.objects):
            mark_used(group.words)
        return preposition in ("with", "in", "of")
    if noun != "eye":
        return False
    others = any(draft.nouns[item.noun].motion != "stand" for item in draft.objects)
    is_own = group.owner is not None or (
        group.determiner is not None and group.determiner.text in ("its", "his", "her", "their")
    )
    return others or is_own


_HERDS = {"herd": 7, "flock": 9, "pack": 5, "caravan": 5, "swarm": 14, "school": 10, "shoal": 10,
          "colony": 8, "pair": 2, "team": 4, "convoy": 5, "fleet": 6, "trio": 3}  # fmt: skip
"""Word for a group after the name of its members → how many they are."""
_ANY = frozenset({"animal", "member", "creature", "individual"})


_YOUNG = frozenset({"calf", "pup", "cub", "chick", "foal", "fawn", "kitten", "gosling", "duckling"})


def read_young(group: NounGroup, draft: Draft) -> bool:
    """As in "a seal pup", which is a seal; whether the group was one and is now its animal."""
    inner = group.modifiers[-1] if group.modifiers else None
    animal = inner.read_as(Role.NOUN) if inner is not None else None
    if _is_of_animal(group, draft):
        head = group.head_word
        head.meaning = replace(head.meaning, value=draft.objects[-1].noun, is_substitute=True)
        head.others = ()
        return False
    if inner is None or animal is None or group.head_word.lemma not in _YOUNG:
        return False
    model = draft.nouns.get(str(animal.value))
    if model is None or model.motion == "stand":
        return False
    group.head_word.shown_as = str(animal.value)
    group.modifiers.pop()
    group.head = inner
    return True


def _is_of_animal(group: NounGroup, draft: Draft) -> bool:
    """As in "a koala with her baby": no human child."""
    owner = group.determiner.text if group.determiner is not None else ""
    nouns = [draft.nouns[item.noun] for item in draft.objects]
    is_baby = group.head_word.lemma == "baby" and group.head_word.role is Role.NOUN
    return (
        is_baby and owner in ("its", "her", "their") and bool(nouns)
        and is_living(nouns[-1]) and not any(map(is_person, nouns))
    )  # fmt: skip


def read_herd(group: NounGroup, draft: Draft) -> int | None:
    """As in "a camel caravan of five animals": five camels; None if it names no such group."""
    head = group.head_word
    inner = group.modifiers[-1] if group.modifiers else None
    member = inner.read_as(Role.NOUN) if inner is not None else None
    if inner is None or member is None or head.lemma not in _HERDS:
        return None
    noun = draft.nouns.get(str(member.value))
    if noun is None or (not is_living(noun) and noun.motion not in _VEHICLE_MOTIONS):
        return None  # a volleyball team is people
    count = _HERDS[head.lemma]
    for phrase in list(group.phrases):
        content = phrase.groups[0]
        numbers = [word for word in content.modifiers if word.role is Role.COUNT]
        is_any = content.head is not None and _name(content.head) in _ANY
        if phrase.preposition.text == "of" and is_any and numbers:
            count = int(numbers[-1].meaning.value)
            mark_used([phrase.preposition, *content.words])
            group.phrases.remove(phrase)
    head.is_used = True
    group.modifiers.pop()
    group.head = inner
    return count
