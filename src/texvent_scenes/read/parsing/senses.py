"""Senses of nouns that have several, as the words around them decide."""

from __future__ import annotations

import itertools
import re
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

from texvent_scenes.models.activities import PERSON_NOUNS, TIMED
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, read_table, trait_value
from texvent_scenes.read.parsing.groups import is_plural_form
from texvent_scenes.read.parsing.lexicon import NounSense, Sense, expand, word_set, word_table
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token, token_at
from texvent_scenes.words import list_plurals

_LIVING = frozenset(
    name
    for table in ("bodies/birds", "bodies/quadrupeds", "bodies/sea_life", "bodies/small_animals")
    for name in read_table(table)
)
"""Nouns of animals."""
_NEAR = 3
"""Words after a noun among which its verb is."""
_COMMON = frozenset({"", "indoor", "grass", "plain"})
"""Places that tell nothing of what is there."""


def choose_senses(tokens: Sequence[Token], nouns: Mapping[str, Noun]) -> list[Token]:
    """The tokens, with the noun that an ambiguous word means where the others speak for one.

    For an animal speaks what it does, for a tool or a machine where it is and what stands by it: a
    mouse runs, or lies beside a keyboard. Where nothing does, the word is not understood.
    """
    tokens = [_see_as_young(_see_as_move(one, tokens), tokens) for one in _drop_similes(tokens)]
    tokens = [_see_as_operator(_see_as_showing(one, tokens), tokens) for one in tokens]
    tokens = [replace(one, senses=()) if _is_of_light(one, tokens) or _is_state(one, tokens)
              or _is_depicted(one, tokens) else one for one in tokens]  # fmt: skip
    named = [_see_as_mass(_see_as_verb(one, tokens), tokens) for one in tokens]
    related = [_relate(one, tokens) for one in named]
    chosen = [_choose(one, related, nouns) if not one.senses else one for one in related]
    seen = [_see_beside(one, chosen) for one in chosen]
    return [_see_as_part(one, token_at(seen, one.at - 1), nouns) for one in seen]


def _drop_similes(tokens: Sequence[Token]) -> list[Token]:
    """The tokens without senses of what something is only like: "spins like a top"."""
    found, is_like = list[Token](), False
    for token, after in zip(tokens, [*tokens[1:], NO_TOKEN], strict=False):
        found.append(replace(token, senses=()) if is_like and not token.has("articles") else token)
        is_like &= not (token.has("noun") or token.is_sign or token.text == "and")
        is_like |= token.text == "like" and after.has("articles")
    return found


def _see_as_move(token: Token, tokens: Sequence[Token]) -> Token:
    """The token without a move of the camera of which it is not said: "tracks"."""
    is_open = any(token.text in (one, *list_plurals(one)) for one in word_set("ambiguous", "words"))
    is_said = any(one.has("camera") for one in tokens[max(token.at - _NEAR, 0) : token.at])
    kept = tuple(one for one in token.senses if one.kind != "verb")
    return replace(token, senses=kept) if is_open and not is_said else token


def _see_as_young(token: Token, tokens: Sequence[Token]) -> Token:
    """The token as a size, where a young animal is meant: "a baby elephant"."""
    after = token_at(tokens, token.at + 1)
    animals = after.nouns - PERSON_NOUNS
    is_animal = any(NOUNS[one].acts or NOUNS[one].speed_m_s > 0.0 for one in animals & _LIVING)
    is_young = token.text in word_set("things", "young") and is_animal
    return replace(token, senses=(Sense("field", ("size", 0.5)),)) if is_young else token


def _see_as_operator(token: Token, tokens: Sequence[Token]) -> Token:
    """The token as the camera, if it flies that: "aerial view of a coast, the drone pulls back"."""
    before, after = token_at(tokens, token.at - 1), tokens[token.at + 1 : token.at + 1 + _NEAR]
    is_flown = token.text in word_set("things", "flown") and token.has("noun")
    is_first = token.text not in [one.text for one in tokens[: token.at]]
    if not (is_flown and is_first and before.text == "the"):
        return token
    is_aerial = any(
        one.value == ("camera", "view", "aerial") for each in tokens for one in each.all("scene")
    )
    is_aerial |= any(
        one.value == "travel forward fly" for each in tokens for one in each.all("shot")
    )
    verbs = [one for each in after[:2] for one in each.all("verb")]
    moves = {one.value.kind for one in verbs if one.value.who == "camera"}
    is_shooting = bool(moves) and not any(one.value.who != "camera" for one in verbs)
    is_camera = is_shooting or (is_aerial and bool(moves))
    return replace(token, senses=(Sense("camera", "camera"),)) if is_camera else token


