"""Prompt to scene description: a closed grammar over a lexicon.

A prompt goes through three steps: tokens (`tokens.tokenize_prompt`), phrases with a role each
(`tagging.tag_phrases`) and, phrase by phrase, three readers: of objects, of the camera, and of
the surroundings. What no reader could use is reported word by word.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache

from texvent.errors import InputError
from texvent.scenes.description import SceneDescription
from texvent.scenes.language import vocabulary_objects, vocabulary_scene
from texvent.scenes.language.camera_reader import CameraReader
from texvent.scenes.language.defaults import complete_description
from texvent.scenes.language.lexicon import ADJECTIVES, Lexicon, Role
from texvent.scenes.language.object_reader import ObjectReader
from texvent.scenes.language.surroundings_reader import SurroundingsReader
from texvent.scenes.language.tagging import Phrase, mark_used, tag_phrases
from texvent.scenes.language.tokens import tokenize_prompt
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Noun

_SILENT = frozenset({Role.BREAK, Role.AND, Role.DETERMINER, Role.PRONOUN})
"""Roles that need no effect of their own."""
_SCENE_ROLES = (
    Role.WEATHER, Role.CLOUDS, Role.SNOW, Role.STEEP, Role.DUST, Role.FLICKER, Role.SHADOW,
    Role.GLOW,
)  # fmt: skip
_EFFECTS = frozenset({Role.WEATHER, Role.SNOW, Role.DUST, Role.CLOUDS})
"""Subjects whose verbs say nothing new: "rain falls", "dust flies up"."""
LONGEST_LIST = 120
"""Characters of words that an error lists."""
_CLAUSE_SIGNS = frozenset(',.;:!?()[]"')


LOOK_AHEAD = 100
"""Phrases that are looked at after one: a sentence, and no more of a very long text."""


def parse_prompt(prompt: str, nouns: Mapping[str, Noun] = NOUNS) -> SceneDescription:
    """What the prompt asks for, and which of its words were not understood.

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
    known = _known_words() if nouns is NOUNS else Lexicon(nouns)
    phrases = tag_phrases(tokenize_prompt(prompt), known)
    description = _PromptParser(phrases, nouns).read(prompt)
    if not any(phrase.is_used for phrase in phrases):
        raise InputError(
            f"nothing in the prompt was understood: {_shortened(description.not_understood)}; "
            "docs/prompts.md lists the words of the embedded generator, texvent generators lists "
            "models that take any text"
        )
    return complete_description(description, nouns)


def _shortened(words: Sequence[str]) -> str:
    """The first of the words, as many as a line of an error holds."""
    text = ", ".join(words) or "no word of it names a thing, a place or a movement"
    return text if len(text) <= LONGEST_LIST else f"{text[:LONGEST_LIST]} ..."


@lru_cache(maxsize=1)
def _known_words() -> Lexicon:
    return Lexicon(NOUNS)


