"""Noun groups of a prompt: a head with its determiner, number and adjectives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read.parsing.lexicon import NounSense, word_set, word_table
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token, token_at

_HEADS = ("noun", "place", "effect", "pose", "scene")
"""Senses that a noun group may end with."""
MODIFIERS = ("field", "scene", "adverb")
"""Senses of the words before a head."""
_STANDPOINTS = ("camera", "pronouns", "conjunctions", "relatives", "negations")
"""Senses of words that no noun group holds."""
_PREPOSITIONS = ("at ", "in ", "by ", "with ", "without ", "during ")
"""Begin phrases that stand alone: "at night"."""


def ordinals() -> dict[str, int]:
    """Words of one of several → the number up to it: "third"."""
    return dict(word_table("ordinals"))


def _counts(token: Token) -> list[float]:
    """Numbers of things that a word means."""
    return [float(one.value[1]) for one in token.all("field") if one.value[0] == "count"]


def is_plural_form(word: str) -> bool:
    """Whether a word that is not known ends as a plural or a verb does, and as no adjective."""
    return word.endswith("s") and not word.endswith(("ss", "us", "is", "’s", "'s", "sports"))


@dataclass(frozen=True)
class Group:
    """Noun group: a head with its determiner, number and adjectives."""

    head: Token | None
    """None: it is not known."""
    modifiers: tuple[Token, ...] = ()
    unknown: tuple[Token, ...] = ()
    """Tokens without effect: words that are not known, or that another word stands before."""
    article: str = ""
    of: Phrase | None = None
    """Phrase with "of" that follows: "of apples"."""

    @property
    def words(self) -> list[Token]:
        """Its head, the words that are not known, and its modifiers."""
        return [*([self.head] if self.head else []), *self.unknown, *self.modifiers]

    @property
    def noun(self) -> NounSense | None:
        """Its noun, in the number that is said: "two glasses" are no spectacles."""
        senses: list[NounSense] = [one.value for one in self.head.all("noun")] if self.head else []
        is_many = any(count > 1 for one in self.modifiers for count in _counts(one))
        fitting = [one for one in senses if one.is_plural or not is_many]
        return next(iter(fitting or senses), None)

    @property
    def picks(self) -> str:
        """As "one" or "two" of several things that are named, "other", "leader", or ""."""
        words = [one.text for one in self.unknown if self.head is None]
        members = sorted(word_set("things", "members"))
        known = ("other", "others", "one", "another", *ordinals(), *members)
        if self.count > 1 and not {"other", "others"} & {*words}:
            is_part = self.of is not None and len(words) == 1 and words != ["both"]
            return words[0] if is_part else ""
        return next((one for one in known if one in words), "")

    @property
    def ordinal(self) -> int:
        """Number of the one that it picks, which may be a new one: 3 of "a third"; else 0."""
        words = [one.text for one in self.unknown if self.article in ("a", "an")]
        return max((ordinals().get(one, 0) for one in words), default=0)

    @property
    def count(self) -> int:
        """Number of things that words without a noun say: "two" of three."""
        return int(max((count for one in self.unknown for count in _counts(one)), default=1))

    @property
    def is_bare(self) -> bool:
        """Whether it is a noun alone, as in headlines: "fast ball"."""
        is_noun = bool(self.head and self.head.has("noun"))
        return is_noun and not self.article and not self.is_counted

    @property
    def is_counted(self) -> bool:
        """Whether a number of it is said."""
        return any(map(_counts, self.modifiers))

    @property
    def is_plural(self) -> bool:
        """Whether it names several things: "two dogs", "fish"."""
        counts = [count for one in self.modifiers for count in _counts(one)]
        named = word_table("parts").keys() | word_set("things", "wide")
        parts = [one.text for one in self.unknown if one.text in named]
        if counts or self.head is None:
            is_many = any(count > 1 for count in (*counts, self.count)) or self.picks == "others"
            return is_many or any(one.endswith("s") for one in parts)
        if self.head.has("effect") and not self.head.has("noun"):
            return self.head.text.partition(" of ")[0].endswith("s")  # "clouds of dust"
        senses = [one.value for one in self.head.all("noun")]
        is_name = any(one.noun == self.head.text for one in senses)  # "fish", "sheep"
        is_open = is_name and self.article not in ("a", "an")
        same = [one for one in senses if one.noun == senses[0].noun] if is_open else senses[:1]
        return any(one.is_plural for one in same)


def heads_of(groups: Sequence[Group]) -> list[Token]:
    """Heads of those groups that have one."""
    return [one.head for one in groups if one.head is not None]


def nouns_of(groups: Sequence[Group]) -> list[str]:
    """Nouns of those groups that have one."""
    return [one.noun.noun for one in groups if one.noun is not None]


def words_of(groups: Sequence[Group]) -> list[Token]:
    """Words of groups, no articles."""
    return [word for one in groups for word in one.words]


def is_trajectory(group: Group) -> bool:
    """Whether it names the way of something, which is no place: "each other's path"."""
    is_owned = group.article in word_set("things", "owners")
    is_owned |= any(one.text.endswith(("'s", "’s", "s'")) for one in group.unknown)
    head = group.head
    return bool(is_owned and head and head.text in word_set("things", "trajectories"))


@dataclass(frozen=True)
class Phrase:
    """Preposition with its groups; without any, a pronoun follows: "behind them"."""

    preposition: Token
    groups: tuple[Group, ...]


@dataclass
class GroupReader:
    """Position in the tokens; each method reads on from there."""

    _tokens: Sequence[Token]
    _at: int = 0
    _has_verb: bool = False
    """Whether the clause has its verb: what follows is none."""

    def _token(self, ahead: int = 0) -> Token:
        return token_at(self._tokens, self._at + ahead)

    def _take(self) -> Token:
        self._at += 1
        return self._token(-1)

    def _starts_group(self, ahead: int = 0) -> bool:
        token, after = self._token(ahead), self._token(ahead + 1)
        if token.has("articles"):
            is_back = token.has("pronouns") and after.text.endswith("ly")  # "circles her slowly"
            is_back &= not self._starts_group(ahead + 2)
            is_end = after.text.endswith("camera") or after.has("camera") or after.is_sign
            is_led = after.text.startswith(_PREPOSITIONS) or after.has("relation")
            is_end |= token.has("pronouns") and is_led  # "behind her in the rain"
            return not (is_end or is_back)
        is_view = token.has("shot") and not token.has("noun", "place")
        is_alone = is_view or token.text.startswith(_PREPOSITIONS)  # "aerial view", "at night"
        if token.has(*_STANDPOINTS) or token.is_sign or is_alone:
            return False
        if token.has("noun", "place", "effect", "pose", "field"):
            return True
        if token.has("partitive"):
            return self._starts_group(ahead + 1)
        is_before = token.has(*MODIFIERS) or bool(token.verbs("ing", "ed"))
        is_part = after.text in word_table("parts")
        is_noun = is_part or after.has("noun", "place", *MODIFIERS)
        is_noun &= not after.text.startswith(_PREPOSITIONS)  # "moving in the wind"
        if is_before and is_noun and not after.has("relation"):
            return True
        return token.has("scene") or (token.is_unknown and not token.text.endswith("ly"))

    def _group(self) -> Group:
        modifiers: list[Token] = []
        unknown: list[Token] = []
        head, article = None, self._token().text if self._token().has("articles") else ""
        while self._token().has("articles", "partitive"):
            part = self._take()
            modifiers += [part] if part.has("partitive") else []
        first = self._at
        while head is None and not self._ends_group(first) and self._agrees(article, first):
            token = self._take()
            if token.is_unknown and token.text not in word_table("states"):
                unknown.append(token)
                if article in ("a", "an"):  # "a six axis arm" is one
                    modifiers = [one for one in modifiers if not _counts(one)]
            elif not token.has(*_HEADS) or self._stands_before(token):
                modifiers.append(token)
            elif self._is_compound(article, first):
                unknown.append(token)
            else:
                head = token
        if self._at == first and self._token() is not NO_TOKEN:
            unknown.append(self._take())
        tail = [self._take() for _ in range(self._tail() if head else 0)]
        head = head or self._shared_head(article, [] if unknown else modifiers)
        known, lost = (modifiers, []) if head else ([], modifiers)
        of = None
        is_of = self._token().text == "of" or self._token().has("containing")
        is_doing = bool(self._token(1).verbs("ing")) and self._token(2).is_unknown
        is_content = is_doing and self._token(3).has("noun")  # "of ticking alarm clocks"
        if is_of and (self._starts_group(1) or is_content):
            of = Phrase(self._take(), (self._group(),))
        elif head is None and self._token().text == "of" and self._token(1).text == "them":
            of = Phrase(self._take(), ())
            self._take()
        lost = [*lost, *unknown, *tail[:-1]]
        return Group(head, (*known, *tail[-1:]), tuple(lost), article, of)

    def _shared_head(self, article: str, modifiers: Sequence[Token]) -> Token | None:
        """Head of the group after "and", if both count: "two red and two blue cars"."""
        mine, start = (bool(article), any(map(_counts, modifiers))), self._at
        if not (any(mine) and modifiers and self._token().text == "and" and self._starts_group(1)):
            return None
        self._take()
        other, self._at = self._group(), start
        is_like = mine == (bool(other.article), other.is_counted)
        return other.head if is_like and other.head and other.head.has("noun") else None

    def _tail(self) -> int:
        """Number of words after a noun that add nothing to it: "checkerboard test pattern"."""
        ahead = 0
        while self._token(ahead).is_unknown:
            ahead += 1
        return ahead + 1 if self._token(ahead).has("hollow") else 0

    def _ends_group(self, first: int) -> bool:
        token = self._token()
        if token.text == "and" and self._joins_adjectives():
            return False
        if self._at > first and token.text.startswith(_PREPOSITIONS):
            return True  # "blue lights at night"
        if token is NO_TOKEN or token.is_sign or token.text == "and" or token.has(*_STANDPOINTS):
            return True
        if token.has(*_HEADS, *MODIFIERS):
            return token.has("relation") and self._at > first
        if token.is_unknown and self._at > first and self._has_object():
            return True  # "a player in white serves the ball"
        before = self._token(-1)
        if self._at > first and before.is_unknown and is_plural_form(before.text):
            return True  # "in blue kimonos wooden boxes": the colour is not that of the boxes
        is_many = before.text.endswith("s") or not self._token(1).has(*_HEADS)
        if before.is_unknown and is_many and token.text.endswith("ing"):
            return self._at > first  # "travellers pulling", "a white line spinning at 3 Hz"
        is_state = token.text in word_table("states") and self._at == first
        led = self._token(2) if self._token(1).says("field", "colour") else self._token(1)
        is_led = before.has("articles") and led.has("noun")  # "a face shield", "the lead red car"
        is_state |= is_led and bool(token.verbs("base"))
        is_word = token.is_unknown or token.has("picture") or is_state
        return not (is_word or token.verbs("ing", "ed"))

    def _joins_adjectives(self) -> bool:
        """Whether "and" stands between two of a kind: "a black and white disc"."""
        sides, head = (self._token(-1), self._token(1)), self._token(2)
        before, after = ({one.value[0] for one in each.all("field")} for each in sides)
        is_noun = head.has("noun", "hollow", "field") or head.is_unknown
        return bool(before & after - {"count"}) and is_noun and not head.has("relation")

    def _stands_before(self, token: Token) -> bool:
        """Whether a word that may be a head, just read, is a modifier: "orange welding robot"."""
        ahead = 0
        while self._token(ahead).is_unknown and not self._has_object(ahead):
            ahead += 1
        after = self._token(ahead)
        is_before = token.has(*MODIFIERS) and not after.has("relation")
        is_before &= not after.text.startswith(_PREPOSITIONS)  # "in the rain at night"
        return is_before and after.has(*_HEADS, "field")

    def _is_compound(self, article: str, first: int) -> bool:
        """Whether the word that follows is the head: "dog house", "a square red box"."""
        ahead = 0
        while article and self._token(ahead).has("field") and not _counts(self._token(ahead)):
            ahead += 1
        if ahead and self._token(ahead).has("noun") and self._agrees(article, first, ahead):
            return True
        after = self._token()
        is_base = {one.form for one in after.all("verb")} == {"base"} and not after.has("relation")
        is_named = is_base and article in ("a", "an")  # no verb of one: "across a car park"
        is_head = after.has("noun", "place") and not after.has("relation", "adverb")
        is_head &= is_named or not after.has("verb")
        is_head = is_head and self._agrees(article, first) and not self._has_object()
        nouns = [one.value for one in self._token(-1).all("noun")]
        is_many = bool(nouns) and all(one.is_plural for one in nouns)  # "dogs fish", no "aircraft"
        known = [NOUNS.get(one.noun) for one in nouns]
        is_inert = bool(known) and all(one and not one.speed_m_s for one in known)
        led = token_at(self._tokens, first - 1)
        is_lone = is_inert and not (article or any(one.is_plural for one in nouns))
        is_lone &= led.has("verb", "relation") and not led.has("noun")  # "wears oven gloves"
        led = self._token(1)  # "with guards hovers"
        is_lone |= self._has_verb or (bool(led.verbs("s")) and not led.has("noun"))
        is_verb = after.text.endswith(("ing", "ed", "ly", *(() if is_lone else ("s",))))
        is_verb |= after.has("other")
        is_word = after.is_unknown or (is_named and is_inert)  # "a chair lift"
        is_word &= after.text.isalpha() and not is_verb and not self._tail()
        is_word = is_word and not self._token(1).has("articles")  # "a table outside a cafe"
        return (is_head or is_word) and not is_many

    def _agrees(self, article: str, first: int, ahead: int = 0) -> bool:
        """Whether a noun may follow these words of a group: no plural "a", no singular "two"."""
        senses = [one.value for one in self._token(ahead).all("noun")]
        words, is_one = self._tokens[first : self._at], article in ("a", "an")
        is_other = is_one and any(one.is_unknown for one in words)  # "a six axis robot arm"
        counts = [count for one in words for count in _counts(one) if not is_other]
        is_owned = any(one.text.endswith(("'s", "’s")) for one in words)  # "a man's hands"
        if not senses and counts == [1.0] and self._token(ahead).verbs("s"):
            return False  # "the left one waves"
        if not senses or is_owned or not (counts or is_one):
            return True
        after = self._token(ahead + 1)
        is_first = after.has("noun") and not after.has("verb", "relation")  # "two sedan cars"
        return any(one.is_plural is (bool(counts) and counts[-1] > 1.0) for one in senses) or (
            is_first and self._agrees(article, first, ahead + 1)
        )

    def _has_object(self, ahead: int = 0) -> bool:
        """Whether a word that may be a noun is a verb: "and watches the ducks", "and wugs it"."""
        token, after = self._token(ahead), self._token(ahead + 1)
        is_pronoun = after.has("pronouns") and token.is_unknown
        return token.text.endswith("s") and (after.has("articles") or is_pronoun)

    def _names_purpose(self) -> bool:
        """Whether "to" leads to what is done to something: "leaps to catch a frisbee"."""
        done, is_so = self._token(1), self._token(-1).text not in word_set("things", "unfulfilled")
        is_so &= bool(done.verbs("base")) and not done.has(*_HEADS, *MODIFIERS)
        return is_so and (self._starts_group(2) or self._token(2).has("pronouns"))

    def _share_verb(self, groups: Sequence[Group]) -> bool:
        """Whether a list of bare plurals does what follows: "with cars and dogs running"."""
        is_bare = all(one.is_plural and not one.article for one in groups)
        return is_bare and bool(self._token().verbs("ing"))

    def _is_like(self, preposition: Token) -> bool:
        """Whether a preposition is here like the one before, or one with a pronoun."""
        token, positions = self._token(), word_set("things", "positions") - {"between"}
        kinds = preposition.relations | token.relations
        is_back = preposition.text != "with" and self._token(1).has("pronouns")
        is_both = token.has("relation") and preposition.has("relation")
        return is_both and (token.text == preposition.text or is_back or kinds <= positions)