def _see_as_showing(token: Token, tokens: Sequence[Token]) -> Token:
    """The token as the verb or as the word of style that it is: "shows a boy how to swim"."""
    is_filled = token_at(tokens, token.at + 1).text in ("into", "onto")
    if is_filled and token.has("effect") and token.has("verb"):  # "pouring water into a glass"
        return replace(token, senses=token.all("verb"))
    if not (token.has("style") and token.has("verb")):
        return token
    is_verb = any(one.has("infinitive") for one in tokens[token.at :])
    kind = "verb" if is_verb else "style"
    return replace(token, senses=token.all(kind))


def _is_state(token: Token, tokens: Sequence[Token]) -> bool:
    """Whether a participle says how the noun after it is anyway: "fallen leaves"."""
    after = token_at(tokens, token.at + 1)
    true_of = word_table("inherent").get(token.text, ())
    return token.has("verb") and bool(after.nouns & {*true_of})


def _is_depicted(token: Token, tokens: Sequence[Token]) -> bool:
    """Whether a noun names the subject of a drawing, which is a picture: "sketches a horse"."""
    led = [*reversed(tokens[max(token.at - _NEAR, 0) : token.at])]
    own = [*itertools.takewhile(lambda one: one.has("articles", "field"), led)]
    verb = led[len(own)].text if len(own) < len(led) else ""
    return token.has("noun") and verb in word_set("things", "depicting") and bool(own)


def _is_of_light(token: Token, tokens: Sequence[Token]) -> bool:
    """Whether it says from where light comes, not the view: "a lamp shines from above"."""
    is_view = ("camera", "view") in [one.value[:2] for one in token.all("scene")]
    if not is_view or not token.text.startswith("from "):
        return False
    signs = (one.at + 1 for one in tokens[: token.at] if one.is_sign or one.text == "and")
    said = tokens[max(signs, default=0) : token.at]
    if any(one.has("camera", "shot") or one.text in word_set("things", "viewed") for one in said):
        return False
    lit = word_set("things", "rays") | word_set("things", "lit")
    nouns = {noun for one in said for noun in one.nouns}
    lamps = {one for one in nouns & LAMPS.keys() if one in NOUNS and not NOUNS[one].speed_m_s}
    return bool(lamps) or any(one.text in lit for one in said)


def _see_as_verb(token: Token, tokens: Sequence[Token]) -> Token:
    """The token as a verb, known or not, if it says what is done: "and then darts away"."""
    before, after, then = (token_at(tokens, token.at + step) for step in (-1, 1, 2))
    forms = {one.value.is_plural for one in token.all("noun")}
    is_begun = before.text in word_set("things", "begun") or before.has("relatives")
    is_begun |= before.says("adverb", "pace") and token_at(tokens, token.at - 2).has("relatives")
    is_verb = True in forms and is_begun and not (after.has("verb") or after.text == "and")
    is_verb &= token.has("verb") or not before.says("adverb", "pace")  # "then cars drive by"
    is_verb |= bool(forms) and _goes_on(token, tokens)
    is_led = after.text in word_set("things", "particles") and (then.is_sign or then.text == "and")
    is_verb |= True in forms and is_led and not before.has("articles", "field", "relation")
    is_verb |= True in forms and bool(token.verbs("s")) and _is_after_subject(token, tokens)
    is_agreed = before.is_unknown and is_plural_form(before.text) and not after.has("noun")
    is_verb |= forms == {False} and bool(token.verbs("base")) and is_agreed  # "shadows slide"
    return replace(token, senses=token.all("verb")) if is_verb else token


def _is_after_subject(token: Token, tokens: Sequence[Token]) -> bool:
    """Whether only an article and a singular are before it in its clause: "the net swings"."""
    after, before, article, first = (token_at(tokens, token.at + n) for n in (1, -1, -2, -3))
    is_begun = first.at < 0 or first.is_sign or first.has("conjunctions")
    is_begun |= token.at == 2
    is_ended = after.is_sign or after.text == "and" or after.has("adverb") or after is NO_TOKEN
    is_one = not (before.has("field") or is_plural_form(before.text) or before.is_sign)
    return is_begun and article.has("articles") and is_one and is_ended


