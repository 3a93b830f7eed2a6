"""Verbs of hand work: what they are done to, and when they are none."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.acts.activities import find_activity
from texvent.scenes.language.meaning.acts.sequence import add_motion
from texvent.scenes.language.meaning.capabilities import is_hand, is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import PERSON
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.people.activities import SEATS
from texvent.scenes.models.people.work.verbs import HANDWORK, MOVED, ONTO
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.wrapped.opening import OPENING, OPENS, opens_after

DRINKS = frozenset({"drink", "lap", "eat", "nibble", "feed", "peck"})
"""What a mouth does "from" something."""
_AT = frozenset({"knock", "hammer", "tug", "poke", "pick", "prod", "pound", "tap", "hew"})
"""Hand work at something: "pounds at a door"."""


def list_goals(clause: Clause) -> tuple[str, ...]:
    """Prepositions before what a verb of hand work is done to, besides its object.

    As in "knocks on a door", "pours milk into a cup"; not "knits on a sofa".
    """
    lemma = clause.verb_word.lemma
    work = HANDWORK[lemma]
    if work.pattern in MOVED:
        return ()  # "puts on a coat"
    if work.pattern in ONTO:
        return ("into", "in", "onto", "on", "over", "to")
    if lemma == "reach":
        return ("for", "into", "towards", "toward")
    heads = [group.head for phrase in clause.phrases for group in phrase.groups]
    nouns = [head.read_as(Role.NOUN) for head in heads if head is not None]
    if (
        lemma in _BY_ITSELF
        or clause.objects
        or any(one is None or one.value in SEATS for one in nouns)
    ):
        return ()
    return ("on", "at", "against") if lemma in _AT else ("on",)


def give_bodies(draft: Draft, clause: Clause, subjects: Sequence[Referent]) -> None:
    """As in "hands knead dough": hands at work are those of a person."""
    word = clause.verb
    gesture = find_activity(clause, is_hand=True) if word is not None else None
    is_at_keys = gesture is not None and gesture[0] == "type" and (clause.objects or clause.phrases)
    # As in "a hand opens a door": done to a thing, it is no gesture.
    heads = [group.head for group in clause.objects if group.head is not None]
    is_thing = any(head.role is Role.NOUN for head in heads)
    is_at_thing = word is not None and word.lemma in HANDWORK and is_thing
    if word is None or (gesture is not None and not (is_at_keys or is_at_thing)):
        return
    if word.lemma not in HANDWORK and find_activity(clause, is_hand=False) is None:
        return
    for one in subjects:
        for index in one.things if one.is_things else ():
            if is_hand(draft.noun(index)):
                item = draft.objects[index]
                item.noun, item.count, item.motions = PERSON, 1, []
                one.group.head_word.shown_as = "person at work"
                for count in one.group.words:
                    if count.role is Role.COUNT:
                        count.is_used, count.is_lost = False, True


_BY_ITSELF = ("boil", "simmer")
"""What things do as well: "a kettle boils on a stove"."""
_STRUCK = ("hit", "strike")
_WEIGHTS = frozenset({"barbell", "dumbbell", "kettlebell"})
_BY_HAND = frozenset({*_STRUCK, "lift", "shake", "drop", "grab"})
_FLYING = frozenset({"shuttlecock", "frisbee", "puck"})


def is_hand_work(verb: Verb, target: Noun) -> bool:
    """Whether a person does it with the hands at a thing that stays: not "hits a ball"."""
    if verb.base not in _BY_HAND or verb.base not in HANDWORK or target.name in _WEIGHTS:
        return False
    flies = "ball" in target.name or target.name in _FLYING
    return not (flies and verb.base in _STRUCK)


_BODY = frozenset(
    {"forehead", "face", "brow", "nose", "eye", "mouth", "hair", "beard", "tooth", "teeth", "hand",
     "lip", "chin", "sweat", "tear", "head", "neck", "arm", "leg", "foot", "feet", "finger", "nail",
     "cheek", "body", "back", "belly"}
)  # fmt: skip
"""Objects of hand work that are parts of the own body."""


def is_of_own_part(name: str, objects: Sequence[Referent]) -> bool:
    """As in "two men shake hands", "wipes her forehead": no hand work at a thing."""
    if name not in HANDWORK or any(one.is_things for one in objects):
        return False
    heads = {one.group.head_word.lemma for one in objects if one.group.head is not None}
    return any(one.kind == "part" for one in objects) or bool(heads & _BODY)


def lacks_thing(name: str, objects: Sequence[Referent]) -> bool:
    """As in "puts effort into it": nothing is shown that is put down or picked up."""
    is_moving = name in HANDWORK and HANDWORK[name].pattern in MOVED
    return is_moving and not any(one.is_things for one in objects)


def is_by_hand(draft: Draft, verb: Verb, subjects: Sequence[int], targets: Sequence[int]) -> bool:
    """Whether a verb of motion is hand work of a person at this thing."""
    doer, target = draft.noun(subjects[0]), draft.noun(targets[0])
    return is_person(doer) and is_hand_work(verb, target)


_DRAWING = frozenset({"draw", "sketch", "doodle"})
"""Verbs whose object is before who draws it, not under the pen."""


def work_on(draft: Draft, word: Word, people: Sequence[int], objects: Sequence[Referent]) -> None:
    """Relate people to what they work on; the word says less where that is not shown."""
    targets = [index for one in objects if one.is_things for index in one.things]
    work = HANDWORK.get(word.lemma)
    is_onto = work is not None and work.pattern in ONTO
    is_drawn = word.lemma in _DRAWING
    if is_drawn or (work is not None and work.pattern == "scribble"):
        # Who draws a cat has a pen on paper, not on the cat.
        targets = [n for n in targets if not (is_drawn or is_living(draft.noun(n)))]
    draft.relate("work on", people, targets[-1:] if is_onto else targets[:1])
    if is_onto and len(targets) > 1:
        draft.relate("hold", people, targets[:1])
    seen = work.shown_as if work is not None else ""
    opened = [index for index in targets[:1] if draft.noun(index).name in OPENING]
    if word.lemma in OPENS and opened:
        # As in "opens and closes a box".
        before = draft.objects[people[0]].motions[-2:-1] if people else []
        kind = opens_after(before[0].kind if before else None, word.lemma)
        draft.objects[opened[0]].motions = [ObjectMotion(kind)]
        if kind != word.lemma:
            # The hands stay at it for both.
            for index in people:
                del draft.objects[index].motions[1:]
        seen = ""
    if seen:
        word.shown_as = seen
    if objects and not targets and not is_drawn:
        word.shown_as = f"{seen or word.lemma} nothing"


def work_by_hand(
    draft: Draft, clause: Clause, subjects: Sequence[int], targets: Sequence[int]
) -> list[int]:
    """As in "hits a drum with a stick", "lifts a box": hands at what stays in its place.

    Returns:
        Who does it.
    """
    verb = clause.verb_word.meaning.value
    motion = ObjectMotion(verb.base, pace=verb.pace)
    movers = [index for index in subjects if add_motion(draft, index, motion, clause)]
    if movers:
        clause.verb_word.is_used = draft.relate("work on", movers, targets[:1])
    return movers
