"""Prompt to scene description: a grammar over a lexicon.

A prompt goes through four steps: tokens (`tokens.tokenize_prompt`), words with a part of speech
(`tagging.tag_words`), clauses with their own subjects, verbs and objects (`clauses.read_clauses`),
and clause by clause what they mean (`clause_meaning.ClauseMeaning`). A word counts as shown if it
changed the scene; every other word is reported.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from texvent.errors import InputError
from texvent.scenes.description import Illumination, SceneDescription, Substitution
from texvent.scenes.language.defaults import complete_description
from texvent.scenes.language.grammar.clauses import read_clauses
from texvent.scenes.language.grammar.companions import link_companions
from texvent.scenes.language.grammar.made_of import bring_materials_forward
from texvent.scenes.language.meaning.acts.hosts import take_hosts
from texvent.scenes.language.meaning.animals.acts import read_animal_acts
from texvent.scenes.language.meaning.animals.characters import stand_upright
from texvent.scenes.language.meaning.clause_meaning import ClauseMeaning
from texvent.scenes.language.phrases.compounds import join_compounds
from texvent.scenes.language.phrases.frames import drop_frames
from texvent.scenes.language.phrases.inherent import read_inherent
from texvent.scenes.language.phrases.mood_notes import note_moods
from texvent.scenes.language.phrases.names import join_names
from texvent.scenes.language.phrases.phrasings import plain_phrases
from texvent.scenes.language.phrases.rates import plain_rates
from texvent.scenes.language.phrases.styles import set_styles_aside
from texvent.scenes.language.phrases.ways import plain_ways
from texvent.scenes.language.place_cues import find_cues, read_outsides, read_titles, use_outdoors
from texvent.scenes.language.posing import lose_standing
from texvent.scenes.language.vocabulary.film import GREYSCALE
from texvent.scenes.language.vocabulary.scene import TIMELAPSES
from texvent.scenes.language.word_claims import (
    is_silent,
    is_unread,
    says_something,
)
from texvent.scenes.language.words.english import is_of_other_grammar, list_readings
from texvent.scenes.language.words.film.film_words import read_film_words
from texvent.scenes.language.words.lexicon import Lexicon, Role
from texvent.scenes.language.words.light_words import read_light_words
from texvent.scenes.language.words.neighbours import read_neighbours
from texvent.scenes.language.words.sense_cues import choose_senses
from texvent.scenes.language.words.standpoint import mark_standpoints
from texvent.scenes.language.words.tagging import tag_words
from texvent.scenes.language.words.telegrams import read_telegrams
from texvent.scenes.language.words.tokens import tokenize_prompt
from texvent.scenes.language.words.viewpoint import find_means, mark_viewpoints
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.kinds.looks import LOOKS
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Noun

LONGEST_LIST = 120
"""Characters of words that an error lists."""
MOST_WORDS = 2000
"""Words of a prompt that are read; what follows is reported as a whole."""
_FEWEST_FOREIGN = 3
_FOREIGN_SHARE = 0.6


def parse_prompt(prompt: str, nouns: Mapping[str, Noun] = NOUNS) -> SceneDescription:
    """What the prompt asks for, and which of its words are shown.

    Args:
        prompt: any text, of any length.
        nouns: the objects that can be shown, by name.

    Returns:
        The scene's description; the same prompt always gives the same one.

    Raises:
        InputError: the prompt is empty or blank, or nothing in it is understood.

    Example:
        >>> parse_prompt("a red car drives left past two trees at dusk").summary()[0]
        '1 car, red, drives left, past 2 trees'
    """
    if not prompt.strip():
        raise InputError(
            "the prompt is empty; describe a scene, such as 'a red car drives left past two trees'"
        )
    words, light, notes = _read_words(prompt, _known_words() if nouns is NOUNS else Lexicon(nouns))
    is_carried = mark_viewpoints(words)
    mark_standpoints(words)
    cues = find_cues(words, is_outside=read_outsides(words))
    read_titles(words)
    meaning = ClauseMeaning(
        nouns, is_carried=is_carried, means=find_means(words) if is_carried else None
    )
    clauses = read_clauses(words[:MOST_WORDS])
    link_companions(clauses)
    take_hosts(clauses, nouns)
    read_animal_acts(clauses, nouns)
    notes += stand_upright(clauses, words, nouns)
    for clause in clauses:
        meaning.read(clause)
    description = meaning.build(prompt, words)
    _name_worn(words, description)
    lose_standing(words, description)
    use_outdoors(words, description.surroundings.place, cues)
    is_timelapse = _read_timelapse(words, description)
    shown, substituted, unread = _account(words)
    if not meaning.is_anything_shown:
        raise InputError(
            f"nothing in the prompt was understood: {_shortened(unread)}; "
            "docs/prompts.md lists the words of the embedded generator, texvent generators lists "
            "models that take any text"
        )
    description = replace(
        description,
        light=_join(description.light, light),
        is_timelapse=is_timelapse,
        is_grey=any(one.role is Role.STYLE and one.meaning.value == GREYSCALE for one in words),
        shown=shown,
        substituted=substituted,
        not_understood=unread,
        notes=(*notes, *description.notes),
    )
    return complete_description(description, nouns, cues)


def _read_timelapse(words: Sequence[Word], description: SceneDescription) -> bool:
    """Whether clouds and the sun go fast; where anything else is named, it moves as usual."""
    found = [word for word in words if word.text in TIMELAPSES]
    has_things = any(one.noun != "cloud" for one in description.objects)
    for word in found if has_things else ():
        word.shown_as = "clouds and sun that go fast; things move as usual"
    return bool(found)


def _name_worn(words: Sequence[Word], description: SceneDescription) -> None:
    """What a body wears looks as it is called, however it looks where it lies alone."""
    worn = {n for one in description.relations if one.kind == "wear" for n in one.targets}
    for word in words:
        nouns = {description.objects[n].noun for n in word.things} if word.things else set()
        if len(nouns) != 1 or not worn.issuperset(word.things):
            continue
        noun = nouns.pop()
        if word.shown_as is not None and word.shown_as == LOOKS.get(noun):
            word.shown_as = noun if word.meaning.is_substitute else None


def _join(light: Illumination, said: Illumination) -> Illumination:
    """Kind and course of the light, and how it is said to be."""
    return replace(
        light,
        kind=light.kind or said.kind,
        tint=said.tint,
        hardness=said.hardness,
        brightness=said.brightness,
        direction=said.direction,
        is_low=said.is_low,
    )


def _read_words(prompt: str, known: Lexicon) -> tuple[list[Word], Illumination, list[str]]:
    """Words of a prompt with their senses, what they say of the light, and notes on them."""
    tokens = plain_phrases(set_styles_aside(drop_frames(tokenize_prompt(prompt))))
    tokens = plain_ways(plain_rates(tokens))
    tokens = join_compounds(join_names(tokens, known), known)
    words, notes = tag_words(bring_materials_forward(tokens, known), known)
    if _is_foreign(words) or is_of_other_grammar(prompt):
        raise InputError(
            f"the prompt seems not to be English: {_shortened([word.text for word in words])}; "
            "write it in English, or use a model that takes any text (texvent generators)"
        )
    light = read_light_words(words)
    notes += [*read_film_words(words), *note_moods(words)]
    words = read_telegrams(words, known)
    choose_senses(words, known)
    read_neighbours(words)
    read_inherent(words)
    return words, light, notes


def _is_foreign(words: Sequence[Word]) -> bool:
    """Whether most of its words, three or more, are in no English dictionary."""
    content = {word.text for word in words if word.role is not Role.FUNCTION}
    unlisted = {
        word.text for word in words if word.role is Role.UNKNOWN and not list_readings(word.text)
    }
    return len(unlisted) >= _FEWEST_FOREIGN and len(unlisted) > _FOREIGN_SHARE * len(content)


def _shortened(words: Sequence[str]) -> str:
    """The first of the words, as many as a line of an error holds."""
    text = ", ".join(words) or "no word of it names a thing, a place or a movement"
    return text if len(text) <= LONGEST_LIST else f"{text[:LONGEST_LIST]} ..."


@lru_cache(maxsize=1)
def _known_words() -> Lexicon:
    return Lexicon(NOUNS)


def _account(
    words: Sequence[Word],
) -> tuple[tuple[str, ...], tuple[Substitution, ...], tuple[str, ...]]:
    """Words shown, words shown as something else, and words without effect, each once."""
    shown: dict[str, None] = {}
    substituted: dict[str, Substitution] = {}
    unread: dict[str, None] = {}
    for word in words:
        if word.shown_as is not None and word.said:
            substituted[word.said] = Substitution(word.said, word.shown_as)
        elif is_unread(word):
            for token in word.tokens:
                is_article = len(word.tokens) > 1 and token.text in ("the", "a")
                if token.reported and not token.is_punctuation and not is_article:
                    unread[token.reported] = None
        elif word.is_used and not is_silent(word) and says_something(word):
            shown[f"no {word.said}" if word.is_absent else word.said] = None
    return tuple(shown), tuple(substituted.values()), tuple(unread)
