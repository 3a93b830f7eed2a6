"""Prepositions in a draft: relations of things to each other and to the place."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

from texvent_scenes.description import SEEN
from texvent_scenes.models.activities import (
    HAND_NOUNS,
    PERSON_NOUNS,
    SINGLE_ACTS,
    TO_AND_FROM_SEATS,
)
from texvent_scenes.models.people.outfit import list_props
from texvent_scenes.models.places import PLACES, PlaceModel
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.read.draft.abilities import MEANS, Indices
from texvent_scenes.read.draft.copies import part_ways
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.groups import Group, Phrase, heads_of, nouns_of, words_of
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.read.relations import (
    ALONG,
    OWN_BALL,
    claim_pavement,
    lead_bounces,
    relate_one,
)
from texvent_scenes.rendered_scene import Ground
from texvent_scenes.spec.data import PLACING, SPACED

_WATERS = frozenset({"sea", "lake", "pond", "river"})
_AT_HOME = {
    ("into", "sky"): {"fly", "glide", "rise", "float", "hover"},
    **{("into", one): {"swim"} for one in _WATERS},
}
"""Prepositions and places → motions after which one is there: "flies into the sky"."""
_LANDING = frozenset({"fall", "jump", "sink", "bounce"})
_CLAIMED = PLACING | {"past", "around", "towards", "away from", "from", "off"}
"""Relations that the staged scene may have though nothing was placed by them."""
_ARRIVALS = {"into": "in", "onto": "on"}
_HITS = frozenset({"hit", "kick"})
"""Acts upon something that it meets at one instant."""
_SENT_OFF = frozenset({"bounce", "jump", "throw"})
"""Motions against something that is reached: no pendulum swings so before a wall."""
_RAINED_ON = (
    "on", "above", "around", "past", "behind", "front", "beside", "through", "in", "against",
)  # fmt: skip
"""Relations of what comes down everywhere."""
SITTING = frozenset({"sit", *TO_AND_FROM_SEATS})
"""Motions of who is on a seat or on the ground."""
_SMALL_SET = 0.45
"""Size of a backdrop of things that are small enough to be thrown."""


def find_relation(draft: SceneDraft, phrase: Phrase, subjects: Indices) -> str:
    """The relation that a preposition means after what the subjects do; "" = none."""
    token = phrase.preposition
    kind = token.relation
    does = draft.does(subjects)
    kind = "on" if token.text == "onto" and does & _LANDING else kind
    for motions in (draft.things[one]["motions"] for one in subjects if token.text == "onto"):
        motions += [{"kind": "stand"}] if motions and motions[-1]["kind"] == "jump" else []
    lead_bounces(draft, token, subjects)
    sent = draft.acts(subjects)
    has_ball = bool(does & {"throw", *OWN_BALL}) and all(map(draft.walks, subjects))
    sent_to = "" if has_ball or "throw" in does else "towards"  # it is not thrown
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
        heads = heads_of(one.groups) if isinstance(one, Phrase) else ()
        if any(draft.fates.get(each.at) == "camera" for each in heads):
            continue  # "the view is from a drone"
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
        kinds = token.relations
        ways = kinds & word_set("things", "ways")
        is_along = token.text in ("across", *ALONG)
        is_so = (is_blown and is_along) or any(is_rained_on(draft, token, one) for one in kinds)
        has_spout = bool(draft.effects) and draft.effects[-1]["source"] is not None
        is_so |= kinds == {"through"} and has_spout and draft.shows(token)
        if (ways - {"from", "out of"} or is_along) and not is_so:
            draft.mark(token, "lost")


def names_formation(draft: SceneDraft, phrase: Phrase, subjects: Indices) -> bool:
    """Whether it names a form in which some stand or go, which is lost: "flying in a spiral".

    A dot in a square is a thing in another one, as are two boxers in a ring.
    """
    heads = [one for one in heads_of(phrase.groups) if not one.nouns or one.text in one.nouns]
    is_form = any(one.text in word_set("things", "forms") and not one.has("place") for one in heads)
    own = draft.names(subjects)
    is_drawn = bool(own) and own <= nouns_with("flat pattern")
    return phrase.preposition.text == "in" and is_form and not is_drawn


def names_sky(phrase: Phrase) -> bool:
    """Whether it says that nothing but the sky is behind: "against the sunset"."""
    words = words_of(phrase.groups)
    skies = {one.value for word in words for one in word.all("place")} & {"sky"}
    lights = any(one.value[1] in ("light", "clouds") or one.value[:2] == ("light", "kind")
                 for word in words for one in word.all("scene"))  # fmt: skip
    clouds = any(one.nouns & word_set("things", "aloft") for one in words)
    return phrase.preposition.text == "against" and (bool(skies) or lights or clouds)


def find_mutual(groups: Sequence[Group], after: Sequence[Phrase | Token] = ()) -> list[Token]:
    """The words "each other" of some groups, or after them."""
    words = [one for group in groups for one in group.unknown]
    words += [one for one in after if isinstance(one, Token)]
    return [one for one in words if one.text == "each other"]


def claim_mutual(draft: SceneDraft, tokens: Sequence[Token], kind: str, subjects: Indices) -> None:
    """Send things to each other, and leave it to the staged scene whether they are so."""
    does = {each["kind"] for one in subjects for each in draft.things[one]["motions"][-1:]}
    if kind in ("past", "towards") and does & {*MEANS, "move", "roll", "slide"}:
        part_ways(draft, subjects)
    for token in tokens if subjects and kind else ():
        draft.claim(token, "mutual", kind, subjects[:1], subjects[1:])


def go_to_place(
    draft: SceneDraft, token: Token, heads: list[Token], subjects: Indices, moved: Indices
) -> None:
    """As "across a field"; a dog "on a road" stands on it, "in a lake" it only could swim."""
    place = PLACES[draft.parts["place"]["name"]]
    is_entered = token.text in ("onto", "into") and place.has_road and bool(moved)
    is_entered &= all(map(draft.walks, moved))
    is_crossed = token.text == "across" or goes_over(draft, token, moved)
    for index in moved if is_crossed or is_entered else ():
        for motion in draft.things[index]["motions"][-1:]:
            motion.setdefault("direction", "across")
    names = {one.value for head in heads for one in head.all("place")[:1]}
    for thing in (draft.things[one] for one in subjects if token.text == "on"):
        is_flyer = draft.nouns[thing["noun"]].habitat == "air" and not names & _WATERS
        thing["motions"] = thing["motions"] or [{"kind": "stand"}] * is_flyer  # "on a runway"
    is_flat = token.text in ("up", "down") and {one.text for one in heads} & word_set(
        "things", "steep"
    )
    is_in = bool(names & _WATERS) and _wade(draft, token, subjects)
    rises = draft.does(moved) == {"rise"}
    does = {each["kind"] for one in moved for each in draft.things[one]["motions"][-1:]}
    at_home = _AT_HOME.get((token.text, "".join(names)), set())
    is_home = bool(does) and does <= at_home
    is_seen = draft.beside(token, -1).text in word_set("things", "viewed") and token.text == "from"
    is_home |= is_seen and place is PLACES.get("".join(names))  # "seen from a beach"
    lands = token.text == "onto" and does and does <= _LANDING
    lands = bool(lands) or (token.text in ("to", "onto") and "set down" in draft.acts(subjects))
    if is_entered or is_home or lands or (token.text == "from" and rises):
        draft.show(token)  # "steps onto the road": and goes over it
        draft.claim(token, "rise", "", moved if rises else ())
    elif is_in or is_flat or not _shows_way(draft, token, place, subjects):
        draft.mark(token, "lost")
        if token.text in ("from", "out of") and does & word_set("things", "off_ground"):
            draft.claim(token, "rise", "", moved)  # "takes off from a runway"
    for thing in (draft.things[one] for one in subjects if token.text == "of" and place.has_road):
        is_amid = thing.get("placement") == "centre" and draft.nouns[thing["noun"]].speed_m_s
        thing |= {"placement": "lane"} if is_amid else {}  # "in the middle of the road"
    is_road = token.text in ("on", *ALONG) and place in (PLACES["road"], PLACES["dirt road"])
    _keep_above(draft, token, place, moved or subjects)
    claim_pavement(draft, token, heads, moved or subjects)
    for index in subjects if is_road else ():
        said = token.text == "on" and place is PLACES["road"]  # else a fence stands beside it
        if draft.walks(index) or (said and draft.noun(index).motion != "drive"):
            draft.things[index].setdefault("placement", "lane")


def _wade(draft: SceneDraft, token: Token, subjects: Indices) -> bool:
    """Whether things of the ground are in water, where they may swim at most."""
    is_in = token.text in ("through", "in", "into")
    is_in &= any(map(draft.keeps_to_ground, subjects))
    for index in subjects if is_in and token.text == "in" else ():
        draft.things[index]["waded_at"] = token.at
    return is_in


def _keep_above(draft: SceneDraft, token: Token, place: PlaceModel, subjects: Indices) -> None:
    """Put what flies over a road or water above it, as what "takes off from a lake"."""
    is_city = place.ground is Ground.CITY  # which is more than its streets
    has_way = (place.has_road and not is_city) or place.has_shore
    flying = [one for one in subjects if draft.noun(one).habitat == "air"]
    rises = token.text in ("from", "off") and draft.does(flying) <= {"rise"}
    if not (has_way and flying and (token.text in ("over", "above", "along") or rises)):
        return
    for index in flying if token.text != "along" else ():
        draft.things[index].setdefault("placement", "lane")
    is_dry = rises and place.has_road
    draft.claim(token, "above way", token.text, [] if is_dry else flying)


def goes_over(draft: SceneDraft, token: Token, subjects: Indices) -> bool:
    """Whether all go over a place on foot or on wheels: "runs over the lawn"."""
    return token.text == "over" and bool(subjects) and all(
        draft.keeps_to_ground(one) and draft.does([one]) - {"stand"} for one in subjects
    )  # fmt: skip


def _shows_way(draft: SceneDraft, token: Token, place: PlaceModel, subjects: Indices) -> bool:
    """Whether a place shows a preposition: no "towards a park", "by a forest"."""
    kinds = token.relations
    if token.text in ("across", "around", "down", "up"):
        return not subjects or any(draft.things[one]["motions"] for one in subjects)
    if "above" in kinds:
        is_high = not any(map(draft.keeps_to_ground, subjects))
        return is_high or goes_over(draft, token, subjects)
    if "front" in kinds:  # "against a starry sky"
        return place.is_backdrop or place in (PLACES["sky"], PLACES["space"])
    is_past = token.text == "past" or (place.has_shore and token.text == "through")
    is_bank = "beside" not in kinds or place.has_shore
    return is_bank and not is_past and (not kinds or bool(kinds & word_set("things", "places")))


def claim_relation(
    draft: SceneDraft, token: Token, kind: str, subjects: Indices, targets: Indices
) -> None:
    """Leave it to the staged scene whether a preposition that places nothing holds all the same.

    What stops "in front of" something is before it on its way, wherever the camera is.
    """
    is_shown = draft.shows(token)
    draft.claim(token, SEEN, "", subjects, targets)
    motions = [draft.things[one]["motions"] for one in subjects]
    stops = [bool(one) and (one[-1].get("end_pace") == 0.0 or (
        len(one) > 1 and one[-1]["kind"] == "stand")) for one in motions]  # fmt: skip
    nouns = draft.names(targets)
    does = {each["kind"] for one in motions for each in one}
    if is_shown and kind == "at" and does & SITTING and nouns <= word_set("things", "sat_at"):
        draft.claim(token, "sit at", "", subjects, targets)
    if is_shown and token.text == "by" and nouns <= HAND_NOUNS and does - {"stand"}:
        draft.claim(token, "grip", "hold", targets, subjects)  # "tilted by hand"
    if is_shown and kind == "to" and "jump" in does:  # "from a table to a chair"
        draft.claim(token, "arrive", "on", subjects, targets)
    if is_shown and kind == "between" and token.text.endswith(" between"):
        draft.claim(token, "out between", "", subjects, targets)
    if is_shown and token.text == "along":
        draft.claim(token, "along", "", subjects, targets)
        _claim_edge(draft, token, subjects, targets)
    if is_shown and kind in ("up", "down"):
        draft.claim(token, "relation", kind, subjects, targets)
    elif is_shown and kind == "front" and any(stops):
        draft.claim(token, "stop before", "", subjects, targets)
    elif not is_shown and token.text in _ARRIVALS:
        draft.claim(token, "arrive", _ARRIVALS[token.text], subjects, targets)
    elif not is_shown and kind in _CLAIMED:
        draft.claim(token, "off" if kind == "off" else "relation", kind, subjects, targets)


def _claim_edge(draft: SceneDraft, token: Token, subjects: Indices, targets: Indices) -> None:
    """Leave it to the staged scene whether who goes along a part is on it: "the edge of a roof"."""
    article = draft.beside(token, 1).has("articles")
    part = draft.beside(token, 1 + article)
    for one in (token, part) if part.has("partitive") else ():
        draft.claim(one, "on edge", "", subjects, targets)


def set_before(draft: SceneDraft, token: Token, noun: str, subjects: Indices) -> bool:
    """Put what a word says without naming it behind things: "a hand, backlit", by a lit panel."""
    targets = draft.find([noun])[:1]
    if not targets:
        targets = [draft.add(noun)]
        if all(map(draft.is_light, subjects)) and not any(map(draft.walks, subjects)):
            draft.things[-1]["size"] = _SMALL_SET
    others = [one for one in subjects if one not in targets]
    placed = [relate_one(draft, "front", one, targets) for one in others]
    draft.mark(token, "shown" if all(placed) else "lost")
    claim_relation(draft, token, "front", others, targets)
    return True


def keep_distance(draft: SceneDraft, preposition: Token, subjects: Indices) -> None:
    """Apply the distance before a preposition: "2 m behind a car"."""
    token = draft.beside(preposition, -1)
    name, value = token.value("adverb")
    for index in subjects if name == "distance_m" else ():
        for row in draft.things[index]["relations"][-1:]:
            if row["kind"] in SPACED:
                row["distance_m"] = value
                draft.show(token)


def dress(draft: SceneDraft, phrase: Phrase, subjects: Indices) -> bool:
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
    before = draft.beside(token, -1)
    places = {one.value for each in draft.tokens for one in each.all("place")}
    washes = before.says("scene", "place") and before.text.startswith("wave") and places <= {"sea"}
    return (comes_down(before) or washes) and kind in _RAINED_ON


def is_rained_under(draft: SceneDraft, token: Token, targets: Indices) -> bool:
    """Whether weather comes down by what is no roof: "rain on a street under a lamp post"."""
    at = token.at - 1
    while at > 0 and draft.tokens[at].has("place", "relation", "articles"):
        at -= 1
    is_open = bool(targets) and draft.names(targets) <= word_set("things", "rained_under")
    is_so = "under" in token.relations and is_open and comes_down(draft.tokens[at])
    draft.claim(token, SEEN, "", [None] if is_so else [], targets)
    return is_so


def comes_down(token: Token) -> bool:
    """Whether a word names weather or what comes down everywhere."""
    is_weather = {one.value[1] for one in token.all("scene")} & {"weather", "has_snow"}
    is_all_over = {one.value for one in token.all("effect")} & word_set("things", "all_over")
    return bool(is_weather or is_all_over)


def is_of_particles(draft: SceneDraft, phrase: Phrase) -> bool:
    """Whether it is said of what comes down before it: "watches leaves falling from a tree"."""
    before = draft.beside(phrase.preposition, -1)
    falls = any(one.endswith("ing") for one in before.text.split()[1:])
    return falls and not before.has("noun") and before.has("effect", "scene")


def is_standpoint(draft: SceneDraft, phrase: Phrase, move: Mapping[str, Any] | None = None) -> bool:
    """Whether it says from where something is seen, which puts nothing there; its words are lost.

    As in "seen from a bridge", "follows from a vehicle"; what a camera leaves is seen.
    """
    preposition, kind = phrase.preposition, (move or {}).get("kind")
    way = (move or {}).get("direction")
    leaves = (kind in ("pan", "tilt", "zoom") and way != "in") or way in ("out", "up")
    before = draft.beside(preposition, -1)
    is_mount = before.text in word_set("things", "mounted")  # "mounted on a car"
    if before.text in ("is", "sits"):  # "the view is from a bridge"
        before = draft.beside(before, -1)
        is_mount = before.has("camera")
    is_mount &= preposition.text in ("on", "in", "to", "onto", "inside", "aboard")
    is_so = (preposition.text.startswith("from") or is_mount) and bool(phrase.groups) and not leaves
    is_view = is_mount or before.text in word_set("things", "viewed") or before.has("shot")
    if not is_so or (move is None and not is_view):
        return False
    heads = heads_of(phrase.groups)
    if heads and all(one.has("place") for one in heads):
        return False  # "seen from a beach" is there
    is_said = before.text in word_set("things", "viewed")
    for token in (*([before] if is_said else []), preposition, *words_of(phrase.groups)):
        draft.mark(token, "lost")
    nouns = nouns_of(phrase.groups)
    after = draft.tokens[heads[-1].at + 1 :][:1] if heads else ()
    is_high = bool(nouns) and all(draft.nouns[one].habitat == "air" for one in nouns)
    is_high &= is_said and preposition.text == "from"  # "a river seen from a drone"
    goes = any(draft.nouns[one].speed_m_s for one in nouns) and any(map(is_course, after))
    if is_high or goes:
        draft.mark(before, "shown" if is_said else draft.fates.get(before.at, ""))
        draft.mark(preposition, "shown")
        draft.mark(heads[-1], "camera")  # "view from a drone flying over a field"
    if is_high:
        draft.parts["camera"].setdefault("view", "aerial")
    return True


def looks_at_contact(draft: SceneDraft, phrase: Phrase) -> bool:
    """Whether a camera looks at who hits something as it does: "zooms in on the impact"."""
    words = [one for one in draft.tokens[phrase.preposition.at + 1 :] if not one.has("articles")]
    words = [*itertools.takewhile(lambda one: not (one.is_sign or one.has("verb")), words)]
    said = [one for one in words if one.text in word_set("things", "contacts")]
    who = [n for n in range(len(draft.things)) if draft.does([n]) & SINGLE_ACTS
           or draft.acts([n]) & _HITS]  # fmt: skip
    if phrase.preposition.text not in ("on", "at") or not (said and who):
        return False
    draft.parts["camera"].setdefault("target", who[0])
    draft.show(phrase.preposition, *said)
    met = [each for one in draft.things[who[0]]["relations"] for each in one["to"]]
    draft.claim(said[-1], "part", "", who[:1])
    draft.claim(said[-1], SEEN, "", who[:1], met)
    acts = [each["kind"] for each in draft.things[who[0]]["motions"]]
    props = {noun for act in acts for prop in list_props(act) for noun in prop.nouns}
    known = props | {one["noun"] for one in draft.things}
    draft.show(*(one for one in words if one.nouns & known))  # "on racket contact"
    return True


def is_course(token: Token) -> bool:
    """Whether a participle says where a camera may go with what it is on."""
    return any(one.value.who == "camera" for one in token.verbs("ing"))
