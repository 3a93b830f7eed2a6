"""Noun groups to what they mean: objects of the scene, the camera, a place, a light ..."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import Effect
from texvent.scenes.language.grammar.syntax import NounGroup
from texvent.scenes.language.meaning.adjectives import Attributes, read_attributes
from texvent.scenes.language.meaning.capabilities import is_person
from texvent.scenes.language.meaning.draft import Draft, PartialObject
from texvent.scenes.language.meaning.referents.crowds import (
    add_passers,
    add_traffic,
    find_drifting,
    name_kind_before,
)
from texvent.scenes.language.meaning.referents.earlier import find_coloured, find_kind
from texvent.scenes.language.meaning.referents.heads import find_head, is_said_once, name_kind
from texvent.scenes.language.meaning.referents.parts_shown import (
    BODY_PARTS,
    is_own_hand,
    list_parts_shown,
    list_people,
    shows_part,
)
from texvent.scenes.language.meaning.referents.pronouns import OF_ONE_PERSON, Antecedents
from texvent.scenes.language.meaning.referents.referent import KIND_OF_ROLE, Referent
from texvent.scenes.language.meaning.referents.senses import (
    RELATIVES,
    choose_pattern,
    choose_sense,
    is_figurative,
    is_no_pattern,
    is_of_drinks,
    is_other_sense,
    is_pane,
    is_part_of_named,
    read_herd,
    read_young,
)
from texvent.scenes.language.vocabulary.acts import WEARABLE
from texvent.scenes.language.vocabulary.function import (
    DEFINITE,
    NOBODY,
    SOMEONE,
    UNNAMED,
    VIEWERS,
)
from texvent.scenes.language.vocabulary.objects import MAX_COUNT, PLURAL_COUNT, SURROUND_COUNT
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, link, mark_used
from texvent.scenes.models.kinds.looks import LOOKS
from texvent.scenes.models.kinds.people import TRAFFIC
from texvent.scenes.models.kinds.things import ONE_THING
from texvent.scenes.models.people.work.verbs import HANDWORK

PERSON = "person"
OUR = ("our", "my")
"""Owners that make a vehicle the camera's: "our car leaves a tunnel"."""
_ONE_BARBELL = "weights"
"""Of who lifts weights, one is shown."""
_LOCATIVE = frozenset(
    {"in", "on", "through", "across", "along", "at", "into", "up", "down", "onto", "over", "inside",
     "to", "from", "past", "around", "within", "above", "towards", "toward"}
)  # fmt: skip
"""Prepositions after which a mountain is a place to be, not an object to look at."""


_RANGES = frozenset({"mountains", "peaks", "mountain peaks"})
"""Plurals that stand all around, unless they are counted."""
_OUTSIDE = frozenset({"above", "past", "around", "over", "towards", "toward", "from", "to", "at"})
"""Prepositions after which a building is looked at from outside."""
_AROUND = ("surrounded by", "among", "amongst", "amid", "lined with", "lined by")
"""Prepositions after which a bare plural means many."""


