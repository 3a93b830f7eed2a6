"""Where noun groups and prepositional phrases belong: subject, object, noun before, or clause."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.language.grammar.clause_state import ClauseState
from texvent.scenes.language.grammar.noun_groups import read_group, starts_group
from texvent.scenes.language.grammar.syntax import NounGroup, PrepPhrase
from texvent.scenes.language.vocabulary.acts import WEARABLE
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word

_GOING = frozenset(
    {"roll", "fall", "jump", "drive", "run", "walk", "slide", "move", "bounce", "fly"}
)
_STEERED = (None, "ride", "hold")
"""Acts on the objects of such verbs, as in "drives a car": what follows "off" is none."""
_PICTURES = frozenset({"picture", "photo", "photograph", "image"})
_HANGS_ON = frozenset(
    {"wall", "desk", "shelf", "fridge", "easel", "billboard", "mantelpiece", "fireplace", "door"}
)
"""What pictures are on: a picture "on a table" may show the table."""
_PARTICLES = ("out", "off")
"""Prepositions that belong to the verb before them: "blows out the candles"."""
_WAYS_OF_PARTICLES = ("up", "down")
_DONE_UP = frozenset(
    {"hold", "light", "lift", "soak", "throw", "toss", "pull", "tear", "wash", "clean", "chop",
     "cut", "break", "dig", "fold", "hang", "raise", "whip", "stir", "scoop", "sweep", "wipe",
     "mop", "prop", "gather", "block"}
)  # fmt: skip
_DONE_DOWN = frozenset(
    {"set", "lay", "throw", "slam", "knock", "tear", "cut", "chop", "hold", "pull", "push", "take",
     "tie", "hammer", "nail", "lower", "pat", "sand", "write"}
)  # fmt: skip
"""Verbs that are done to what follows "up" and "down": "lights up his face"."""


_WHERE = ("outside", "inside")
"""Prepositions that are adverbs as well."""
_MEASURES = frozenset(
    {"piece", "slice", "bit", "type", "kind", "sort", "load", "helping", "serving", "portion",
     "chunk", "selection", "amount", "mix", "mixture", "strip", "cluster", "clump", "batch",
     "style", "wedge", "scoop", "hunk", "half", "dozens"}
)  # fmt: skip
"""Nouns that say how much or which kind of what follows "of"."""


class GroupAttachment(ClauseState):
    """Attaches groups to the clause being read."""

    def _read_preposition(self, word: Word, negation: Word | None = None) -> None:
        before = self._words[self._at - 1] if self._at else None
        denial = self._negation if self._negation is before else None
        self._at += 1
        if self._at < len(self._words) and self._words[self._at].pos is Pos.NEGATION:
            negation = self._words[self._at]
            self._at += 1
        self._negation = None
        follows_verb = self._at >= 2 and self._words[self._at - 2].pos is Pos.VERB
        if follows_verb and self._is_particle(word, self._words[self._at - 2]):
            if word.text in _WAYS_OF_PARTICLES:
                # As in "holds up a box": no way that it goes.
                word.meaning = Meaning(Role.DIRECTION, Pos.ADVERB, word.text)
            self._clause.adverbs.append(word)
            return
        opens_group = starts_group(self._words, self._at, is_opening=True)
        if word.text in _WHERE and self._doing_comes():
            word.meaning = replace(word.meaning, pos=Pos.ADVERB)
            self._clause.adverbs.append(word)
            return
        is_verb = self._at < len(self._words) and self._words[self._at].pos is Pos.VERB
        if is_verb and not opens_group:
            word.is_used = True
            self._continue_with_same_subjects("same")
            return
        if not opens_group:
            self._clause.adverbs.append(word)
            return
        group, self._at = read_group(self._words, self._at)
        is_of = word.text == "of"
        if is_of and self._measures(word, group):
            return
        if is_of and self._names_shot(word):
            self._clause.subjects.append(group)
            self._last = self._anchor = group
            return
        near = self._last if is_of else self._anchor
        phrase = PrepPhrase(word, [group], near, negation, denial)
        self._attach(phrase)
        self._phrase, self._last, self._is_joined = phrase, group, ""
        if not is_of:
            self._anchor = group

    def _doing_comes(self) -> bool:
        """As in "a man outside throwing a ball": the gerund is what he does."""
        coming = self._words[self._at : self._at + 1]
        return [(one.pos, one.meaning.form) for one in coming] == [(Pos.VERB, VerbForm.ING)]

    def _measures(self, word: Word, group: NounGroup) -> bool:
        """As in "two slices of cake on a plate": the cake is on it, and "slices" is reported."""
        whole = self._last
        if whole is None or whole.head is None or group.head is None:
            return False
        is_measure = whole.head.role is Role.UNKNOWN and whole.head.lemma in _MEASURES
        if not is_measure or group.head.role is not Role.NOUN or group.determiner is not None:
            return False
        word.is_used = True
        whole.modifiers += [whole.head, *group.modifiers]
        whole.head = group.head
        return True

    def _is_particle(self, word: Word, verb: Word) -> bool:
        """Whether it belongs to the verb before it."""
        if word.text in _PARTICLES:
            return not self._goes(verb)
        done = {"up": _DONE_UP, "down": _DONE_DOWN}.get(word.text, frozenset())
        return verb.lemma in done and verb.role is not Role.CAMERA_MOVE and not self._clause.objects

    @staticmethod
    def _goes(verb: Word) -> bool:
        """Whether it says that its subject moves: "rolls off a table"."""
        value = verb.meaning.value
        if verb.role is Role.SIMILAR:
            return value[0] in _GOING
        return isinstance(value, Verb) and value.kind in _GOING and value.act in _STEERED

    def _names_shot(self, word: Word) -> bool:
        """As in "A static shot of a dog": the dog is the subject of what follows."""
        clause = self._clause
        if clause.verb is not None:
            return False
        if not clause.subjects:
            word.is_used = bool(clause.adverbs)
            return bool(clause.adverbs)
        head = clause.subjects[-1].head
        if head is None or head.role is not Role.FUNCTION or self._last is not clause.subjects[-1]:
            return False
        if head.text in _PICTURES and self._hangs():
            head.meaning = Meaning(Role.NOUN, Pos.NOUN, "poster", is_substitute=True)
            return False
        word.is_used = True
        self._close()
        return True

    def _hangs(self) -> bool:
        """As in "a picture of a car on a wall": a thing of the scene, not what is filmed."""
        coming = [one.text for one in self._words[self._at : self._at + 6]]
        for place, text in enumerate(coming):
            if text in ("on", "above", "in", "onto"):
                return bool(set(coming[place + 1 :]) & _HANGS_ON)
            if text.startswith("hang"):
                return True
        return False

    def _attach(self, phrase: PrepPhrase) -> None:
        """To the noun before it after "of" and before the verb; else to the clause."""
        clause, near = self._clause, phrase.near
        is_of = phrase.preposition.text == "of"
        is_before_verb = clause.verb is None and bool(clause.subjects)
        if near is not None and not self._is_joined and (is_of or is_before_verb):
            near.phrases.append(phrase)
        else:
            clause.phrases.append(phrase)

    def _add_group(self, group: NounGroup) -> None:
        clause, joined = self._clause, self._is_joined
        if joined and (group.determiner is not None or self._is_counted(group)):
            self._negation = None if self._words_since_negation(group) else self._negation
        group.negation = self._negation
        if clause.verb is None:
            self._add_subject(group, joined)
        elif self._is_inverted():
            clause.subjects.append(group)
        elif joined and self._verb_follows(self._at):
            self._open_clause_with(group)
        elif group.head is None:
            clause.complements.append(group)
        elif (
            joined
            and self._phrase is not None
            and not self._opens_after_comma(joined)
            and not self._is_after_colour(group)
        ):
            self._phrase.groups.append(group)
        else:
            clause.objects.append(group)
        self._last = self._anchor = group
        self._is_joined = ""

    def _needs_second(self) -> bool:
        """As in "Between a house" waits for "and a tree"."""
        phrase = self._phrase
        return phrase is not None and phrase.preposition.text == "between" and (
            len(phrase.groups) == 1
        )  # fmt: skip

    def _is_more_to_wear(self, group: NounGroup) -> bool:
        """As in "a woman in a black dress and red shoes dances"."""
        phrase = self._phrase
        if phrase is None or phrase.preposition.text not in ("in", "with"):
            return False
        return _is_worn(phrase.groups[-1]) and _is_worn(group)

    def _is_counted(self, group: NounGroup) -> bool:
        return any(word.pos is Pos.NUMBER for word in group.modifiers)

    def _words_since_negation(self, group: NounGroup) -> bool:
        """Whether another noun came between the negation and this group."""
        return self._negation is not None and group.words[:1] != [
            self._words[self._words.index(self._negation) + 1]
        ]

    def _is_inverted(self) -> bool:
        """As in "Behind the house stands a cow"."""
        clause = self._clause
        return (
            clause.verb is not None and not clause.subjects and not clause.is_participle
            and bool(clause.phrases) and clause.verb.meaning.form is VerbForm.THIRD
        )  # fmt: skip

    def _opens_after_comma(self, joined: str) -> bool:
        return joined == "," and self._clause.verb is not None

    def _add_subject(self, group: NounGroup, joined: str) -> None:
        clause = self._clause
        is_intro = joined == "," and not clause.subjects
        if clause.complements and joined and self._verb_follows(self._at):
            self._open_clause_with(group)
        elif clause.auxiliaries and clause.subjects:
            clause.complements.append(group)
        elif (
            joined
            and not is_intro
            and self._phrase is not None
            and not self._is_after_colour(group)
            and (
                not self._verb_follows(self._at)
                or self._needs_second()
                or self._is_more_to_wear(group)
            )
        ):
            self._phrase.groups.append(group)
        elif joined or not clause.subjects:
            self._phrase = None
            clause.subjects.append(group)
        else:
            self._close()
            self._clause.subjects.append(group)

    def _is_after_colour(self, group: NounGroup) -> bool:
        """As in "a man in red and a woman": the woman is no colour."""
        before = self._phrase.groups[-1] if self._phrase is not None else group
        return before.head is None and group.head is not None

    def _open_clause_with(self, group: NounGroup) -> None:
        order = self._next_order
        self._close()
        self._clause.subjects = [group]
        self._clause.order = order

    def _verb_follows(self, at: int) -> bool:
        """Whether the noun group that ends at `at`, and what hangs on it, is followed by a verb."""
        words = self._words
        while at < len(words):
            pos = words[at].pos
            if pos in (Pos.VERB, Pos.AUXILIARY):
                return True
            if pos is Pos.PREPOSITION and starts_group(words, at + 1, is_opening=True):
                _, at = read_group(words, at + 1)
            elif pos is Pos.ADVERB or words[at].role is Role.SIDE:
                at += 1
            else:
                return False
        return False


def _is_worn(group: NounGroup) -> bool:
    noun = group.head.read_as(Role.NOUN) if group.head is not None else None
    return noun is not None and noun.value in WEARABLE
