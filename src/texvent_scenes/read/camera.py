"""Clauses about the camera: which they are, how they move it, and past what."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.read.draft.abilities import MEANS, Indices
from texvent_scenes.read.draft.scene_draft import SceneDraft, split_move, turn_by
from texvent_scenes.read.draft.setting import names_place, set_scene
from texvent_scenes.read.parsing.clauses import Clause
from texvent_scenes.read.parsing.groups import Group, Phrase, heads_of, nouns_of
from texvent_scenes.read.parsing.lexicon import Sense, lexicon_of, word_set, word_table
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token
from texvent_scenes.read.phrases import apply_phrase
from texvent_scenes.read.prepositions import is_standpoint, looks_at_contact
from texvent_scenes.read.things import name_group

_STAYING = frozenset({"handheld", "roll", "truck"})
"""Moves of a camera over what it looks at."""
_TURNS = frozenset({"pan", "tilt"})
"""Moves of a camera that stays where it is."""
_MOUTHS = {"into": "centre", "out of": "near"}
"""Way of a camera through one end of a passage → the passage's placement."""
_DRIVEN = "travel forward drive"
"""Shot from a vehicle on a road."""
_FIRST_PERSON = ("camera", "view", "first person")


def is_ego(draft: SceneDraft, clause: Clause) -> bool:
    """Whether a camera goes that is not named: "driving through a city"."""
    verbs = clause.verb.verbs("ing") if clause.verb is not None else ()
    travels = any(one.value.kind.startswith("travel") for one in verbs)
    travels |= draft.is_driven and any(one.value.kind in ("follow", "dolly in") for one in verbs)
    is_place = all(one.head and names_place(one.head, "") for one in clause.subjects)
    before = draft.beside(clause.verb or NO_TOKEN, -1)
    kinds = {one.value[1] for one in before.all("scene")} | {one.kind for one in before.senses}
    is_own = before.is_unknown or kinds & {"noun", "effect", "verb", "weather"}
    if is_own and not kinds & {"shot", "style"}:
        return False  # "rain drops running down a pane"
    is_new = not draft.things and clause.about not in ("nearest", "company")
    return travels and is_place and is_new


def sit_in(draft: SceneDraft, clause: Clause) -> Clause | None:
    """The clause of a driver's view of who goes through a passage, said of the camera itself.

    As in "a car exits a tunnel, dashcam view", "a car drives along a road seen through the
    windscreen", "dashcam view entering a tunnel"; None: no camera is in that vehicle.
    """
    said = [(token, sense.value) for token in draft.tokens for sense in token.all("shot")]
    shots = {value for _, value in said}
    nouns = nouns_of(clause.subjects)
    is_driven = not clause.subjects or [draft.nouns[one].motion for one in nouns] == ["drive"]
    is_driven &= not any(group.is_plural for group in clause.subjects)
    if _DRIVEN not in shots or draft.things or not (is_driven and clause.verb):
        return None
    head = (clause.subjects[0].head if clause.subjects else None) or NO_TOKEN
    drive = lexicon_of(draft.nouns)[("driving",)]
    led = [one.value.relation for one in clause.verb.all("verb")]
    first = Phrase(replace(clause.verb, senses=_passed(led)), clause.objects)
    after = [one if isinstance(one, Token) or not _names_passage(one.groups) else
             Phrase(replace(one.preposition, senses=_passed(one.preposition.relations)), one.groups)
             for one in (first, *clause.after) if isinstance(one, Token) or one.groups]  # fmt: skip
    is_own = any((one.value.who, one.value.kind, one.value.relation) == ("plain", "drive", None)
                 for one in clause.verb.all("verb"))  # fmt: skip
    is_own &= {*nouns} <= nouns_with("closed") and not any(
        one.says("adverb", "direction") for one in clause.after if isinstance(one, Token)
    )
    is_own &= any(_is_own_pane(token) for token, _ in said) and head.text in nouns
    if not (is_own or any(isinstance(one, Phrase) and _names_passage(one.groups) for one in after)):
        return None
    if clause.subjects:
        draft.mark(head, "camera")
    verb = replace(clause.verb, senses=drive)
    return replace(clause, subjects=(), objects=(), verb=verb, after=tuple(after))


def _passed(relations: Iterable[str | None]) -> tuple[Sense, ...]:
    """Sense of a way through a passage, or through one of its ends."""
    return (Sense("relation", next((one for one in relations if one in _MOUTHS), "through")),)


