"""A word of a prompt with its reading, and what became of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from texvent.scenes.description import Relation
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.tokens import Token


@dataclass(eq=False)
class Word:
    """Some tokens of a prompt that belong together, with their reading."""

    tokens: tuple[Token, ...]
    meaning: Meaning
    lemma: str
    is_used: bool = False
    """Whether it had an effect on the scene, or needs none."""
    is_lost: bool = False
    """Whether it says something of things that are shown, which the scene does not honour."""
    shown_as: str | None = None
    """What is shown in its place, if that is something else."""
    usual_sense: str | None = None
    """Which of its senses is drawn, where no other word tells that this one is meant."""
    others: tuple[Meaning, ...] = field(default=())
    """Its other readings."""
    is_absent: bool = False
    """Whether the prompt says that there is none of it."""
    things: tuple[int, ...] = ()
    """Objects that it names or says something of, by index."""
    relations: tuple[Relation, ...] = ()
    """Relations of objects that it stands for."""
    motion: int | None = None
    """Which motion of its first object it is about, from 0."""
    is_viewpoint: bool = False
    """Whether it carries the camera, and so is not in the picture."""
    is_content: bool = False
    """Whether it is in a vessel, or drunk, and so no place: "a bottle of water"."""
    course: str = ""
    """What it claims of a place besides being there: "over roofs", "across road", "in rows"."""
    companions: tuple[Word, ...] = ()
    """Words that it goes with: where one of them is lost, it may mean something else."""

    is_name: bool = False
    """Whether it is a name that no dictionary lists: "Arizona" of "the Arizona desert"."""
    has_other_sense: bool = False
    """Whether its lemma is that of another word, which it means here: "ski" of "carves"."""

    @property
    def pos(self) -> Pos:
        """Its part of speech."""
        return self.meaning.pos

    @property
    def role(self) -> Role:
        """What it does in the sentence."""
        return self.meaning.role

    @property
    def text(self) -> str:
        """Its words, in lower case."""
        return " ".join(token.text for token in self.tokens)

    @property
    def said(self) -> str:
        """What a report calls it: its words, or the phrase of the prompt that they stand for."""
        return " ".join(token.reported for token in self.tokens if token.reported)

    @property
    def written(self) -> str:
        """Its words as the prompt has them."""
        return " ".join(token.written for token in self.tokens)

    @property
    def is_possessive(self) -> bool:
        """Whether it owns what follows: "the dog's tail"."""
        return is_possessive(self.tokens[-1])

    def read_as(self, role: Role) -> Meaning | None:
        """Its meaning in that role, if it can have it."""
        return next((one for one in (self.meaning, *self.others) if one.role is role), None)

    def mean(self, meaning: Meaning) -> None:
        """Give it this reading, and no other one."""
        self.meaning, self.others = meaning, ()

    def lose(self, pos: Pos) -> None:
        """It is known, but shows nothing."""
        form = self.meaning.form if pos is Pos.VERB else None
        self.mean(Meaning(Role.UNKNOWN, pos, form=form))
        self.is_lost = True


CONTRACTED = frozenset({"it", "that", "there", "he", "she", "what", "who", "let", "here"})
"""Words after which 's is "is"."""


def link(words: Iterable[Word], things: Sequence[int], motion: int | None = None) -> None:
    """These words are about these objects, and about one of their motions."""
    for word in words:
        word.things = tuple(dict.fromkeys((*word.things, *things)))
        word.motion = motion


def mark_used(words: Iterable[Word]) -> None:
    """These words had an effect."""
    for word in words:
        word.is_used = True


def is_possessive(token: Token) -> bool:
    """Whether a token owns what follows: "dog's" of "the dog's tail"."""
    is_owner = token.written.casefold().endswith(("'s", "’s", "s'", "s’"))
    return is_owner and token.text not in CONTRACTED
