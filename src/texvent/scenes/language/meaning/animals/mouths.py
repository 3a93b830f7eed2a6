"""What animals do with head and mouth: drink, eat, chew, lick, yawn."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.meaning.animals.words import is_own, list_heads, say, split_words
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word, mark_used

_BENDING = split_words("bend lean stoop reach dip lower drop crane")


_AT_MOUTH = {"drink": "drink", "eat": "eat", "graze": "graze", "sniff": "sniff", "feed": "eat"}


LYING = split_words("rest relax nap snooze lounge sprawl slumber sunbathe recline lay laze")
"""Verbs of an animal that lies."""


_RESTING = LYING | {"lie"}


_SHOWN_BY = {
    "groom": split_words("tongue paw"), "drink": split_words("tongue mouth trunk"),
    "spray": split_words("trunk"), "catch": split_words("mouth jaw jaws teeth beak"),
    "yawn": split_words("mouth jaw jaws tongue"), "pant": split_words("tongue mouth"),
}  # fmt: skip
"""Act → parts whose use its model shows."""


_CLEANING = split_words("groom lick clean wash preen")


_OUT = split_words("stick extend poke hang show")


def bend_down(clause: Clause, following: Clause | None) -> bool:
    """As in "bends down to drink water from a river", "lowers its head to graze"."""
    verb = clause.verb
    if verb is None or verb.lemma not in _BENDING:
        return False
    if any(group.head is None or group.head.text != "head" for group in clause.objects):
        return False
    down = [word for word in clause.adverbs if word.text in ("down", "over", "low")]
    for word in down:
        word.meaning = Meaning(Role.FUNCTION, Pos.ADVERB)
    own = [verb, *down]
    own += [word for group in clause.objects for word in group.words]
    for phrase in clause.phrases:
        group = phrase.groups[0] if phrase.groups else None
        first = group.words[0] if group is not None and group.words else None
        if phrase.preposition.text != "to" or group is None or first is None:
            continue
        if first.text not in _AT_MOUTH:
            continue
        _bow(clause, own, first, _AT_MOUTH[first.text])
        phrase.preposition.meaning = Meaning(Role.FUNCTION, Pos.PREPOSITION)
        phrase.preposition.is_used = True
        clause.phrases.remove(phrase)
        _drop_water(clause, group)
        _take_rest(clause, following)
        return True
    if following is not None and following.verb is not None and (
        following.verb.lemma in _AT_MOUTH and not following.is_participle
    ):  # fmt: skip
        mark_used(own)
        verb.meaning = Meaning(Role.FUNCTION, Pos.AUXILIARY)
        clause.verb, clause.objects, clause.adverbs = None, [], []
        clause.auxiliaries = []
        return True
    return False


def _take_rest(clause: Clause, following: Clause | None) -> None:
    """As in "to drink", "water from a river": where it drinks belongs to the same clause."""
    if following is None or following.verb is None or following.verb.text != "water":
        return
    mark_used([following.verb])
    following.verb.meaning = Meaning(Role.FUNCTION, Pos.NOUN)
    clause.phrases.extend(following.phrases)
    following.verb, following.phrases, following.subjects = None, [], []


def _bow(clause: Clause, own: Sequence[Word], act: Word, kind: str) -> None:
    """The clause's verb is what it bends down for."""
    form = clause.verb_word.meaning.form
    mark_used(own)
    clause.verb_word.meaning = Meaning(Role.FUNCTION, Pos.AUXILIARY)
    act.meaning, act.lemma = Meaning(Role.SIMILAR, Pos.VERB, (kind, False), form), kind
    act.others = ()
    clause.verb, clause.objects = act, []
    clause.adverbs = [word for word in clause.adverbs if word not in own]


def _drop_water(clause: Clause, group: NounGroup) -> None:
    """What is drunk from a river is its water; other food is what the mouth is at."""
    rest = [word for word in group.words if word is not clause.verb]
    if all(word.text in ("water", "some", "the", "fresh") for word in rest):
        mark_used(word for word in rest if word.text != "fresh")
        return
    group.modifiers = [word for word in group.modifiers if word is not clause.verb]
    if group.head is not clause.verb:
        clause.objects = [group]


def clean(clause: Clause) -> bool:
    """As in "grooms itself with its tongue", "licks its paw"."""
    if clause.verb_word.lemma not in _CLEANING:
        return False
    own = [group for group in clause.objects if is_own(group)]
    if clause.objects and not own:
        return False
    say(clause.verb_word, "groom")
    for group in own:
        mark_used(
            word for word in group.words if word.role is not Role.UNKNOWN or word is group.head
        )
        clause.objects.remove(group)
    return True