def _is_own_pane(token: Token) -> bool:
    """Whether a shot is through the pane of a vehicle of which no more is said."""
    words = {*token.text.split()}
    return not words.isdisjoint(word_set("things", "panes")) and "another" not in words


def look_out(draft: SceneDraft, clause: Clause) -> Clause | None:
    """The clause of a first-person view of who goes somewhere, said of the camera itself.

    "First-person view of a drone flying through a forest"; None: it is another view or an act.
    """
    said = {sense.value for token in draft.tokens for sense in token.all("scene")}
    (first, *others) = clause.subjects or (None,)
    verb = clause.verb
    if _FIRST_PERSON not in said or first is None or others or verb is None:
        return None
    known = [one["noun"] for one in draft.things]
    if known and not (clause.about == "company" and first.noun and known == [first.noun.noun]):
        return None
    goes = [one for one in verb.all("verb") if one.value.who == "camera"]
    is_going = any(one.value.kind.startswith("travel") for one in goes) and not clause.objects
    if first.noun is None or first.is_plural or first.head is None or not is_going:
        return None
    if not draft.nouns[first.noun.noun].speed_m_s:
        return None
    draft.mark(first.head, "camera")
    draft.things.clear()
    draft.claims.clear()
    means = {"fly": "flying", "drive": "driving"}.get(draft.nouns[first.noun.noun].motion)
    if means and not any(one.value.kind in MEANS for one in verb.all("verb")):  # "cruises"
        verb = replace(verb, senses=lexicon_of(draft.nouns)[(means,)])
    return replace(clause, subjects=(), about="", verb=verb)


def _names_passage(groups: Sequence[Group]) -> bool:
    """Whether some of the groups name what has a way through."""
    return bool({*nouns_of(groups)} & nouns_with("passage"))


def goes_itself(draft: SceneDraft, clause: Clause) -> bool:
    """Whether what a camera follows does what a clause says: "follows a ball as it rolls"."""
    follows = bool(draft.moves) and draft.moves[-1]["kind"] == "follow" and clause.about == "same"
    verb = clause.verb or NO_TOKEN
    does = any(one.value.who != "camera" for one in verb.all("verb"))
    is_named = draft.beside(verb, -1).has("pronouns")
    return follows and does and is_named and any(map(draft.can_go, draft.last.subjects))


def is_shot(clause: Clause) -> bool:
    """Whether a clause without a subject goes on about a shot: "6-DoF motion over a poster"."""
    if clause.subjects or clause.objects or clause.about not in ("", "same"):
        return False
    adverbs = [one for one in clause.after if isinstance(one, Token) and one.has("adverb")]
    if any(one.says("adverb", "speed_m_s") for one in adverbs):
        return False  # it is that of the view
    words = [one for one in clause.after if one not in adverbs]
    first = words[0] if words else None
    if not isinstance(first, Token) or not (first.has("shot") or first.says("scene", "camera")):
        return False
    return clause.verb is None or first.at < clause.verb.at


def apply_to_camera(draft: SceneDraft, clause: Clause, *, is_own: bool) -> None:
    """Move the camera as a clause says, and name what is in view."""
    targets = list[int]()
    move = find_move(draft, clause)
    ways = split_move("follow"), split_move("dolly in")
    is_led = move in ways and draft.is_driven
    for group in clause.subjects if clause.about != "company" else ():
        name_group(draft, group, "in")
    for group in clause.objects if is_led or not is_own else ():
        targets += name_group(draft, group)
    move = None if is_led and _lead_on(draft, clause, targets) else move
    _lead_followed(draft, move, targets)
    for one in clause.after:
        if not isinstance(one, Phrase):
            draft.show(*([one] if one.text in ("by", "to") else []))
            set_scene(draft, one)
        elif (
            is_standpoint(draft, one, move or {})
            or looks_at_contact(draft, one)
            or (move is not None and _go_along(draft, clause, move, one))
        ):
            continue
        elif targets:  # as "orbits a car in front of a house"
            apply_phrase(draft, one, targets, targets)
        else:
            targets += _see_past(draft, move, one)
    if move is not None:
        _make_move(draft, clause.verb or NO_TOKEN, move, targets)
    for one in (each for each in clause.after if isinstance(each, Token)):
        field, value = one.value("adverb")
        if field == "end_pace" and draft.quicken(value):
            draft.show(one)


