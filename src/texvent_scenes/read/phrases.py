"""Phrases with prepositions, and other words after a verb: what they are said of."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.read.draft.abilities import Indices
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.draft.setting import names_place, set_scene
from texvent_scenes.read.modifiers import say_word
from texvent_scenes.read.parsing.groups import Phrase, heads_of, nouns_of, words_of
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token
from texvent_scenes.read.parts import are_own_parts
from texvent_scenes.read.prepositions import (
    claim_mutual,
    claim_relation,
    dress,
    find_mutual,
    find_relation,
    go_to_place,
    is_of_particles,
    is_rained_on,
    is_rained_under,
    is_standpoint,
    keep_distance,
    names_formation,
    names_sky,
)
from texvent_scenes.read.relations import GROUNDS, SMALL, hand_over, relate_one
from texvent_scenes.read.things import name_group
from texvent_scenes.spec.data import PLACING, SPACED, WAYS

_SPOUTS = trait_values("spout").keys()


def say_after(
    draft: SceneDraft, after: Sequence[Phrase | Token], subjects: list[int], moved: list[int],
    told: list[int],
) -> None:  # fmt: skip
    """Apply what follows the verb: of "a cup on a plate on a table", the plate is on it."""
    last = NO_TOKEN
    for one in after:
        if isinstance(one, Phrase) and (
            _hangs_on_unknown(draft, one)
            or is_standpoint(draft, one)
            or are_own_parts(draft, one, subjects)
        ):
            continue
        if isinstance(one, Phrase):
            who = _find_aimed(draft, one, last, subjects)
            who = who or _find_doers(draft, one, subjects)
            who = who or _choose_placed(draft, one, last, subjects, told)
            who = [] if is_of_particles(draft, one) else who
            told = apply_phrase(draft, one, who, moved) or moved
            last = one.preposition
            keep_distance(draft, last, who)
            _push_with(draft, subjects, who)
        elif not set_scene(draft, one, told):
            is_placed = one.value("adverb")[0] == "placement"
            say_word(draft, one, told if is_placed else moved)


def _push_with(draft: SceneDraft, subjects: Indices, riders: Indices) -> None:
    """Have who is pushed in or on something pushed with it; no swing is pushed."""
    for index in subjects:
        for row in [one for one in draft.things[index]["relations"] if one["kind"] == "push"]:
            below = [one["to"] for n in riders for one in draft.things[n]["relations"]
                     if one["kind"] in ("in", "on") and n in row["to"]]  # fmt: skip
            for to in below[:1]:
                is_swing = draft.things[to[0]]["noun"] in nouns_with("swings")
                row |= {"kind": "behind" if is_swing else "push", "to": to}
                if is_swing and draft.last.verb is not None:
                    draft.mark(draft.last.verb, "lost")
                    draft.claims.pop(draft.last.verb.at, None)


def _hangs_on_unknown(draft: SceneDraft, phrase: Phrase) -> bool:
    """Whether it is part of what is not known: "a tray with glasses"."""
    before = draft.beside(phrase.preposition, -1)
    is_noun = before.is_unknown and not before.text.endswith("ly") and before is not draft.last.verb
    return phrase.preposition.text == "with" and is_noun


def _choose_placed(
    draft: SceneDraft, phrase: Phrase, last: Token, subjects: list[int], told: list[int]
) -> list[int]:
    """Objects of a phrase: of "a cup on a plate on a table" the plate, "next to" one both."""
    kind, before = phrase.preposition.relation, last.relation
    if kind == "with" and draft.beside(phrase.preposition, -1).has("noun"):
        others = {draft.things[index]["noun"] for index in {*draft.last.nearest} - {*subjects}}
        bearers = word_set("things", "laden") - word_set("things", "tables")
        if others and others <= PERSON_NOUNS | word_set("things", "vessels") | bearers:
            return draft.last.nearest  # "passes a man with a suitcase", "carries a tray with cups"
    if before == "with" and told and kind in PLACING and draft.beside(last, -1).has("place"):
        return told  # "in a room with candles on the table"
    if kind == "on" and draft.names(told) <= word_set("things", "flames"):
        return told or subjects  # "blows out the candles on a cake"
    acted = draft.targets(subjects, ("act on", "hold", "lift"))
    if kind in ("in", "on") and acted and _fill_vessels(draft, phrase, subjects):
        return acted  # "arranges flowers in a vase"
    kinds = draft.acts(subjects)
    if kind in (kinds if subjects else PLACING) or (kind == "on" and _holds_it(draft, last, told)):
        return told
    if all(one.head and names_place(one.head, kind) for one in phrase.groups):
        return subjects
    led = draft.targets(subjects, ("push", "pull"))
    if kind in ("on", "in") and draft.names(led) & PERSON_NOUNS:
        return led  # "pushes a man in a wheelchair", which it is pushed with
    if kind in ("on", "in") and before in SPACED:
        like = (one for one in subjects if draft.walks(one) == draft.walks(told[0]))
        return [*dict.fromkeys((*like, *told))]
    is_passed = before in word_set("things", "passed") | {"into", "above"}
    goes_off = draft.names(subjects) <= PERSON_NOUNS and any(map(draft.goes, subjects))
    is_passed |= before == "from" and goes_off  # "walks away from a bag on a chair"
    return told if kind in PLACING and is_passed else subjects


def _holds_it(draft: SceneDraft, last: Token, told: Indices) -> bool:
    """Whether the last phrase tells what one is in, which is put: "in a bowl on a table"."""
    held_in = [trait_value("container", draft.things[one]["noun"]) for one in told]
    return last.relation == "in" and bool(held_in) and None not in held_in


def _is_of_place(draft: SceneDraft, phrase: Phrase) -> bool:
    """Whether it names what a place has that stays there: "a room with blue walls"."""
    before = draft.beside(phrase.preposition, -1)
    nouns = [draft.nouns[one] for one in nouns_of(phrase.groups)]
    is_fixed = bool(nouns) and all(one.habitat == "fixed" for one in nouns)
    is_fixed &= phrase.preposition.relation == "with"
    return is_fixed and before.has("place") and draft.shows(before)


def _find_aimed(draft: SceneDraft, phrase: Phrase, last: Token, subjects: Indices) -> list[int]:
    """Target of a look, if a phrase follows it at once: "looks at a bird on a branch"."""
    verb, before = draft.last.verb or NO_TOKEN, draft.beside(phrase.preposition, -1)
    nearest = [one for one in draft.last.nearest if one not in subjects]
    is_at = last.text == "at" and any(map(draft.walks, nearest))  # no desk that one sits at
    is_at |= bool(draft.targets(subjects, ["towards"]))
    is_next = bool(before.nouns & draft.names(nearest)) and verb is not NO_TOKEN
    return nearest if is_at and is_next and phrase.preposition.relation in ("on", "in") else []


def _find_doers(draft: SceneDraft, phrase: Phrase, subjects: Indices) -> list[int]:
    """Subjects that do something unknown with what they hold: "tightens a bolt with a wrench"."""
    is_tool = {*nouns_of(phrase.groups)} <= SMALL and phrase.preposition.relation == "with"
    doers = draft.last.subjects if is_tool and not subjects else []
    return [one for one in doers if draft.things[one].get("is_lost")]


def _fill_vessels(draft: SceneDraft, phrase: Phrase, subjects: Sequence[int]) -> bool:
    """Whether a phrase names vessels that are too small for the people of whom it is said."""
    nouns = {*nouns_of(phrase.groups)}
    small = word_set("things", "vessels") - word_set("things", "roomy")
    return bool(nouns) and nouns <= small and draft.names(subjects) <= PERSON_NOUNS


def apply_phrase(draft: SceneDraft, phrase: Phrase, subjects: Indices, moved: Indices) -> list[int]:
    """Apply a preposition with its groups, and give what they name.

    `moved` are those that the verb moves; "behind them" is said of the nearest group.
    """
    token = phrase.preposition
    kind = find_relation(draft, phrase, subjects)
    if not phrase.groups or find_mutual(phrase.groups):
        _relate_back(draft, kind, phrase, subjects)
        return []
    is_told = _is_before_ego(draft, phrase, subjects, moved) or dress(draft, phrase, subjects)
    if is_told or names_formation(draft, phrase, subjects):
        return []
    _look_at_sky(draft, phrase, subjects)
    targets = list[int]()
    owners = subjects if kind in ("with", "in", "on") else ()  # "a car in flames"
    for group in phrase.groups:
        how = "at" if token.text == "along" else kind or token.text  # "along a corridor"
        targets += name_group(draft, group, how, owners)
    heads = heads_of(phrase.groups)
    if not targets:
        is_place = all(names_place(one, kind or token.text) for one in heads)
        if is_place and "name" in draft.parts["place"]:
            go_to_place(draft, token, heads, subjects or draft.last.nearest, moved)
        elif kind in WAYS or (not owners and any(one.head and one.head.has("effect")
                                                  for one in phrase.groups)):  # fmt: skip
            draft.mark(token, "lost")  # "over a flame"
    elif (
        (kind == "from" or (kind in ("through", "out of") and draft.names(targets[:1]) <= _SPOUTS))
        and not subjects
        and draft.effects
        and draft.may_come_from(token)
    ):
        is_all_over = draft.effects[-1]["kind"] in word_set("things", "all_over")
        draft.effects[-1]["source"] = None if is_all_over else targets[0]
        draft.show(token)
    elif kind and (subjects or kind != "with"):  # "an office with a desk"
        _relate_all(draft, token, kind, subjects, targets)
    is_own = _is_of_place(draft, phrase)
    is_lone = bool(subjects or moved or not draft.last.has_verb) and kind == "with"
    if (is_own or is_lone or not targets) and any(map(draft.shows, words_of(phrase.groups))):
        draft.mark(token, "shown") if is_own else draft.show(token)
    return targets


def _is_before_ego(
    draft: SceneDraft, phrase: Phrase, subjects: Indices, moved: Indices
) -> bool:  # fmt: skip
    """Apply "in front of the car", where a camera drives and no other car is named."""
    heads = heads_of(phrase.groups)
    nouns = {noun for one in heads for noun in one.nouns}
    is_ego = draft.is_driven and phrase.preposition.relation == "front" and bool(subjects)
    is_ego &= len(heads) == 1 and [one.article for one in phrase.groups] == ["the"]
    if not is_ego or not nouns or draft.find(nouns):
        return False
    if any(draft.nouns[one].motion != "drive" for one in nouns if one in draft.nouns):
        return False
    draft.show(heads[0], phrase.preposition)
    draft.claim(phrase.preposition, "camera", "before", [None], subjects)
    for motion in (one for n in moved for one in draft.things[n]["motions"][-1:]):
        motion.setdefault("direction", "across")
    return True


def _look_at_sky(draft: SceneDraft, phrase: Phrase, subjects: Indices) -> None:
    """See subjects before nothing but the sky, if a phrase says so: "against the sunset"."""
    if names_sky(phrase):
        draft.before_sky += subjects
        draft.claim(phrase.preposition, "sky behind", "", subjects)


def _relate_all(
    draft: SceneDraft, token: Token, kind: str, subjects: Indices, targets: Indices
) -> None:
    """Apply a preposition to all that it is said of."""
    if token.text in word_set("things", "led_along") and draft.names(targets) <= GROUNDS:
        kind = "on"  # "walks along a pier"
    if handled := hand_over(draft, token, kind, subjects, targets):
        draft.mark(token, handled)
        return
    able = () if kind == "route" else subjects
    placed = [relate_one(draft, kind, index, targets) for index in able]
    is_so = any(placed) or is_rained_on(draft, token, kind)
    is_so |= not subjects and is_rained_under(draft, token, targets)
    draft.mark(token, "shown" if is_so else "lost")
    claim_relation(draft, token, kind, subjects, targets)
    is_held = kind == "with" and {*targets} <= {*draft.targets(subjects, ["hold"])}
    draft.claim(token, "hold", "", subjects if is_held else (), targets)


def _relate_back(draft: SceneDraft, kind: str, phrase: Phrase, subjects: Indices) -> None:
    """Apply a preposition with a pronoun: "a dog passes a tree, a man behind it"."""
    nearest, token = draft.last.nearest, phrase.preposition
    if phrase.groups:
        claim_mutual(draft, [token, *find_mutual(phrase.groups)], kind, subjects)
        return
    if (before := draft.beside(token, -1)).has("place") and kind == "behind":
        draft.mark(token, "shown" if draft.shows(before) else "lost")
        return  # "with mountains behind it"
    held = draft.targets(subjects, ("wear", "hold"))  # "a man in a coat walks behind it"
    own = {*subjects, *held}
    is_many = draft.beside(token, 1).text == "them" and draft.is_many(draft.last.earlier)
    is_own = bool(set(nearest) & own) or (is_many and not draft.is_many(nearest))
    others: Indices = subjects
    about: Indices = draft.last.earlier if is_own else nearest
    if is_own and not draft.beside(token, 1).has("pronouns"):  # "with a dog running alongside"
        about = [one for one in draft.last.subjects if one not in own] or about
    people = [one for one in draft.find(PERSON_NOUNS) if one not in own]
    if draft.beside(token, 1).text in ("her", "him") and people and not {*people} & {*about}:
        about, nearest, is_own = people[-1:], [], True  # "lit by a lamp, a shelf behind her"
    is_fixed = draft.last.where and not any(map(draft.can_go, draft.last.where))
    if is_own and is_fixed and kind in word_set("things", "bearing"):
        about = draft.last.where
    if not is_own and nearest is not draft.last.before:  # "passes a tree, a dog behind it"
        others, about = nearest, subjects
    others = others if about and kind not in ("", "route") else []
    is_so = any([relate_one(draft, kind, one, about) for one in others])
    is_so |= is_rained_on(draft, token, kind)
    draft.mark(token, "shown" if is_so else "lost")
    claim_relation(draft, token, kind, others, about)