def _goes_on(token: Token, tokens: Sequence[Token]) -> bool:
    """Whether it is a second act of a subject: "stands there and watches", no list of things."""
    conjunction, before = (token_at(tokens, token.at + step) for step in (-1, -2))
    if conjunction.text != "and":
        return False
    signs = (one.at + 1 for one in tokens[: token.at] if one.is_sign)
    said = tokens[max(signs, default=0) : max(token.at - 1, 0)]
    verbs = (*token.verbs("s"), *token.verbs("base"))
    acts = [one for one in said if one.verbs("s") or one.verbs("base") or _is_new_verb(one, said)]
    is_moved = _is_way(token_at(tokens, token.at + 1))
    is_listed = any(one.value.is_plural for one in before.all("noun"))
    is_listed &= not (is_moved or _is_apart(token, said, tokens))
    is_act = bool(verbs) and (bool(acts) or is_moved)
    return is_act and not is_listed


def _is_new_verb(token: Token, said: Sequence[Token]) -> bool:
    """Whether an unknown word is a verb by its ending and place: "foam spreads over the stones"."""
    if not (token.is_unknown and is_plural_form(token.text)):
        return False
    at = next(n for n, one in enumerate(said) if one is token)
    before, after = (said[n] if 0 <= n < len(said) else NO_TOKEN for n in (at - 1, at + 1))
    is_after_subject = before.has("noun") or (before.is_unknown and not before.is_sign)
    return is_after_subject and after.has("relation", "adverb")


def _is_way(token: Token) -> bool:
    """Whether it begins with an adverb of a way: "back into"."""
    return token.has("adverb") or token.text.split()[0] in word_set("things", "returns")


def _is_apart(token: Token, said: Sequence[Token], tokens: Sequence[Token]) -> bool:
    """Whether it is in no list: the things before have an article, and a preposition follows."""
    words = [one for one in said[-_NEAR:] if one.has("articles", "relation", "verb")]
    has_article = bool(words) and words[-1].has("articles")
    return has_article and token_at(tokens, token.at + 1).has("relation")


def _see_as_mass(token: Token, tokens: Sequence[Token]) -> Token:
    """The token as a word that is not known, if it is no thing.

    As in "behind dusty glass", "a remote controlled car", "with a leaf pattern".
    """
    after, then = (token_at(tokens, token.at + step) for step in (1, 2))
    nouns = token.nouns
    ends = {one.text.rpartition(" ")[2] for one in tokens[token.at + 2 : token.at + 4]}
    if nouns and after.text == "of" and ends & word_set("things", "rays"):
        return replace(token, senses=())  # "a narrow cone of warm light"
    is_means = after.is_unknown and after.text.endswith("ed") and then.has("noun")
    is_means &= not any(one in NOUNS and NOUNS[one].speed_m_s for one in nouns)
    is_print = after.text in word_set("things", "prints")
    is_print &= not nouns & (nouns_with("flat pattern") | word_set("things", "patterned"))
    if nouns and (is_means or is_print):
        return replace(token, senses=())
    led = [one for one in tokens[: token.at] if one.has("relation", "articles", "small", "verb")]
    before, last = ([NO_TOKEN, NO_TOKEN, *led])[-2:]
    is_thing = last.has("articles", "verb") and {last.text, before.text} != {"the", "through"}
    if last.text == "between" and token.has("field") and nouns:
        return replace(token, senses=token.all("field"))  # "between orange and shadow"
    if token_at(tokens, token.at - 1).text in word_set("things", "copulas") and token.has("field"):
        return replace(token, senses=token.all("field")) if nouns else token  # "the sky is orange"
    is_mass = token.text in word_set("things", "masses")
    return token if is_thing or not is_mass else replace(token, senses=())


def _see_as_part(token: Token, before: Token, nouns: Mapping[str, Noun]) -> Token:
    """The token as a word that adds nothing, if it is a part: "a fridge door", "a chair leg"."""
    owners = [nouns[one.value.noun] for one in before.all("noun")]
    is_part = token.text in word_set("things", "leaves") and any(one.acts & TIMED for one in owners)
    is_part |= bool(owners) and token.text in word_set("things", "inert")
    return replace(token, senses=(Sense("hollow", "hollow"),)) if is_part else token