def _make_move(draft: SceneDraft, verb: Token, move: dict[str, Any], targets: list[int]) -> None:
    """Add a move of the camera, which looks at some things."""
    if verb.text in word_set("things", "keeping"):
        _keep_in_view(draft, verb, targets)
    if move != split_move("follow") or move not in draft.moves:
        draft.add_move(move)
    if targets:
        draft.parts["camera"].setdefault("target", targets[0])
    if targets and move["kind"] == "follow":
        draft.last.subjects = targets
    _lead_followed(draft, move, targets)


def _keep_in_view(draft: SceneDraft, verb: Token, targets: Indices) -> None:
    """Leave it to the staged scene whether something stays in the image; a pan to it follows it."""
    after, persons = draft.tokens[verb.at + 1 :], draft.find(PERSON_NOUNS)
    meant = next((one.text for one in after[:3] if one.text in ("it", "him", "her", "them")), "")
    known = [*draft.last.subjects, *draft.last.nearest, *range(len(draft.things))]
    fits = [one for one in known if (one in persons) == (meant != "it")] if meant else known
    if meant == "them":
        several = [one for one in known if draft.things[one]["count"] > 1]
        fits = [one for one in several if one in persons] or several
    about = targets or (fits or known)[:1]
    for token in (verb, *[one for one in after if one.is_framed][:1]):
        is_centred = not word_set("things", "centred").isdisjoint(token.text.split())
        draft.claim(token, "in image", "centre" if is_centred else "", about)
    if about and len(draft.things) > 1:
        draft.parts["camera"].setdefault("target", about[0])
    for token in draft.tokens[: verb.at]:
        senses = [one.value for one in token.all("verb") if one.value.who == "camera"]
        if {one.kind.split()[0] for one in senses} & _TURNS and draft.shows(token):
            draft.mark(token, "follow")
            draft.moves[:] = [one for one in draft.moves if one["kind"] not in _TURNS]


def _see_past(draft: SceneDraft, move: dict[str, Any] | None, phrase: Phrase) -> list[int]:
    """Name what a phrase says of a camera's way: what the camera looks at of it."""
    token = phrase.preposition
    found, kind = apply_phrase(draft, phrase, [], []), token.relation
    is_driven = draft.is_driven or (move or {}).get("means") == "drive"
    if is_driven and kind == "behind" and _go_ahead(draft, token, found):
        return []
    turns = move is not None and move["kind"] in ("pan", "tilt")
    is_swept = turns and token.text in word_set("things", "swept")
    is_side = bool(found) and kind in word_set("things", "sides") and not is_swept
    if found and kind in ("through", "into", "out of"):
        ahead = move or next(iter(draft.moves[-1:]), None)  # "forward motion through a tunnel"
        is_led = ahead is not None and go_through(draft, ahead, token, found)
        is_side = not is_led and (kind != "into" or (ahead or {}).get("kind") == "travel")
    is_over = look_over(draft, token, found)
    is_low = kind == "above" and _keeps_to_ground(draft, move)
    claim_way(draft, move, token, [] if is_over or is_low else found)
    is_side = not is_over and (is_side or _is_beside_way(draft, move, phrase, found))
    draft.mark(token, "lost" if is_side or (bool(found) and is_low) else "shown")
    return found if kind in word_set("things", "aims") or is_swept else []


def _is_beside_way(
    draft: SceneDraft, move: Mapping[str, Any] | None, phrase: Phrase, found: Indices
) -> bool:
    """Whether nothing is put where a phrase says: before who drives, up a hill, into a place."""
    kind, heads = phrase.preposition.relation, heads_of(phrase.groups)
    words = heads or [each for group in phrase.groups for each in group.unknown]
    is_side = bool(phrase.groups) and not any(map(draft.shows, words))
    is_side |= kind == "front" and any(each["kind"] == "travel" for each in draft.moves)
    is_place = any(each.has("place") for each in heads)
    is_side |= is_place and not found and kind in ("out of", "into")  # it stays there
    goes = any(each["kind"] == "travel" for each in (*draft.moves, move or {"kind": ""}))
    return is_side or (goes and bool(found) and kind in ("up", "down"))  # it keeps its height


def _lead_on(draft: SceneDraft, clause: Clause, targets: Indices) -> bool:
    """Whether a camera that drives goes after what it follows, or towards what it approaches."""
    verb = clause.verb or NO_TOKEN
    if not any(one.value.kind == "dolly in" for one in verb.all("verb")):
        return _go_ahead(draft, clause.verb, targets)
    draft.claim(verb, "camera", "towards", [None], targets)  # "approaching a bridge"
    return True