class _PromptParser:
    """One pass over the phrases of a prompt."""

    def __init__(self, phrases: list[Phrase], nouns: Mapping[str, Noun]) -> None:
        self._phrases = phrases
        self._objects = ObjectReader(nouns)
        self._camera = CameraReader()
        self._scene = SurroundingsReader()
        self._readers: dict[Role, Callable[[Phrase], None]] = {
            **dict.fromkeys(_SCENE_ROLES, self._read_scene_word),
            **dict.fromkeys((Role.PLACE, Role.LIGHT, Role.SKY), self._read_surroundings),
            **dict.fromkeys((Role.SPEED_UNIT, Role.HERTZ), self._read_unit),
            **dict.fromkeys(ADJECTIVES, self._objects.read_adjective),
            Role.DETERMINER: self._objects.open_noun_phrase,
            Role.NEGATION: self._objects.read_negation,
            Role.RELATION: self._objects.read_relation,
            Role.STILL: self._objects.read_still,
            Role.SIDE: self._objects.read_side,
            Role.PART: self._objects.read_part,
            Role.AND: self._objects.read_and,
            Role.PRONOUN: self._read_pronoun,
            Role.BREAK: self._read_break,
        }
        """What reads a phrase by itself; the rest depends on its neighbours."""

    def read(self, prompt: str) -> SceneDescription:
        """The description, before defaults are filled in."""
        for position, phrase in enumerate(self._phrases):
            if self._is_about_light(position, phrase):
                phrase.is_used = True
            elif self._camera.read(phrase):
                self._objects.noun_phrase.count = None
            else:
                self._read_phrase(position, phrase)
        self._objects.apply_adjectives()
        surroundings, light = self._scene.build()
        objects = tuple(partial.build() for partial in self._objects.partial_objects)
        return SceneDescription(
            prompt=prompt,
            objects=objects,
            relations=tuple(self._objects.relations),
            shot=self._camera.build(),
            light=light,
            surroundings=surroundings,
            absent=tuple(self._objects.absent),
            not_understood=_list_unused(self._phrases),
            notes=tuple(self._objects.notes),
        )

    def _is_about_light(self, position: int, phrase: Phrase) -> bool:
        """Light comes "from above" anyway; the camera does not."""
        before = self._phrases[position - 1].role if position else None
        return phrase.role is Role.VIEW and before in (Role.LIGHT, Role.GLOW)

    def _read_phrase(self, position: int, phrase: Phrase) -> None:
        role = phrase.role
        if role is Role.UNKNOWN:
            self._read_unknown(position)
        elif role is Role.NOUN:
            self._read_noun(position, phrase)
        elif role in (Role.VERB, Role.DIRECTION, Role.PACE, Role.SHADE):
            self._read_by_neighbours(position, phrase)
        else:
            self._readers[role](phrase)

    def _read_pronoun(self, phrase: Phrase) -> None:
        self._camera.has_focus = False
        self._objects.read_pronoun(phrase)

    def _read_break(self, phrase: Phrase) -> None:
        if phrase.text in _CLAUSE_SIGNS:
            self._camera.has_focus &= phrase.text == ","
            self._objects.end_clause(phrase.text)

    def _read_noun(self, position: int, phrase: Phrase) -> None:
        follower = self._next_phrase(position, frozenset({Role.PACE}))
        self._objects.verb_follows = (
            follower is not None
            and follower.role is Role.VERB
            and follower.meaning.form == "finite"
        )
        relation = self._objects.relation
        is_camera = self._camera.has_focus
        if is_camera:
            self._objects.drop_relation(is_used=True)
            self._objects.subjects = []
        index = self._objects.read_noun(phrase)
        if index is not None and is_camera and not self._camera.aim(index, relation):
            self._camera.has_focus = False

    def _read_by_neighbours(self, position: int, phrase: Phrase) -> None:
        """Words whose reading depends on what comes next."""
        follower = self._following(position, ADJECTIVES - {Role.NUMBER})
        noun_follows = follower is Role.NOUN
        if phrase.role is Role.SHADE:
            if follower is Role.PLACE and phrase.text == "dark":
                phrase.is_used = self._scene.read_light(vocabulary_scene.DARK_PLACES_LIGHT)
            else:
                self._objects.read_adjective(phrase)
        elif phrase.role is Role.PACE:
            if position and self._phrases[position - 1].role is Role.UNKNOWN:
                return
            self._objects.read_pace(phrase, noun_follows)
        elif phrase.role is Role.DIRECTION:
            goes_along = phrase.text in ("up", "down", "across") and self._place_follows(position)
            if goes_along and phrase.text != "across":
                phrase.is_used = True
            else:
                self._objects.read_direction(phrase)
        elif position and self._phrases[position - 1].role in _EFFECTS:
            phrase.is_used = self._phrases[position - 1].is_used
        elif noun_follows and phrase.meaning.form == "participle":
            self._objects.read_attribute(phrase)
        else:
            has_object = self._following(position, ADJECTIVES | {Role.DETERMINER}) is Role.NOUN
            self._objects.read_verb(phrase, has_object)

    def _place_follows(self, position: int) -> bool:
        skipped = ADJECTIVES | {Role.DETERMINER, Role.STEEP}
        return self._following(position, skipped) in (Role.PLACE, Role.SKY)

    def _following(self, position: int, skipped: frozenset[Role]) -> Role | None:
        """Role of the next phrase that is not one of `skipped`."""
        phrase = self._next_phrase(position, skipped)
        return None if phrase is None else phrase.role

    def _next_phrase(self, position: int, skipped: frozenset[Role]) -> Phrase | None:
        coming = self._phrases[position + 1 : position + 1 + LOOK_AHEAD]
        return next((phrase for phrase in coming if phrase.role not in skipped), None)

    def _read_unknown(self, position: int) -> None:
        """An unlisted word where a noun should be takes the subject's place.

        Before a noun or one of its adjectives it is only one more adjective: the group goes on.
        """
        if self._phrases[position].text in vocabulary_objects.CONTRASTS:
            self._objects.negation = None
            return
        before = self._phrases[position - 1].role if position else Role.BREAK
        if self._following(position, ADJECTIVES | {Role.UNKNOWN}) is Role.NOUN:
            return
        if before in ADJECTIVES or before in (Role.DETERMINER, Role.RELATION, Role.BREAK):
            self._objects.read_unknown_noun()

    def _read_scene_word(self, phrase: Phrase) -> None:
        negation = self._objects.negation
        self._scene.read(phrase, is_negated=negation is not None)
        if negation is not None and phrase.is_used:
            negation.is_used = True
            self._objects.negation = None
        self._objects.drop_relation(is_used=phrase.is_used)
        self._objects.close_subjects()

    def _read_surroundings(self, phrase: Phrase) -> None:
        colour, colour_phrases = self._objects.take_colour()
        if phrase.role is Role.PLACE:
            phrase.is_used, is_coloured = self._scene.read_place(phrase.meaning.value, colour)
        elif phrase.role is Role.LIGHT:
            phrase.is_used, is_coloured = self._scene.read_light(phrase.meaning.value), False
        else:
            is_coloured = colour is not None
            if colour is not None:
                self._scene.read_sky(colour)
            else:
                self._scene.read_place("sky", None)
            phrase.is_used = True
        mark_used(colour_phrases if is_coloured else ())
        self._objects.drop_relation(is_used=phrase.is_used)
        self._objects.close_subjects()

    def _read_unit(self, phrase: Phrase) -> None:
        """A number with a unit: a speed or a frequency."""
        taken = self._objects.noun_phrase.take_number()
        if taken is None:
            return
        number, said = taken
        value = number * phrase.meaning.value
        if phrase.role is Role.SPEED_UNIT:
            self._objects.read_speed(value, [said, phrase])
        elif not self._objects.read_rate(value, [said, phrase]):
            self._scene.read_hertz(value, [said, phrase])


def _list_unused(phrases: list[Phrase]) -> tuple[str, ...]:
    """Words without effect, in order, each once; stop words excluded."""
    unused: dict[str, None] = {}
    for phrase in phrases:
        if phrase.is_used or phrase.role in _SILENT:
            continue
        for token in phrase.tokens:
            if token.text not in vocabulary_objects.STOP_WORDS and not token.is_punctuation:
                unused[token.text] = None
    return tuple(unused)
