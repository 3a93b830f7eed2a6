"""Prepositions in a draft: relations of things to each other and to the place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from texvent_scenes.description import SEEN
from texvent_scenes.models.activities import AIMED, HAND_NOUNS, PERSON_NOUNS, TO_AND_FROM_SEATS
from texvent_scenes.models.anchors import has_rim, takes_in
from texvent_scenes.models.people.outfit import list_props
from texvent_scenes.models.places import PLACES, PlaceModel
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.read.abilities import MEANS
from texvent_scenes.read.draft import SceneDraft
from texvent_scenes.read.groups import Group, Phrase
from texvent_scenes.read.lexicon import word_set
from texvent_scenes.read.parts import list_words
from texvent_scenes.read.tokens import Token
from texvent_scenes.spec.data import ACTED, PLACING, SENT, SPACED, WAYS

_WATERS = frozenset({"sea", "lake", "river"})
_AT_HOME = {
    ("into", "sky"): {"fly", "rise", "float", "hover"},
    **{("into", one): {"swim"} for one in _WATERS},
}
"""Prepositions and places → motions after which one is there: "flies into the sky"."""
_LANDING = frozenset({"fall", "jump", "sink", "bounce"})
_CLAIMED = PLACING | {"past", "around", "towards", "away from", "from", "off"}
"""Relations that the staged scene may have though nothing was placed by them."""
_ARRIVALS = {"into": "in", "onto": "on"}
_SENT_OFF = frozenset({"bounce", "jump", "throw"})
"""Motions against something that is reached: no pendulum swings so before a wall."""
_DROPPED = frozenset({"move", "fall", "throw", "roll", "bounce", "sink", "fly", "jump"})
"""Motions by which small things come into what is open above."""
_ON_FOOT = frozenset({"climb", "walk", "run", "move"})
"""Motions of who climbs, as they are said."""
_RAINED_ON = (
    "on", "above", "around", "past", "behind", "front", "beside", "through", "in", "against",
)  # fmt: skip
"""Relations of what comes down everywhere."""
_ALONG = ("along", "down", "up")
"""Prepositions of ways that lead on."""
SITTING = frozenset({"sit", *TO_AND_FROM_SEATS})
"""Motions of who is on a seat or on the ground."""
_RUNNING = frozenset({"slide", "roll", "drive", "move"})
"""Motions into a body that has no opening: they meet."""
_ROUND = frozenset({"on", "past", "at", "in", "through", "into"})
"""Relations to a ring that those who go have along it."""
_SMALL_SET = 0.45
"""Size of a backdrop of things that are small enough to be thrown."""
_SMALL = nouns_with("in hand or on something")


def find_relation(draft: SceneDraft, phrase: Phrase, subjects: Sequence[int]) -> str:
    """The relation that a preposition means after what the subjects do; "" = none."""
    token = phrase.preposition
    sense = token.first("relation")
    kind = sense.value if sense is not None else ""
    does = {each["kind"] for one in subjects for each in draft.things[one]["motions"]}
    kind = "on" if token.text == "onto" and does & _LANDING else kind
    for motions in (draft.things[one]["motions"] for one in subjects if token.text == "onto"):
        motions += [{"kind": "stand"}] if motions and motions[-1]["kind"] == "jump" else []
    sent = {each["kind"] for one in subjects for each in draft.things[one]["relations"]}
    sent_to = "" if "throw" in does else "towards"  # it is not thrown
    is_sent = bool(sent or does & _SENT_OFF) or any(map(draft.goes, subjects))
    return sent_to if token.text == "against" and is_sent else kind


def lose_ways(
    draft: SceneDraft, after: Sequence[Phrase | Token], *, has_subject: bool = True
) -> None:
    """Report what says how and where to something is done that is not shown.

    Of what is not known at all, only a place is told: "a wug runs across the floor".
    """
    for one in after:
        token = one.preposition if isinstance(one, Phrase) else one
        kinds = {each.value for each in token.all("relation" if token is not one else "adverb")}
        said = {each if token is not one else each[0] for each in kinds}
        is_way = not (has_subject or said & {"in", "at", "with"} or token.text == "on")
        is_way &= token is not one
        if (is_way or said & word_set("things", "ways")) and not token.has("scene"):
            draft.mark(token, "lost")


def lose_drift(draft: SceneDraft, after: Sequence[Phrase | Token]) -> None:
    """Report ways of an effect, which particles go only if they are blown along."""
    is_blown = bool(draft.effects) and draft.effects[-1]["kind"] in word_set("things", "blown")
    for token in (one.preposition for one in after if isinstance(one, Phrase)):
        kinds = {one.value for one in token.all("relation")}
        ways = kinds & word_set("things", "ways")
        is_along = token.text in ("across", *_ALONG)
        is_so = (is_blown and is_along) or any(is_rained_on(draft, token, one) for one in kinds)
        has_spout = bool(draft.effects) and draft.effects[-1]["source"] is not None
        is_so |= kinds == {"through"} and has_spout and draft.shows(token)
        if (ways - {"from", "out of"} or is_along) and not is_so:
            draft.mark(token, "lost")


def names_formation(draft: SceneDraft, phrase: Phrase, subjects: Sequence[int]) -> bool:
    """Whether it names a form in which some stand or go, which is lost: "flying in a spiral".

    A dot in a square is a thing in another one.
    """
    heads = [group.head for group in phrase.groups if group.head is not None]
    is_form = any(one.text in word_set("things", "forms") and not one.has("place") for one in heads)
    own = {draft.things[one]["noun"] for one in subjects}
    is_drawn = bool(own) and own <= nouns_with("flat pattern")
    if phrase.preposition.text != "in" or not is_form or is_drawn:
        return False
    words = (one for each in phrase.groups for one in list_words(each))
    for token in (phrase.preposition, *words):
        draft.mark(token, "lost")
    return True


def find_mutual(groups: Sequence[Group], after: Sequence[Phrase | Token] = ()) -> list[Token]:
    """The words "each other" of some groups, or after them."""
    words = [one for group in groups for one in group.unknown]
    words += [one for one in after if isinstance(one, Token)]
    return [one for one in words if one.text == "each other"]


def claim_mutual(
    draft: SceneDraft, tokens: Sequence[Token], kind: str, subjects: Sequence[int]
) -> None:
    """Send things to each other, and leave it to the staged scene whether they are so."""
    does = {each["kind"] for one in subjects for each in draft.things[one]["motions"][-1:]}
    if kind in ("past", "towards") and does & {*MEANS, "move", "roll", "slide"}:
        draft.part_ways(subjects)
    for token in tokens if subjects and kind else ():
        draft.claim(token, "mutual", kind, subjects[:1], subjects[1:])


def go_to_place(
    draft: SceneDraft, token: Token, heads: list[Token], subjects: Sequence[int],
    moved: Sequence[int],
) -> None:  # fmt: skip
    """As "across a field"; a dog "on a road" stands on it, "in a lake" it only could swim."""
    place = PLACES[draft.parts["place"]["name"]]
    is_entered = token.text in ("onto", "into") and place.has_road and bool(moved)
    is_entered &= all(map(draft.walks, moved))
    for index in moved if token.text == "across" or is_entered else ():
        for motion in draft.things[index]["motions"][-1:]:
            motion.setdefault("direction", "across")
    names = {one.value for head in heads for one in head.all("place")[:1]}
    for thing in (draft.things[one] for one in subjects if token.text == "on"):
        is_flyer = draft.nouns[thing["noun"]].habitat == "air" and not names & _WATERS
        thing["motions"] = thing["motions"] or [{"kind": "stand"}] * is_flyer  # "on a runway"
    on_foot = any(map(draft.keeps_to_ground, subjects)) and bool(names & _WATERS)
    is_flat = token.text in ("up", "down") and {one.text for one in heads} & word_set(
        "things", "steep"
    )
    is_in = on_foot and token.text in ("through", "in", "into")
    rises = {each["kind"] for one in moved for each in draft.things[one]["motions"]} == {"rise"}
    does = {each["kind"] for one in moved for each in draft.things[one]["motions"][-1:]}
    at_home = _AT_HOME.get((token.text, "".join(names)), set())
    is_home = bool(does) and does <= at_home
    lands = token.text == "onto" and does and does <= _LANDING
    if is_entered or is_home or lands or (token.text == "from" and rises):
        draft.show(token)  # "steps onto the road": and goes over it
        draft.claim(token, "rise", "", moved if rises else ())
    elif is_in or is_flat or not _shows_way(draft, token, place, subjects):
        draft.mark(token, "lost")
        if token.text in ("from", "out of") and does & word_set("things", "off_ground"):
            draft.claim(token, "rise", "", moved)  # "takes off from a runway"
    if draft.shows(token) and token.text in ("across", *_ALONG):
        draft.claim(token, "goes", "", moved)
    is_road = token.text in ("on", *_ALONG) and place in (PLACES["road"], PLACES["dirt road"])
    for index in subjects if is_road else ():
        said = token.text == "on" and place is PLACES["road"]  # else a fence stands beside it
        if draft.walks(index) or (
            said and draft.nouns[draft.things[index]["noun"]].motion != "drive"
        ):
            draft.things[index].setdefault("placement", "lane")


def _shows_way(draft: SceneDraft, token: Token, place: PlaceModel, subjects: Sequence[int]) -> bool:
    """Whether a place shows a preposition: no "towards a park", "by a forest"."""
    kinds = {one.value for one in token.all("relation")}
    if token.text in ("across", "down", "up"):
        return not subjects or any(draft.things[one]["motions"] for one in subjects)
    if "above" in kinds:
        return not any(map(draft.keeps_to_ground, subjects))
    if "front" in kinds:  # "against a starry sky"
        return place.is_backdrop or place in (PLACES["sky"], PLACES["space"])
    is_past = token.text == "past" or (place.has_shore and token.text == "through")
    is_bank = "beside" not in kinds or place.has_shore
    return is_bank and not is_past and (not kinds or bool(kinds & word_set("things", "places")))


def _part_worn(draft: SceneDraft, targets: Sequence[int]) -> list[list[int]]:
    """Things that can be worn, and others: "with glasses and a boy"."""
    worn = {one for one in targets if draft.things[one]["noun"] in word_set("things", "worn")}
    parts = [one for one in targets if one in worn], [one for one in targets if one not in worn]
    return [*filter(None, parts)]


def _bear(draft: SceneDraft, index: int, targets: Sequence[int]) -> str:
    """Relation of what is with something to it: "a horse with a rider", "a tray with glasses"."""
    bearer, first = draft.things[index]["noun"], draft.things[targets[0]]["noun"]
    if bearer in nouns_with("see-through"):
        return "in"
    if all(map(draft.walks, targets)):
        is_ridden = bearer in word_set("things", "mounts") and first in PERSON_NOUNS
        return "ride" if is_ridden else "on" if bearer in nouns_with("seat") else ""
    if draft.can_go(targets[0]):
        return ""
    is_put = bearer in word_set("things", "laden") and first not in nouns_with("seat")
    return "on" if is_put else "in" if bearer in word_set("things", "vessels") else ""


def relate_one(draft: SceneDraft, kind: str, index: int, targets: Sequence[int]) -> bool:
    """Relate a thing to others as far as scenes can; whether it is so."""
    thing, noun = draft.things[index], draft.things[targets[0]]["noun"]
    if kind == "with" and len(parts := _part_worn(draft, targets)) > 1:
        return all([relate_one(draft, kind, index, each) for each in parts])
    if kind == "with" and thing["noun"] in trait_values("circled on"):
        return all(
            [
                draft.relate(one, _choose_relation(draft, "on", one, index), [index])
                for one in targets
            ]
        )
    if kind == "with":
        if borne := _bear(draft, index, targets):
            return all([draft.relate(one, borne, [index]) for one in targets])
        if noun in nouns_with("towering"):
            return True  # it stands in the distance
        if not any(map(draft.can_go, (index, *targets))):
            return False  # "a vase with roses", "a disc with a dot"
    if kind == "on" and noun in word_set("things", "peaks"):
        return False  # its slopes bear nothing
    targets = [ridden_by(draft, one, kind) for one in targets]  # "behind the rider"
    used = _use(thing, noun) if kind in ("in", "into", "from", "on") else ""
    kind = used or _choose_relation(draft, kind, index, targets[0])
    sat_at = [one["to"] for one in thing["relations"] if kind == "with" and one["kind"] == "at"]
    if sat_at and draft.nouns[noun].speed_m_s == 0.0:  # "at a table with a laptop"
        return all([draft.relate(one, "on", sat_at[0]) for one in targets])
    tops = [one["to"] for one in thing["relations"] if one["kind"] == "on"
            and draft.things[one["to"][0]]["noun"] in word_set("things", "tables")]  # fmt: skip
    small = [one for one in targets if draft.things[one]["noun"] in _SMALL
             and not draft.things[one]["relations"]]  # fmt: skip
    is_still = all(one["kind"] == "stand" for one in thing["motions"])
    for one in small if tops and kind in SPACED and is_still else ():
        draft.relate(one, "on", tops[0])  # "a cup on a table beside a book"
    return bool(kind) and draft.relate(ridden_by(draft, index, kind), kind, targets)


_HANDED = {"into": "in", "in": "in", "on": "on", "to": "on", "above": "on"}


def hand_over(
    draft: SceneDraft, token: Token, kind: str, subjects: Sequence[int], targets: Sequence[int]
) -> str:
    """Fate of where a machine takes or leaves things: "picks a box off a belt"; "" = it does not.

    The thing is there at first, or at the end; the staged scene tells.
    """
    machines = trait_values("gripper").keys()
    acts = [one for n in range(len(draft.things)) for one in draft.things[n]["relations"]
            if draft.things[n]["noun"] in machines and one["kind"] in ACTED
            and (n in subjects or {*one["to"]} & {*subjects})]  # fmt: skip
    things = [n for one in acts for n in one["to"]]
    is_taken = kind in ("from", "off", "out of") or (acts[-1:] and acts[-1]["kind"] == "lift")
    place = "on" if is_taken else _HANDED.get("on" if token.text == "onto" else kind, "")
    if not (things and place) or not {*targets}.isdisjoint(things):
        return ""
    is_so = all([draft.relate(one, place, targets) for one in things])
    left = ("relation", "into") if place == "in" else ("arrive", place)
    draft.claim(token, *(("off", "") if is_taken else left), things, targets)
    return "shown" if is_so else "lost"


def claim_relation(
    draft: SceneDraft, token: Token, kind: str, subjects: Sequence[int], targets: Sequence[int]
) -> None:
    """Leave it to the staged scene whether a preposition that places nothing holds all the same.

    What stops "in front of" something is before it on its way, wherever the camera is.
    """
    is_shown = draft.shows(token)
    draft.claim(token, SEEN, "", subjects, targets)
    motions = [draft.things[one]["motions"] for one in subjects]
    stops = [bool(one) and (one[-1].get("end_pace") == 0.0 or (
        len(one) > 1 and one[-1]["kind"] == "stand")) for one in motions]  # fmt: skip
    nouns = {draft.things[one]["noun"] for one in targets}
    does = {each["kind"] for one in motions for each in one}
    if is_shown and kind == "at" and does & SITTING and nouns <= word_set("things", "sat_at"):
        draft.claim(token, "sit at", "", subjects, targets)
    if is_shown and token.text == "by" and nouns <= HAND_NOUNS and does - {"stand"}:
        draft.claim(token, "grip", "hold", targets, subjects)  # "tilted by hand"
    if is_shown and token.text == "along":
        draft.claim(token, "along", "", subjects, targets)
    if is_shown and kind in ("up", "down"):
        draft.claim(token, "relation", kind, subjects, targets)
    elif is_shown and kind == "front" and any(stops):
        draft.claim(token, "stop before", "", subjects, targets)
    elif not is_shown and token.text in _ARRIVALS:
        draft.claim(token, "arrive", _ARRIVALS[token.text], subjects, targets)
    elif not is_shown and kind in _CLAIMED:
        draft.claim(token, "off" if kind == "off" else "relation", kind, subjects, targets)


def set_before(draft: SceneDraft, token: Token, noun: str, subjects: Sequence[int]) -> bool:
    """Put what a word says without naming it behind things: "a hand, backlit", by a lit panel."""
    known = [n for n, one in enumerate(draft.things) if one["noun"] == noun]
    if not known:
        draft.things.append({"noun": noun, "motions": [], "count": 1, "relations": []})
        if all(map(draft.is_light, subjects)) and not any(map(draft.walks, subjects)):
            draft.things[-1]["size"] = _SMALL_SET
    targets = [known[0] if known else len(draft.things) - 1]
    placed = [relate_one(draft, "front", one, targets) for one in subjects if one not in targets]
    draft.mark(token, "shown" if all(placed) else "lost")
    claim_relation(draft, token, "front", [one for one in subjects if one not in targets], targets)
    return True


def bear_on(draft: SceneDraft, verb: Token, index: int, objects: Sequence[int]) -> None:
    """Put things on what carries them: "a robot carrying a box", "a belt carrying bolts"."""
    for one in objects:
        draft.things[one]["motions"] = []
    placed = [relate_one(draft, "on", one, [index]) for one in objects]
    draft.mark(verb, "shown" if placed and all(placed) else "lost")
    for one in objects:
        draft.claim(verb, "relation", "on", [one], [index])


def lead_on(draft: SceneDraft, verb: Token, index: int, objects: Sequence[int]) -> None:
    """Have those who are led come after: "a dog leads a man"."""
    going = [one for one in objects if draft.can_go(one)]
    for one in going:
        draft.things[one]["motions"] = draft.things[one]["motions"] or [{"kind": "move"}]
    placed = [draft.relate(one, "follow", [index]) for one in going]
    draft.mark(verb, "shown" if placed and all(placed) else "lost")


def keep_distance(draft: SceneDraft, preposition: Token, subjects: Sequence[int]) -> None:
    """Apply the distance before a preposition: "2 m behind a car"."""
    token = draft.tokens[preposition.at - 1]
    name, value = said.value if (said := token.first("adverb")) else ("", None)
    for index in subjects if name == "distance_m" else ():
        for row in draft.things[index]["relations"][-1:]:
            if row["kind"] in SPACED:
                row["distance_m"] = value
                draft.show(token)


def dress(draft: SceneDraft, phrase: Phrase, subjects: Sequence[int]) -> bool:
    """Give persons clothes of a colour: "a man in red"; whether it says so."""
    words = [one.unknown[0] for one in phrase.groups if one.head is None and one.unknown]
    said = [one.first("field") for one in words if len(words) == len(phrase.groups) == 1]
    colours = [one.value[1] for one in said if one is not None and one.value[0] == "colour"]
    are_persons = all(draft.things[one]["noun"] in PERSON_NOUNS for one in subjects)
    unknown = {each.text for one in phrase.groups for each in one.unknown}
    are_persons &= not unknown & word_set("things", "accessories")  # "in green gloves"
    if not (colours and subjects and are_persons and phrase.preposition.text == "in"):
        return False
    for one in subjects:
        draft.things[one].setdefault("colour", colours[0])
    draft.show(phrase.preposition, *words)
    return True


def is_rained_on(draft: SceneDraft, token: Token, kind: str) -> bool:
    """Whether weather or leaves come down on something, as on all: "snow falls on a car"."""
    before = draft.tokens[token.at - 1]
    is_weather = {one.value[1] for one in before.all("scene")} & {"weather", "has_snow"}
    is_all_over = {one.value for one in before.all("effect")} & word_set("things", "all_over")
    return bool(is_weather or is_all_over) and kind in _RAINED_ON


def ridden_by(draft: SceneDraft, index: int, kind: str) -> int:
    """Vehicle that goes where its rider goes: "rides a bicycle past a tree"."""
    relations = draft.things[index]["relations"]
    ridden = [one["to"][0] for one in relations if one["kind"] == "ride"]
    is_way = kind in word_set("things", "passed") | {
        "through",
        "follow",
        "overtake",
        "behind",
        *WAYS,
    }
    return ridden[0] if ridden and is_way else index


def _choose_way(draft: SceneDraft, kind: str, index: int, other: int) -> str:
    """The way that is meant, as far as its target has one; "" = none."""
    thing, noun = draft.things[index], draft.things[other]["noun"]
    does, is_led = {one["kind"] for one in thing["motions"]}, bool(draft.things[other]["motions"])
    if kind in ("into", "out of"):
        is_open = noun in trait_values("opening") or noun in nouns_with("closed")
        is_open |= kind == "into" and bool(does) and does <= _DROPPED and has_rim(noun)
        if any(one["kind"] in SENT for one in thing["relations"]):
            return "towards" if kind == "into" and takes_in(noun) else ""
        is_met = bool(does & _RUNNING) and draft.nouns[noun].habitat == "fixed"
        is_met &= trait_value("container", noun) is None
        other_kind = "from" if kind == "out of" else "collide" if is_met else ""
        return kind if is_open else other_kind
    if kind in ("up", "down"):
        if noun in trait_values("slope"):
            return "on" if kind == "down" and does != {"bounce"} else kind
        can_climb = noun in trait_values("climbed") and bool(does) and does <= _ON_FOOT
        if can_climb and draft.walks(index):
            thing["motions"][-1]["kind"] = "climb"  # "goes up a tree"
        return kind if can_climb else ""
    if kind == "off":
        return kind if does & {"jump", "fall", "roll", "slide"} else ""
    acts = {one["kind"] for one in thing["relations"]} & (ACTED - {"push", "pull"})
    return "towards" if is_led or acts or not draft.goes(index) else kind


def _choose_near(kind: str, noun: str, does: set[str], acts: set[str]) -> str:
    """The relation that "at" means, and "on" of work at a table; "" = none other."""
    is_table = noun in word_set("things", "tables")
    if kind != "at":  # "pours water into a glass on a table"
        return "at" if kind == "on" and is_table and does & word_set("things", "at_tables") else ""
    if acts & {*SENT} or does & AIMED:
        return "towards"
    return "" if is_table else "beside"


def _see_inside(kind: str, habitat: str, noun: str) -> str:
    """A relation as that to what is in it: "fish swim around a bowl", "a ball through a hoop"."""
    if kind == "around" and habitat == "water" and noun in nouns_with("see-through"):
        return "in"
    return "into" if kind == "through" and noun in trait_values("rim") else kind


def _use(thing: Mapping[str, Any], noun: str) -> str:
    """Relation to what is used in an act: "pours milk into a cup"; "" = it is not."""
    props = [prop for one in thing["motions"] for prop in list_props(one["kind"])]
    used = [one.anchor for one in props if noun in one.nouns]
    return "beside" if "ground" in used else "hold" if used else ""


def _choose_relation(draft: SceneDraft, kind: str, index: int, other: int) -> str:
    """The relation that is meant, which depends on what stands in it; "" = none."""
    thing, noun = draft.things[index], draft.things[other]["noun"]
    kind = _see_inside(kind, draft.nouns[thing["noun"]].habitat, noun)
    if kind in WAYS:
        return _choose_way(draft, kind, index, other)
    ends = [one.get("end_pace") for one in thing["motions"]][-1:]
    if kind == "front" and ends == [0.0]:
        return "to"  # "stops in front of a dog", which is in its way
    does = [one["kind"] for one in thing["motions"]]
    is_low = does in (["fall"], ["jump"]) and draft.has_top(other)
    if kind == "from" and (does == ["rise"] or is_low):
        return "off"
    if noun in trait_values("belt speed") and kind in ("past", "down"):
        return kind if draft.can_go(index) else "on"
    if noun in word_set("things", "worn") and kind in ("in", "with"):
        return "wear" if thing["noun"] in PERSON_NOUNS | nouns_with("person on a vehicle") else ""
    if noun in trait_values("circled on") and kind in _ROUND and draft.can_go(index):
        thing["motions"] = thing["motions"] or [{"kind": "orbit"}]
        return "around"
    acts = {one["kind"] for one in thing["relations"]}
    if near := _choose_near(kind, noun, {*does}, acts):
        return near
    if kind == "above" and draft.keeps_to_ground(index):  # no "kicks a ball over a fence"
        return "on" if noun in nouns_with("way") else ""
    if kind == "behind" and draft.goes_like(index, other):  # who brakes keeps no pace
        return "" if "end_pace" in thing["motions"][0] else "follow"
    return kind