def _lead_followed(draft: SceneDraft, move: Mapping[str, Any] | None, targets: Indices) -> None:
    """Let things go that a camera follows."""
    followed = targets if move is not None and move["kind"] == "follow" else []
    for index in filter(draft.can_go, followed):
        thing = draft.things[index]
        thing["motions"] = thing["motions"] or [{"kind": "move"}]


def _keeps_to_ground(draft: SceneDraft, move: Mapping[str, Any] | None) -> bool:
    """Whether a camera goes over ground, and so over nothing that stands there."""
    travels = [one for one in (*draft.moves, move or {}) if one.get("kind") == "travel"]
    return bool(travels) and all(one.get("means") not in ("fly", None) for one in travels)


def _go_ahead(draft: SceneDraft, token: Token | None, targets: Indices) -> bool:
    """Let vehicles go before a camera that drives behind them; whether they can."""
    is_so = token is not None and bool(targets)
    is_so &= all(draft.noun(one).motion == "drive" for one in targets)
    for index in targets if is_so else ():
        draft.things[index]["motions"] = [{"kind": "drive", "direction": "away"}]
    if token is not None and is_so:
        draft.show(token)
        draft.claim(token, "camera", "before", [None], targets)
    return is_so


def find_move(draft: SceneDraft, clause: Clause) -> dict[str, Any] | None:
    """The move of a clause with its direction and pace; these words are counted as shown.

    None where the verb is no move of a camera.
    """
    verb = clause.verb
    senses = [one.value for one in verb.all("verb")] if verb is not None else []
    moves = [one.kind for one in senses if one.who == "camera"]
    if verb is None or not moves:
        return None
    draft.show(verb)
    move = split_move(moves[0])
    turned = word_table("turned_moves")
    for one in clause.after:
        if isinstance(one, Phrase):
            move = _lead(move, one)
            continue
        name, value = one.value("adverb")
        if name == "direction":
            phrase = f"{move['kind']} {value}"
            side = split_move(turned.get(phrase, phrase))
            name, move = ("pace", move | side) if "direction" in side else ("", move)
        elif name in ("pace", "speed_m_s"):
            move[name] = move.get("pace", 1.0) * value if name == "pace" else value
        elif (led := turn_by(move, name, value)) != move:
            name, move = "pace", led
        if name in ("pace", "speed_m_s"):
            draft.show(one)
    means = [one.kind for one in senses if one.who == "plain" and one.kind in MEANS]
    if move["kind"] == "travel" and means:
        move["means"] = means[0]
    return move


def _lead(move: dict[str, Any], phrase: Phrase) -> dict[str, Any]:
    """The move after a preposition: around what it shows, towards it, or ahead through a place."""
    preposition, heads = phrase.preposition, [group.head for group in phrase.groups]
    kinds, pace = preposition.relations, move.get("pace", 1.0)
    if preposition.text == "around" and move["kind"] in ("truck", "travel"):
        return {"kind": "orbit", "pace": pace}
    is_open = move["kind"] == "truck" and "direction" not in move
    if move["kind"] in ("tilt", "pan") and "direction" not in move:
        return move | split_move(f"{move['kind']} {preposition.text.partition(' ')[0]}")  # "up to"
    is_place = bool(heads) and all(head and names_place(head, preposition.text) for head in heads)
    if is_open and is_place and preposition.text in word_set("things", "onward"):
        return {**split_move("travel forward"), "pace": pace}
    return {**split_move("dolly in"), "pace": pace} if is_open and "towards" in kinds else move


def go_through(
    draft: SceneDraft, move: dict[str, Any], preposition: Token, targets: Indices
) -> bool:
    """Lead a camera that goes ahead through what has a way through, or out; whether it has one."""
    is_ahead = move["kind"] == "travel" or split_move("dolly in").items() <= move.items()
    nouns = draft.names(targets)
    if move.get("means") == "fly" or not (is_ahead and nouns <= nouns_with("passage")):
        return False
    if move["kind"] == "dolly":
        move |= split_move("travel forward") | {"means": "walk"}
    is_open = nouns <= nouns_with("fits who goes through")
    way = preposition.relation or ""
    mouth = _MOUTHS.get(way)
    draft.claim(preposition, "camera mouth", way, [None] if mouth else [], targets)
    for thing in (draft.things[one] for one in targets):
        opens = "stand open" in draft.nouns[thing["noun"]].acts
        thing["motions"] = thing["motions"] or [{"kind": "stand open"}] * opens
        thing |= {"placement": mouth} if mouth and is_open else {}
    return True