class Referents(Antecedents):
    """Gives noun groups their meaning, each once."""

    def __init__(self, draft: Draft) -> None:
        super().__init__(draft)
        self._known: dict[int, Referent] = {}
        self._wholes: Sequence[int] = ()
        self._relatives: dict[str, int] = {}
        self.verb = ""
        """Verb of the clause whose subjects are being read."""
        self.has_body = False
        """Whether the clause is about people or animals: "claps hands" shows no further hands."""

    def resolve(
        self, group: NounGroup, preposition: str | None = None, wholes: Sequence[int] = ()
    ) -> Referent:
        """What a group means.

        Args:
            group: the noun group.
            preposition: what stands before it, if any.
            wholes: objects that it may be a part of: "a car with black wheels".
        """
        found = self._known.get(id(group))
        if found is None:
            self._wholes = wholes if preposition == "with" else ()
            found = self._read(group, preposition)
            self._known[id(group)] = found
            if found.is_things:
                link(group.words, found.things)
        return found

    @property
    def named(self) -> list[Referent]:
        """What all groups that were read mean."""
        return list(self._known.values())

    def forget(self, group: NounGroup) -> None:
        """A group names nothing of the scene."""
        self._known[id(group)] = Referent("unknown", group)

    def recall(self, group: NounGroup | None) -> Referent | None:
        """What a group was found to mean; None if it was not asked before."""
        return self._known.get(id(group)) if group is not None else None

    def _read(self, group: NounGroup, preposition: str | None) -> Referent:
        head = group.head
        if head is None:
            return Referent("unknown", group, attributes=read_attributes(group.modifiers))
        if head.pos is Pos.PRONOUN:
            return self._read_pronoun(group, head, preposition)
        if head.pos is Pos.NEGATION or head.text in NOBODY:
            return self._exclude(group, PERSON)
        head = find_head(group)
        if head.is_viewpoint:
            head.is_used, head.shown_as = True, "the camera's view from it"
            return Referent("camera", group, attributes=read_attributes(group.modifiers))
        herd = None if read_young(group, self._draft) else read_herd(group, self._draft)
        head = group.head_word
        attributes = read_attributes(group.modifiers)
        bodies = self._find_bodies(group)
        if bodies:
            mark_used([head])
            return Referent("things", group, bodies, attributes=attributes)
        if herd is not None:
            attributes.count = herd
        elif (
            is_figurative(group, preposition)
            or is_pane(group, self._draft, preposition)
            or is_other_sense(group, self._draft, preposition)
        ):
            return Referent("unknown", group, attributes=attributes)
        signal = self._find_signal(group)
        if signal is not None:
            mark_used([head])
            return Referent("things", group, [signal], attributes=attributes)
        role = self._choose_role(head, preposition, group)
        if role is Role.NOUN:
            return self._read_noun(group, attributes, preposition)
        return self._read_no_thing(group, role, attributes)

    def _read_no_thing(self, group: NounGroup, role: Role, attributes: Attributes) -> Referent:
        """A place, a light, a part ..."""
        head = group.head_word
        if role is Role.PLACE and group.negation is None:
            add_passers(self._draft, group)
        if role is Role.PART and group.negation is not None:
            # As in "a cat with no tail": the model has one all the same.
            head.is_lost = True
            return Referent("unknown", group, attributes=attributes)
        kind = KIND_OF_ROLE.get(role, "unknown")
        if kind == "function":
            head.is_used = True
        meaning = head.read_as(role)
        value = meaning.value if meaning is not None else None
        return Referent(kind, group, value=value, attributes=attributes)

    def _find_signal(self, group: NounGroup) -> int | None:
        """As in "the light changes", where a traffic light is."""
        is_known = group.determiner is not None and group.determiner.text in DEFINITE
        if group.head_word.text not in ("light", "signal") or not is_known:
            return None
        return self._draft.find("traffic light", None)

    def _choose_role(self, head: Word, preposition: str | None, group: NounGroup) -> Role:
        """A word that is a thing and a place, or a thing and a part of one."""
        thing = head.read_as(Role.NOUN)
        is_thing = thing is not None
        place = head.read_as(Role.PLACE)
        if is_thing and place is not None:
            if head.lemma == "square" and any(w.role is Role.COLOUR for w in group.modifiers):
                return Role.NOUN
            if head.lemma == "square" and self.doers:
                return Role.PLACE
            if place.value == "indoor" and preposition in _OUTSIDE:
                return Role.NOUN
            is_range = head.text in _RANGES and not read_attributes(group.modifiers).is_many
            is_around = is_range or (preposition in _AROUND and place.value == "mountain")
            return Role.PLACE if is_around or preposition in _LOCATIVE else Role.NOUN
        if is_thing and self.has_body and head.lemma in BODY_PARTS:
            return Role.PART
        if is_own_hand(self._draft, head.read_as(Role.NOUN)):
            return Role.PART
        if thing is not None and head.read_as(Role.PART) is not None:
            is_owned = thing.value not in WEARABLE and (
                group.owner is not None
                or (group.determiner is not None and group.determiner.text in OWNERS)
            )  # "a man's cap" is no part of him
            is_owned = is_owned or list_parts_shown(self._draft, self._wholes, head.text)
            return Role.PART if is_owned else Role.NOUN
        if is_thing:
            return Role.NOUN
        return head.role

    def _find_bodies(self, group: NounGroup) -> list[int]:
        """As in "a surgeon's hands": the surgeon, not hands without a body."""
        meaning = group.head_word.read_as(Role.NOUN)
        if is_own_hand(self._draft, meaning) and self.verb in HANDWORK:
            return list_people(self._draft)[-1:]
        owners = [one for phrase in group.phrases if phrase.preposition.text == "of"
                  for one in phrase.groups]  # fmt: skip
        owned_by = group.owner or (owners[0] if owners else None)
        if owned_by is None or meaning is None or not meaning.is_plural:
            return []
        owner = self.resolve(owned_by) if meaning.value == "hand" else None
        things = owner.things if owner is not None and owner.is_things else []
        return things if all(is_person(self._draft.noun(index)) for index in things) else []

    def _read_pronoun(self, group: NounGroup, head: Word, preposition: str | None) -> Referent:
        head.is_used = True
        if head.text == "it" and preposition in ("in", "inside") and self.place is not None:
            return Referent("place", group, value=self.place.value)
        if head.text in VIEWERS:
            return Referent("camera", group)
        if head.text in SOMEONE:
            index = self._draft.add(PartialObject(PERSON))
            return Referent("things", group, [] if index is None else [index])
        if head.text in UNNAMED:
            head.is_used, head.is_lost = False, True
            return Referent("unknown", group)
        if head.text in ("each other", "one another") and self.doers:
            return Referent("things", group, list(self.doers))
        meant = self.look_back(head.text)
        if meant and head.text not in ("there", "here"):
            return Referent("things", group, meant)
        if head.text in (*OF_ONE_PERSON, "it"):
            head.is_used, head.is_lost = False, True
            return Referent("unknown", group)
        return Referent("function", group)

    def _exclude(self, group: NounGroup, noun: str) -> Referent:
        mark_used(word for word in (group.determiner, group.head) if word is not None)
        if group.negation is not None:
            group.negation.is_used = True
        if group.head is not None and self._comes_with_a_part(group.head.text):
            group.head.is_used, group.head.is_lost = False, True
            return Referent("unknown", group)
        if group.head is not None:
            group.head.is_absent = group.head.text not in NOBODY
        self._draft.exclude(noun)
        return Referent("absent", group)

    def _comes_with_a_part(self, part: str) -> bool:
        """As in "a bicycle with no wheel": the model has one all the same."""
        return any(shows_part(self._draft, i, part) for i in range(len(self._draft.objects)))

    def _read_thing(
        self, group: NounGroup, attributes: Attributes, preposition: str | None
    ) -> Referent:
        head = group.head_word
        meaning = head.read_as(Role.NOUN) or head.meaning
        noun = choose_sense(head, str(meaning.value), self._draft, self.verb)
        noun = choose_pattern(group, noun, self.verb)
        if is_no_pattern(group, noun, preposition, self._draft):
            return Referent("unknown", group, attributes=attributes)
        is_drinks = is_of_drinks(group, preposition) and "glass" in self._draft.nouns
        if is_drinks:
            noun = "glass"
        if group.negation is not None or attributes.number == 0.0:
            mark_used(attributes.numbers)
            return self._exclude(group, noun)
        is_ours = group.determiner is not None and group.determiner.text in OUR
        if is_ours and self._draft.nouns[noun].motion in ("drive", "sail", "fly"):
            head.is_used, head.shown_as = True, "the camera's view from it"
            return Referent("camera", group, attributes=attributes)
        is_bare = group.determiner is None and group.owner is None and attributes.number is None
        is_one = head.text == _ONE_BARBELL
        is_plural = attributes.is_many or (meaning.is_plural and not is_one) or is_drinks
        # "random dots", "scissors", "concentric rings"
        names_one = head.text.endswith("s") and head.text in (
            noun,
            *self._draft.nouns[noun].synonyms,
        )
        is_plural = is_plural or (meaning.can_be_both and is_bare and not names_one)
        is_plural &= attributes.is_many or not is_said_once(group)
        said = name_kind(head) if meaning.is_substitute else None
        is_either = meaning.can_be_both and not attributes.is_many
        index = self._recall(group, noun, None if is_either else is_plural, attributes, said)
        is_each = group.determiner is not None and group.determiner.text in ("each", "every")
        if index is None and is_each and not is_plural:
            index = self._add(noun, is_plural, attributes, self._count_last())
        if index is None:
            bare = SURROUND_COUNT if preposition in _AROUND else PLURAL_COUNT
            bare = meaning.count or (bare if is_plural else 1)
            index = self._add(noun, is_plural, attributes, bare)
        if index is None:
            return Referent("unknown", group, attributes=attributes)
        self._draft.objects[index].said = said or self._draft.objects[index].said
        self._named.append(index)
        self._relatives[head.lemma] = index
        if group.determiner is not None and group.determiner.text in OWNERS:
            self._draft.objects[index].owner = group.determiner.text
        head.is_used = True
        is_other = meaning.is_substitute or (noun != meaning.value and not is_drinks)
        head.shown_as = LOOKS.get(noun, noun if is_other else head.usual_sense)
        name_kind_before(group, noun)
        return Referent("things", group, [index], attributes=attributes)

    def _read_noun(
        self, group: NounGroup, attributes: Attributes, preposition: str | None
    ) -> Referent:
        """A thing, many of them in the air, or traffic."""
        head = group.head_word
        if group.negation is None and is_part_of_named(group, self._draft):
            return Referent("unknown", group, attributes=attributes)
        drifting = find_drifting(group, self.verb)
        if drifting is not None:
            return Referent("effect", group, value=drifting, attributes=attributes)
        if (head.read_as(Role.NOUN) or head.meaning).value in TRAFFIC:
            found = add_traffic(self._draft, head)
            return Referent("things" if found else "unknown", group, found, attributes=attributes)
        return self._read_thing(group, attributes, preposition)

    def _count_last(self) -> int:
        """As in "five camels, each rider": one for each of those named last."""
        counts = [self._draft.objects[index].count for index in self._named]
        return next((count for count in reversed(counts) if count > 1), 1)

    def _recall(
        self,
        group: NounGroup,
        noun: str,
        is_plural: bool | None,
        attributes: Attributes,
        said: str | None,
    ) -> int | None:
        """The object that "the dog" was said of already."""
        determiner = group.determiner
        if determiner is None or determiner.text not in DEFINITE:
            return None
        if attributes.is_new:
            return find_coloured(self._draft, noun, is_plural, attributes)
        if determiner.text in OWNERS and group.head_word.lemma in RELATIVES:
            return self._relatives.get(group.head_word.lemma)
        index = self._draft.find(noun, is_plural, said)
        if index is not None or said is not None:
            return index
        return find_kind(self._draft, self._named, noun, is_plural)

    def _add(self, noun: str, is_plural: bool, attributes: Attributes, bare: int) -> int | None:
        if noun in PAIRED and is_plural and bare == PLURAL_COUNT:
            bare = 2
        elif noun in ONE_THING:
            bare = 1
        count, note = attributes.decide_count(bare)
        if note is not None:
            self._draft.note(note)
        is_counted = not is_plural or attributes.is_many
        item = PartialObject(noun, min(count, MAX_COUNT), is_plural, is_counted)
        index = self._draft.add(item)
        if index is not None:
            attributes.apply(item, self._draft.nouns[noun])
            self.add_effect(attributes, [index])
        return index

    def add_effect(self, attributes: Attributes, things: Sequence[int]) -> None:
        """As in "a steaming cup", "a cup of steaming coffee"."""
        if attributes.effect is not None and things:
            kind, word = attributes.effect
            self._draft.effects.append(Effect(kind, source=things[0]))
            word.is_used = True


PAIRED = frozenset({"hand", "shoe", "boot", "sandal", "high heel", "glove", "sock"})
"""Nouns of which a bare plural means two: "her boots"."""
OWNERS = ("its", "their", "his", "her")
