"""What a sentence is made of: noun groups, prepositional phrases and clauses."""

from __future__ import annotations

from dataclasses import dataclass, field

from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.word import Word


@dataclass(eq=False)
class NounGroup:
    """A noun with what belongs to it: "two small red cars", "the dog's tail", "it"."""

    determiner: Word | None = None
    modifiers: list[Word] = field(default_factory=list)
    """Numbers, adjectives, participles and nouns before the head, in order."""
    head: Word | None = None
    """Its noun or pronoun; None = adjectives only, as in "is dark"."""
    owner: NounGroup | None = None
    """Whose it is: "the dog's"."""
    negation: Word | None = None
    phrases: list[PrepPhrase] = field(default_factory=list)
    """What follows it and belongs to it: "of water", "with a hat"."""
    sides: list[Word] = field(default_factory=list)
    """Where in the picture it is: "on the left"."""

    @property
    def words(self) -> list[Word]:
        """Its own words, without owner and phrases."""
        first = [self.determiner] if self.determiner else []
        return [*first, *self.modifiers, *([self.head] if self.head else [])]

    @property
    def head_word(self) -> Word:
        """Its head; only for groups that have one."""
        if self.head is None:
            raise ValueError("the noun group has no head")
        return self.head

    @property
    def text(self) -> str:
        """Its own words, without its determiner."""
        return " ".join(word.text for word in (*self.modifiers, self.head) if word is not None)


@dataclass(eq=False)
class PrepPhrase:
    """A preposition and its nouns: "between a house and a tree"."""

    preposition: Word
    groups: list[NounGroup] = field(default_factory=list)
    near: NounGroup | None = None
    """The noun group it follows."""
    negation: Word | None = None
    """As in "without a net": its nouns are not there."""
    denial: Word | None = None
    """As in "not on the table": the nouns are there, the relation is not."""

    @property
    def has_pronoun(self) -> bool:
        """Whether its only noun is a pronoun, as in "behind him"."""
        heads = [group.head for group in self.groups]
        return len(heads) == 1 and heads[0] is not None and heads[0].pos is Pos.PRONOUN


@dataclass(eq=False)
class Clause:
    """A verb with its subjects, objects and circumstances."""

    subjects: list[NounGroup] = field(default_factory=list)
    verb: Word | None = None
    """None = no verb: "a vase on a table"."""
    auxiliaries: list[Word] = field(default_factory=list)
    objects: list[NounGroup] = field(default_factory=list)
    phrases: list[PrepPhrase] = field(default_factory=list)
    adverbs: list[Word] = field(default_factory=list)
    """Adverbs, particles and adjuncts, in order."""
    complements: list[NounGroup] = field(default_factory=list)
    """Adjectives about the subject, or the object: "is dark", "painted orange"."""
    negation: Word | None = None
    opener: Word | None = None
    """The subordinator or relative that opened it."""
    order: str = "same"
    """When: at the "same" time as the clause before it, "after" it or "before" it."""
    sentence: int = 0
    """Number of its sentence."""
    is_participle: bool = False
    """Whether its verb is a participle without auxiliary."""
    hosts: list[NounGroup] = field(default_factory=list)
    """Of a participle right after a noun: subjects of the clause that the noun is in."""
    hosts_by: str = ""
    """The preposition by which the noun is in that clause, "with" also for what is held or worn,
    "" for any other object."""
    is_relative: bool = False
    is_listed: bool = False
    """Whether its subjects are joined by "and"."""

    @property
    def is_passive(self) -> bool:
        """Whether its subjects undergo the verb: "held by a boy", "is being tilted"."""
        verb = self.verb
        return verb is not None and verb.meaning.form is VerbForm.PAST and (
            self.is_participle or any(one.text in _BE for one in self.auxiliaries)
        )  # fmt: skip

    @property
    def verb_word(self) -> Word:
        """Its verb; only for clauses that have one."""
        if self.verb is None:
            raise ValueError("the clause has no verb")
        return self.verb

    @property
    def is_empty(self) -> bool:
        """Whether nothing is in it."""
        return not (
            self.subjects or self.verb or self.objects or self.phrases or self.adverbs
            or self.complements
        )  # fmt: skip


_BE = frozenset(
    {"is", "are", "was", "were", "be", "been", "being", "gets", "get", "got", "getting"}
)