def stick_out(clause: Clause, following: Clause | None) -> bool:
    """As in "sticks out its tongue"."""
    heads = [group.head for group in clause.objects if group.head is not None]
    if clause.verb_word.lemma not in _OUT or [head.lemma for head in heads] != ["tongue"]:
        return False
    if following is not None and following.verb is not None and following.verb.lemma == "yawn":
        # The tongue is out while it yawns.
        mark_used(
            word for group in clause.objects for word in group.words if word.role is not Role.SIZE
        )
        clause.verb_word.is_used = True
        clause.verb_word.meaning = Meaning(Role.FUNCTION, Pos.AUXILIARY)
        clause.verb, clause.objects = None, []
        return True
    say(clause.verb_word, "pant")
    mark_used(
        word for group in clause.objects for word in group.words if word.role is not Role.SIZE
    )
    mark_used(word for word in clause.adverbs if word.text == "out")
    clause.objects = []
    return True


def chew(clause: Clause, following: Clause | None) -> bool:
    """As in "chews cud", "chews while it rests"."""
    heads = [group.head for group in clause.objects if group.head is not None]
    if clause.verb_word.lemma not in ("chew", "ruminate"):
        return False
    if heads and [head.lemma for head in heads] != ["cud"]:
        return False
    rests = following is not None and following.verb is not None and following.is_participle
    if rests and following is not None and following.verb_word.lemma in _RESTING:
        say(clause.verb_word, "lie and chew")
        following.verb_word.is_used = True
        following.verb_word.meaning = Meaning(Role.FUNCTION, Pos.AUXILIARY)
        following.verb = None
    else:
        say(clause.verb_word, "chew")
    mark_used(word for group in clause.objects for word in group.words)
    clause.objects = []
    return True


def use_own_parts(clause: Clause) -> None:
    """As in "with its tongue", "in its powerful jaws", where the model does it with them."""
    if clause.verb is None:
        return
    value = clause.verb.meaning.value
    act = value[0] if isinstance(value, tuple) else getattr(value, "base", "")
    shown = _SHOWN_BY.get(act, frozenset())
    for phrase in list(clause.phrases):
        if phrase.preposition.text not in ("with", "in", "using", "from"):
            continue
        for head in list_heads(phrase):
            if head.lemma in shown or head.text in shown:
                mark_used([phrase.preposition, head])
                clause.phrases.remove(phrase)
                break


def drink_water(clause: Clause) -> bool:
    """As in "drinks water": from a bowl, or from a puddle, where no place has water."""
    if clause.verb_word.lemma not in ("drink", "lap", "sip") or len(clause.objects) != 1:
        return False
    group, head = clause.objects[0], clause.objects[0].head
    if head is None or head.text != "water":
        return False
    if any(one.preposition.text in ("from", "out of", "in", "at") for one in clause.phrases):
        mark_used([head])
        clause.objects = []
        return True
    animal = clause.subjects[0].head_word.meaning.value
    vessel = "puddle" if animal in _LARGE else "water bowl"
    head.mean(Meaning(Role.NOUN, Pos.NOUN, vessel))
    head.lemma = vessel
    group.determiner = None
    return True


_LARGE = frozenset({"elephant", "horse", "cow", "zebra", "giraffe", "deer", "lion", "tiger", "bear",
                    "camel", "donkey", "bull", "rhino", "hippo", "bison", "reindeer"})  # fmt: skip
"""Animals that drink from no bowl."""


def eat_leaves(clause: Clause) -> bool:
    """As in "a giraffe eats leaves from a tree": its mouth is in the crown of the tree."""
    animal = clause.subjects[0].head_word.meaning.value
    heads = [group.head for group in clause.objects if group.head is not None]
    if clause.verb_word.lemma not in _BROWSING or animal not in _TALL or not heads:
        return False
    if not all(head.lemma in ("leaf", "leave", "leaves", "foliage", "branch") for head in heads):
        return False
    for phrase in list(clause.phrases):
        trees = [
            head for head in list_heads(phrase) if head.lemma.split()[-1] in ("tree", "acacia")
        ]
        if phrase.preposition.text in ("from", "off", "of", "on", "in") and trees:
            say(clause.verb_word, "eat high")
            for head in heads:
                head.meaning, head.is_used = Meaning(Role.FUNCTION, Pos.NOUN), True
            phrase.preposition.is_used = True
            clause.objects = phrase.groups
            clause.phrases.remove(phrase)
            return True
    return False


_BROWSING = split_words("eat munch nibble browse chew pluck feed")


_TALL = frozenset({"giraffe", "elephant"})
"""Animals whose mouth reaches the crown of a tree."""
