"""Parts and marks in a draft: what things have, and which of them are so."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.description import SEEN
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.read.draft.abilities import Indices
from texvent_scenes.read.draft.scene_draft import BLINK_HZ, SceneDraft
from texvent_scenes.read.parsing.groups import Group, Phrase, words_of
from texvent_scenes.read.parsing.lexicon import word_set, word_table
from texvent_scenes.read.parsing.tokens import Token


def are_own_parts(draft: SceneDraft, phrase: Phrase, subjects: Indices) -> bool:
    """Whether it names what a thing has, "a fan with four blades", or the tool of its act.

    No other number is shown.
    """
    words = words_of(phrase.groups)
    if phrase.preposition.text == "with" and draft.names_tool(subjects, words):
        draft.show(phrase.preposition, *words)
        return True
    if phrase.preposition.text in ("with", "on") and _take_mark(draft, phrase, subjects):
        return True
    if phrase.preposition.text == "with" and subjects and _are_built_in(draft, phrase, subjects):
        return True
    is_so = phrase.preposition.text == "with" and say_parts(draft, phrase.groups, subjects)
    if is_so and all(draft.shows(one) for one in words if one.text != "and"):
        draft.show(phrase.preposition)
    return is_so


def _take_mark(draft: SceneDraft, phrase: Phrase, subjects: Indices) -> bool:
    """Let things be those that have a mark, "a disc with a white dot"; "on a blade" it is there."""
    marks = word_table("marks")
    words = words_of(phrase.groups[:1])
    nouns = draft.names(subjects)
    if phrase.preposition.text == "on":
        bears = [word_table("bearers").get(one.text, ()) for one in words]
        is_there = bool(nouns) and any(nouns <= {*one} for one in bears)
        draft.show(*((phrase.preposition, *words) if is_there else ()))
        return is_there
    fields = [one.value for word in words for one in word.all("field")]
    said = [f"{value:g}" if field == "count" else str(value) for field, value in fields]
    names = [f"{each} {word.text}" for word in words for each in said]
    names += [word.text for word in words]
    found = {marks[noun][name] for noun in nouns if noun in marks for name in names
             if name in marks[noun]}  # fmt: skip
    if len(nouns) != 1 or len(found) != 1 or len(phrase.groups) != 1:
        return False
    for thing in (draft.things[index] for index in subjects):
        if draft.nouns[thing["noun"]].is_working and not draft.nouns[next(iter(found))].is_working:
            thing["motions"] = thing["motions"] or [{"kind": "spin"}]
        thing["noun"] = next(iter(found))
    draft.show(phrase.preposition, *words)
    is_any = not any(" " in name for noun in nouns for name in names if name in marks[noun])
    for word in words if is_any else ():
        for field, value in (one.value for one in word.all("field")):
            draft.claim(word, "colour", value, subjects if field == "colour" else [])
    return True


def _are_built_in(draft: SceneDraft, phrase: Phrase, subjects: Indices) -> bool:
    """Whether it names parts and patterns that are not drawn: "a bus with two doors"."""
    nouns = [one.noun.noun if one.noun else "" for one in phrase.groups]
    is_own = any(word.text in word_table("parts") for word in words_of(phrase.groups))
    flat, is_body = nouns_with("flat pattern"), not any(map(draft.walks, subjects))
    is_flat = any(draft.things[one]["noun"] in flat for one in subjects)
    inner = word_set("things", "built_in") | (frozenset() if is_flat else flat)  # "with stripes"
    return bool(nouns) and {*nouns} <= inner and is_body and not is_own


def say_parts(draft: SceneDraft, groups: Sequence[Group], subjects: Indices) -> bool:
    """Account for parts that things have, if all groups name some: "its second hand moving"."""
    owned, words = word_table("parts"), [one.words for one in groups]
    parts = [next((name for word in each for name in (word.text, f"{word.text}s")
                   if name in owned), "") for each in words]  # fmt: skip
    if not subjects or not parts or not all(parts):
        return False
    nouns = {draft.things[one]["noun"] for one in subjects}
    if all(one.noun for one in groups) and not any(nouns & owned[one].keys() for one in parts):
        return False  # "a man with candles"
    for part, group, each in zip(parts, groups, words, strict=True):
        counts = {one.value[1] for word in each for one in word.all("field")
                  if one.value[0] == "count"}  # fmt: skip
        if group.article in ("a", "an") and not group.is_plural:
            counts |= {1} if draft.counts_parts(subjects, part) else set()
        has = [one for one in subjects if draft.things[one]["noun"] in owned[part]]
        usual = {one: owned[part][draft.things[one]["noun"]] for one in has}
        drawn = {draft.count_part(one, part, counts, usual[one]) for one in has}
        for word in each if has and counts <= drawn else ():
            _say_of_part(draft, word, part, has)
    return True


def _say_of_part(draft: SceneDraft, word: Token, part: str, owners: Indices) -> None:
    """Account for a word about a part; whether it moves, shines or has a colour is to be seen.

    Lamps that do not blink are steady, whatever is said of them: "headlights approaching".
    """
    is_lamp = part in word_set("things", "lamps")
    fields = dict(one.value for one in word.all("field"))
    if word.has("verb") and not word.has("noun", "field"):
        acts = [one.value for one in word.all("verb") if one.value.who == "lamp"]
        blinks = is_lamp and any(one.kind == "blink" for one in acts)
        if part in word_set("things", "stiff_parts") and not blinks:
            return
        kind = "blink" if blinks else "shine" if is_lamp else "parts"
        draft.claim(word, kind, "", owners)
        for one in (draft.things[n] for n in owners if part in word_set("things", "bare_parts")):
            is_flyer = draft.nouns[one["noun"]].motion == "fly"
            one["motions"] = one["motions"] or [{"kind": "hover"}] * is_flyer  # "its rotor turning"
        for one in (draft.things[n] for n in owners if is_lamp):
            if not any(lamp.own_hz for lamp in LAMPS.get(one["noun"], ())):
                one |= {"is_lit": True, **({"blink_hz": BLINK_HZ} if blinks else {})}
                goes = [{"kind": "move", "direction": "towards"}]
                can_go = draft.nouns[one["noun"]].speed_m_s > 0.0
                one["motions"] = one["motions"] or (goes if can_go else [])
    elif "colour" in fields:
        _paint_part(draft, word, part, owners)
    elif word.text != part and not (fields.keys() & {"count"} or word.has("articles")):
        return  # "with shiny blades"
    draft.show(word)
    draft.claim(word, SEEN, "", owners)
    claim_fine(draft, word, owners)
    claim_lamps(draft, word, owners)


def _paint_part(draft: SceneDraft, word: Token, part: str, owners: Indices) -> None:
    """Give parts the colour of a word; of those that have none of their own it is to be seen."""
    hue = dict(one.value for one in word.all("field"))["colour"]
    for index in owners:
        own = draft.noun(index).find_choice(part)
        if own is not None and own.is_coloured:
            draft.set_part(index, own.name, colour=hue)
            continue
        if draft.things[index]["noun"] in word_table("painted").get(part, ()):
            draft.things[index]["colour"] = hue
        kind = "lit colour" if part in word_set("things", "lamps") else "colour"
        draft.claim(word, kind, hue, [index])


def claim_lamps(draft: SceneDraft, token: Token, owners: Indices) -> None:
    """Leave it to the staged scene whether one sees lamps that a word names: "headlights"."""
    for index in owners:
        kinds = {one.name for one in LAMPS.get(draft.things[index]["noun"], ())}
        is_off = draft.things[index].get("is_lit") is False
        for name in sorted(one for one in kinds if one in token.text and not is_off):
            draft.claim(token, "lamp", name, [index])


def claim_fine(draft: SceneDraft, token: Token, owners: Indices) -> None:
    """Leave it to the staged scene whether one sees fine parts, such as a mane."""
    is_fine = token.text in word_set("things", "fine_parts")
    draft.claim(token, "part", "", owners if is_fine else [])