def _see_beside(token: Token, tokens: Sequence[Token]) -> Token:
    """The token, with the noun that it means beside some others: the platform of a train."""
    senses, table = [one.value for one in token.all("noun")], word_table("beside")
    singular = token.text if senses and not senses[0].is_plural else ""
    rows = table.get(singular) or table.get(senses[0].noun if senses else token.text, ())
    if not rows:
        return token
    others = {noun for one in tokens for noun in one.nouns}
    others |= {re.sub(r"['’]s$", "", one.text) for one in tokens}
    others |= {one.value[1] for each in tokens for one in each.all("pose")}
    others |= {one.value.kind for each in tokens for one in each.all("verb")}
    row = next(
        (one for one in rows if _speaks_for(one, others, _words_before(token, tokens))), None
    )
    is_led = token_at(tokens, token.at - 1).has("articles", "field")  # no camera's "pan"
    if row is None or not (senses or token.is_unknown or is_led):
        return token
    if "place" in row:
        return replace(token, senses=(Sense("place", row["place"]),))
    sense = replace(senses[0] if senses else NounSense(""), noun=row["noun"])
    sense = replace(sense, is_kind=sense.is_kind or row.get("is_kind", False))
    sense = replace(
        sense, is_plural=sense.is_plural or token.text in list_plurals(sense.noun or "-")
    )
    return replace(token, senses=(Sense("noun", sense),) if sense.noun else ())


def _speaks_for(row: Mapping[str, Any], others: Collection[str], before: str) -> bool:
    """Whether the other words of a prompt, and those right before, speak for a row's noun."""
    led = [one for each in row.get("after", [""]) for one in expand(each)]
    is_beside = bool({*others} & {*row.get("nouns", others)})
    is_beside &= {*others}.isdisjoint(row.get("without", ()))
    return is_beside and any(before.endswith(f"{one} ") for one in led)


def _words_before(token: Token, tokens: Sequence[Token]) -> str:
    """The words before a token, without articles, each after a space: " cars wait at red"."""
    led = tokens[max(token.at - 2 * _NEAR, 0) : token.at]
    return "".join(f" {one.text}" for one in led if not one.has("articles")) + " "


def _relate(token: Token, tokens: Sequence[Token]) -> Token:
    """The token as the preposition that it is before a noun group: "round a fire"."""
    like = word_table("like")
    before, following = (token_at(tokens, token.at + step) for step in (-1, 1))
    if token.text not in like or before.has("articles") or not following.has("articles"):
        return token
    return replace(token, senses=(Sense("relation", like[token.text]),))


def _choose(token: Token, tokens: Sequence[Token], nouns: Mapping[str, Noun]) -> Token:
    found = find_nouns(token.text, nouns)
    after = tokens[token.at + 1 : token.at + 1 + _NEAR]
    kinds = {one.value.kind for each in after for one in each.all("verb")}
    led = tokens[max(token.at - 2, 0) : token.at]  # "chases a mouse"
    is_led = any(one.value.relation == "follow" for each in led for one in each.all("verb"))
    kinds |= {"move"} if is_led else set()
    places = {one.value for each in tokens for one in each.all("place")}
    places |= {one.value[-1] for each in tokens for one in each.all("scene")}  # "in space"
    others = {noun for one in tokens for noun in one.nouns}
    scores = Counter({name: _score(nouns[name], kinds, places, others, nouns) for name in found})
    (best, score), (_, second) = [*scores.most_common(2), ("", 0), ("", 0)][:2]
    if score <= second:
        return token
    is_kind = token.text not in (best, *list_plurals(best))
    return replace(token, senses=(Sense("noun", NounSense(best, found[best], is_kind)),))


def find_nouns(word: str, nouns: Mapping[str, Noun]) -> dict[str, bool]:
    """Nouns that an ambiguous word may mean, such as "computer mouse" → whether it is a plural."""
    said = sorted(one for one in word_set("ambiguous", "words")
                  if word in (one, *list_plurals(one)))  # fmt: skip
    return {
        noun.name: word != one
        for one in said
        for noun in nouns.values()
        if any(f" {name}".endswith(f" {one}") for name in (noun.name, *noun.synonyms))
    }


def _score(
    noun: Noun, kinds: Collection[str], places: Collection[str], others: Collection[str],
    nouns: Mapping[str, Noun],
) -> int:  # fmt: skip
    """Points for a noun: two for what it does, one each for where it is and what is beside it."""
    does = {noun.motion, *noun.acts, *(("run", "jump", "move") if noun.speed_m_s else ())}
    does |= {"work", "spin"} if noun.is_working else set()
    home = trait_value("usual place", noun.name) or noun.place
    support = trait_value("usual support", noun.name) or ()
    alike = {one for one in others if one in nouns and home == nouns[one].place}
    beside = {one for one in others if trait_value("usual support", one) == support}
    is_doing = bool(does - {"stand"} & {*kinds})
    is_there = home in {*places} - _COMMON or bool(alike if home not in _COMMON else ())
    return 2 * is_doing + is_there + bool({*support} & {*others} or (support and beside))