def claim_way(
    draft: SceneDraft, move: dict[str, Any] | None, preposition: Token, targets: Indices
) -> None:
    """Leave it to the staged camera whether it goes or turns so with respect to a thing."""
    kinds = preposition.relations & word_set("things", "camera_ways")
    kinds |= {"past"} if preposition.text == "across" else set()
    led = _list_led(draft, move, preposition, targets) if move is not None else []
    if move is not None and len(led) == 1:
        move.clear()
        move |= {"kind": "follow"}
        draft.parts["camera"] |= {"view": "front", "target": led[0]}
        draft.claim(preposition, "camera", "before", [None], led)
        return
    is_led = move is not None and move["kind"] not in ("follow", "zoom", "handheld", "static")
    for kind in sorted(kinds)[:1] if is_led and targets else ():
        draft.claim(preposition, "camera", kind, [None], targets)


_ALONGSIDE = {"with": None, "beside": "side", "behind": "back"}
"""Relations to what a camera goes along with → its view of that."""


def _go_along(draft: SceneDraft, clause: Clause, move: dict[str, Any], phrase: Phrase) -> bool:
    """Let a camera follow what it goes with: "pans with it", "moves alongside a car".

    A pan is then shown as following.
    """
    token = phrase.preposition
    kind = next(iter(token.relations & _ALONGSIDE.keys()), "")
    is_meant = draft.beside(token, 1).has("pronouns")
    is_meant |= not phrase.groups and move["kind"] == "follow"  # "follows behind"
    nouns = nouns_of(phrase.groups)
    goes = bool(nouns) and all(draft.nouns[one].speed_m_s for one in nouns)
    ways = {each.value("adverb") for one in phrase.groups for each in one.modifiers}
    goes &= ("direction", "towards") not in ways  # "oncoming cars"
    if not (kind and (is_meant or goes) and _can_go_along(draft, clause, move, kind)):
        return False
    about = [*draft.last.subjects, *draft.last.nearest, *range(len(draft.things))]
    found = [index for group in phrase.groups for index in name_group(draft, group)]
    led = [one for one in (found if nouns else about) if draft.can_go(one)][:1]
    if not led:
        return False
    if move["kind"] == "pan" and clause.verb is not None:
        draft.mark(clause.verb, "follow")
    for motion in (draft.things[led[0]]["motions"] if "direction" in move else ())[-1:]:
        motion["direction"] = move["direction"]  # "pans with it from left to right"
    move.clear()
    move |= {"kind": "follow"}
    draft.parts["camera"]["target"] = led[0]
    if _ALONGSIDE[kind] is not None:
        draft.parts["camera"].setdefault("view", _ALONGSIDE[kind])
    _lead_followed(draft, move, led)
    draft.show(token)
    draft.claim(token, "camera", "before", [None], led)
    return True


def _can_go_along(draft: SceneDraft, clause: Clause, move: Mapping[str, Any], kind: str) -> bool:
    """Whether a move may follow what goes; one on a road goes after vehicles in its own way."""
    if move["kind"] == "static":
        return (clause.verb or NO_TOKEN).text in word_set("things", "stays")
    is_apart = move["kind"] == "travel" and not draft.is_driven and move.get("means") != "drive"
    able = ("pan", "truck", "travel", "follow")
    return move["kind"] == "follow" or is_apart if kind == "behind" else move["kind"] in able


def _list_led(
    draft: SceneDraft, move: Mapping[str, Any], preposition: Token, targets: Indices
) -> list[int]:
    """Things that come along behind a camera: "walks backward in front of her"."""
    kinds, after = {one.value for one in preposition.all("relation")}, preposition.at + 1
    is_back = move["kind"] == "travel" and move.get("direction") == "backward"
    if not (is_back and "front" in kinds):
        return []
    is_meant = after < len(draft.tokens) and draft.tokens[after].has("pronouns")
    about = range(len(draft.things)) if is_meant else targets
    return [index for index in about if draft.goes(index)]


def look_over(draft: SceneDraft, preposition: Token, targets: Indices) -> bool:
    """Let a camera that stays about look down on things, or at the face of what is upright."""
    kinds = preposition.relations
    moves = {one["kind"] for one in draft.moves}
    if "above" not in kinds or not targets or not moves or moves - _STAYING:
        return False
    upright = nouns_with("upright") | nouns_with("flat pattern")
    is_faced = draft.names(targets) <= upright
    if not is_faced:
        draft.parts["camera"].setdefault("view", "top")
    draft.claim(preposition, "camera", "before" if is_faced else "over", [None], targets)
    return True
