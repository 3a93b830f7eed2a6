"""Clauses of a prompt: noun groups, one verb, and what is said of both, in all senses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache

from texvent_scenes.models.people.outfit import can_be_worn
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.read.parsing.groups import (
    MODIFIERS,
    Group,
    GroupReader,
    Phrase,
    heads_of,
    nouns_of,
)
from texvent_scenes.read.parsing.lexicon import lexicon_of, list_forms, word_set, word_table
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token

_LED = frozenset({"follow", "orbit"})
"""Moves of a camera about somebody: "tracking shot following a cyclist"."""
_LIT = {"on": "lit", "off": "unlit"}
"""Words after "is" → what they say of lamps."""
_IS = ("is", "are", "was", "were")


@dataclass(frozen=True)
class Clause:
    """Subjects, a verb and its objects, and what is said of them."""

    subjects: tuple[Group, ...] = ()
    verb: Token | None = None
    objects: tuple[Group, ...] = ()
    after: tuple[Phrase | Token, ...] = ()
    """Phrases, adverbs and words of the scene after the subject, and words that are not known."""
    absent: tuple[Group, ...] = ()
    negation: tuple[Token, ...] = ()
    """Words that deny these."""
    is_back: bool = False
    """Whether its object is a pronoun: "overtakes them"."""
    about: str = ""
    """Subject that is not named: "camera"; that of the clause before, "same", "meanwhile" or "then"
    (later); "nearest", its last group; "company", either: "a boat with dolphins jumping"; "told",
    its objects: "watches a dog jump". "where": they are by its last group."""

    @property
    def is_of_effect(self) -> bool:
        """Whether it is about an effect: "smoke rises"."""
        return any(one.has("effect") for one in heads_of(self.subjects))

    @property
    def has_subject(self) -> bool:
        """Whether a verb may follow."""
        return bool(self.subjects or self.about)

    @property
    def is_plural(self) -> bool:
        """Whether a verb in its base form agrees with the subject: "dogs run", "ball drop"."""
        is_open = bool(self.about) or len(self.subjects) > 1
        return is_open or any(one.is_plural or one.is_bare for one in self.subjects)


def read_clauses(tokens: Sequence[Token]) -> tuple[Clause, ...]:
    """Clauses of the tokens, in order."""
    return tuple(one for one in _Parser(tokens).clauses() if one != Clause())


@cache
def _list_leading() -> frozenset[str]:
    """Forms of verbs before an object and its act: "watches a dog jump"."""
    verbs = word_set("things", "leading")
    return frozenset(form for verb in verbs for form, _ in list_forms(verb))


class _Parser(GroupReader):
    """Reader of one clause after the other."""

    def clauses(self) -> Iterator[Clause]:
        """All clauses; each is begun as the one before says."""
        steps = (self._read_camera, self._read_absence, self._read_setting, self._read_verb,
                 self._read_phrase, self._read_adverb, self._read_group)  # fmt: skip
        clause = Clause()
        while self._token() is not NO_TOKEN:
            following = self._begin_following(clause) or self._end(clause)
            if following is not None:
                yield clause
                clause = following
            elif self._token() is not NO_TOKEN:
                self._has_verb = clause.verb is not None
                done = next((one for step in steps if (one := step(clause)) is not None), None)
                clause = self._read_rest(clause) if done is None else done
        yield clause

    def _end(self, clause: Clause) -> Clause | None:
        """Beginning of the next clause, where this one ends here."""
        token, word = self._token(), self._token().text
        if token.is_sign:
            self._take()
            if word == "," and clause.verb is not None and self._token().text == "and":
                return self._end(clause) or Clause()  # "lands, pecks, and flies away"
            return self._go_on(clause) if word == "," else Clause()
        if token.has("conjunctions"):
            is_near = word == "where" and self._token(-1).has("noun") and self._starts_group(1)
            self._take()
            is_same = bool(self._token().verbs("ing")) and not self._token(1).has("noun")
            about = {"then": "then", "where": "where" if is_near else ""}
            return Clause(about=about.get(word, "meanwhile" if is_same else ""))
        if (second := self._begin_with_verb(clause)) is not None:
            return second
        if token.has("relatives") and clause != Clause() and not self._starts_group(1):
            self._take()
            is_shot = not clause.has_subject and self._token(-2).has("shot", "scene", "style")
            return Clause(about="camera" if is_shot else "nearest")  # "side view that slides"
        if word != "and":
            return None
        self._take()
        if self._token().has("conjunctions"):  # "and then"
            return self._end(clause)
        is_how = self._token().text.endswith("ly") and self._token(1).has("verb")
        how = (self._take(),) if is_how and clause.verb is not None else ()
        is_pronoun = self._token().has("pronouns") and self._token(1).has("verb")
        if clause.verb is not None and (is_pronoun or self._is_verb(Clause(about="same"))):
            is_both = bool(clause.verb.verbs("ing") and self._token().verbs("ing"))
            kind = "meanwhile" if is_both else "same"  # "talking and walking"
            return Clause(about=kind, after=how)  # "flies and slowly turns"
        self._at -= len(how)
        if clause.verb is not None and self._token().is_unknown and self._has_object():
            return Clause(about="same", verb=self._take())  # "and wugs it"
        ahead = 1 if self._token().has("articles") else 0
        starts = self._starts_group() or self._token(ahead).has("camera")
        starts = starts or self._token().says("adverb", "start_s")
        return Clause() if starts and (clause.verb or clause.after) else None

    def _begin_following(self, clause: Clause) -> Clause | None:
        """Clause of an act after one that is named: "a cartwheel followed by a flip"."""
        ahead = int(self._token().text == ",")
        led = 2 + ahead + self._token(2 + ahead).has("articles")
        words = [self._token(ahead + n).text for n in (0, 1)]
        act = self._token(led)
        is_verb = bool(act.verbs("base")) and led > 2 + ahead  # "by a jump"
        is_act = (is_verb or act.has("pose")) and not act.has("noun", "effect", "scene")
        if words != ["followed", "by"] or not (is_act and clause.verb is not None):
            return None
        self._at += led if is_verb else 2 + ahead
        return Clause(about="then", verb=self._take() if is_verb else None)

    def _go_on(self, clause: Clause) -> Clause | None:
        """Beginning of the next clause after a comma; None: a list goes on."""
        token, after = self._token(), self._token(1)
        if token.has("relatives") and clause.verb and after.has("verb") and clause.objects:
            self._take()
            return Clause(about="nearest")  # "drops a coin, which spins"
        is_passive = token.verbs("ed") and after.text == "by"  # "drives, followed by a van"
        if clause.has_subject and (is_passive or (clause.verb and self._goes_on(clause.verb))):
            return Clause(about="same")
        goes_on = token.has("relation", "shot") or bool(token.verbs("s"))
        goes_on |= token.text in word_set("things", "mounted")
        if clause.about == "camera" and clause.verb is None and goes_on:
            return Clause(about="camera")  # "the camera, on a tripod, pans left"
        is_part = any(one.picks for one in clause.subjects)
        if is_part and clause.verb is None and token.has("verb"):
            return Clause(about="same")  # "two balls, one red and one blue, collide"
        takes = {
            each for one in token.verbs("ing") for each in (one.value.relation, one.value.kind)
        }
        is_act = bool(takes & word_set("things", "done_to"))
        if clause.verb is not None and token.verbs("ing") and (is_act or not after.has("noun")):
            return Clause(about="meanwhile")  # "sits, reading", "sits, feeding ducks"
        owners, own = word_set("things", "owners"), {after.text, self._token(2).text}
        if token.text in owners and own & word_table("parts").keys():
            return Clause()  # "a fan, its blades spinning"
        is_list = clause.subjects and not (clause.verb or clause.after)
        goes_on = self._starts_group() and not token.has("scene", "shot")
        return None if is_list and goes_on else Clause()

    def _goes_on(self, verb: Token) -> bool:
        """Whether another verb of the same form follows in a list: "rolls, stops and falls"."""
        forms = {one.form for one in verb.all("verb")} & {"s", "ing"} or {"s"}
        is_subject = self._token().has("noun", "effect") and self._token(1).verbs("base", "ing")
        return bool(self._token().verbs(*forms)) and not is_subject

    def _begin_with_verb(self, clause: Clause) -> Clause | None:
        """Clause of a second verb: of a participle, or after one, as in "a car turning passes"."""
        if (led := self._begin_kept() or self._begin_led(clause)) is not None:
            return led
        token, verb = self._token(), clause.verb
        before = clause.after[-1] if clause.after else None
        phrase = before if isinstance(before, Phrase) else None
        groups = clause.objects if phrase is None else phrase.groups
        is_here = bool(groups) and groups[-1].head is self._token(-1)
        if token.verbs("ing") and is_here and (phrase or verb):
            verbs = {one.value.kind for one in token.verbs("ing")}
            word = "" if phrase is None else phrase.preposition.text
            if verb and word not in ("on", "in") and verbs & word_set("things", "in_place"):
                return Clause(about="nearest")  # "behind a disc spinning"
            is_near = word == "with" or self._token(-1).has("noun")
            return Clause(groups, about="company") if verb or is_near else None
        if verb is not None and token.verbs("ed") and self._token(1).text == "by":
            return Clause(about="nearest")  # "drives a tractor followed by birds"
        if verb is None or (verb.is_unknown and verb is self._token(-1)):
            return None
        is_led = verb is self._token(-1 - self._token(-1).has("adverb"))
        if token.text == "to" and is_led and self._names_purpose():
            self._take()
            return Clause(about="camera" if clause.about == "camera" else "same")
        is_open = bool(verb.verbs("ing")) or clause.about == "nearest"
        is_state = bool(verb.verbs("ed")) and not verb.verbs("s")  # "a bird perched here flies"
        forms = ("ing", "s", "base") if is_open else ("ing", "s") if is_state else ("ing",)
        is_next = token.verbs(*forms) and self._is_verb(replace(clause, verb=None))
        return Clause(about="meanwhile") if is_next else None

    def _begin_kept(self) -> Clause | None:
        """Clause of a camera that keeps its subject in view: "keeps her in frame"."""
        aim = int(self._token().text == "to" and self._token(1).text == "keep")
        token = self._token(aim)
        is_done = not aim and bool(token.verbs("ed") or token.text == "kept")
        camera = 2 + self._token(2).has("articles")
        by_camera = self._token(1).text == "by" and self._token(camera).has("camera")
        last = 1 if is_done else next((n for n in range(2, 9) if self._token(n).is_framed), 0)
        is_kept = token.text in word_set("things", "keeping") and self._token(last).is_framed
        is_kept &= not any(self._token(n).is_sign for n in range(last))
        if not (is_kept or (is_done and by_camera)):
            return None
        follow = tuple(one for one in lexicon_of(None)[("follow",)] if one.value.who == "camera")
        after = (self._token(1),) if by_camera else (self._token(),) * aim
        self._at += camera + 1 if by_camera else 1 + aim
        is_back = by_camera or (self._token().has("pronouns") and not self._starts_group())
        self._at += is_back and not by_camera
        objects = () if is_back or self._token().is_framed else self._groups()
        verb = replace(token, senses=follow)
        return Clause(about="camera", verb=verb, objects=objects, after=after, is_back=is_back)

    def _begin_led(self, clause: Clause) -> Clause | None:
        """Clause of what one does who is taught, helped or watched: "teaches a dog to jump"."""
        last = clause.objects[-1].head if clause.objects and not clause.after else None
        if clause.verb is None or last is None or last is not self._token(-1):
            return None
        is_marked = self._token().text == "to" or self._token().has("infinitive")
        if clause.verb.text not in _list_leading() or not self._token(is_marked).verbs("base"):
            return None
        self._at += is_marked
        return Clause(clause.objects, about="told")

    # Parts of a clause: each step gives the clause with what it has read, or None

    def _read_camera(self, clause: Clause) -> Clause | None:
        """As "the camera", or "zoom in" at the beginning of a clause."""
        ahead = 1 if self._token().has("articles") else 0
        token, after = self._token(ahead), self._token(ahead + 1)
        is_shot = token.has("shot") and after.has("verb")
        if token.text.endswith(("shot", "footage")):  # "the shot slowly zooms in"
            done = self._token(ahead + 1 + after.has("adverb")).verbs("s")
            is_shot |= any(one.value.who == "camera" for one in done)
        is_shot &= bool(ahead) and not token.has("noun")
        moves = {one.value.kind for one in token.verbs("ing") if one.value.who == "camera"}
        is_led = bool(moves & _LED) and self._token(-1).has("shot", "style", "scene")
        if is_led and not (clause.has_subject or clause.verb):
            return replace(clause, about="camera")
        if not clause.has_subject and clause.verb is None and (token.has("camera") or is_shot):
            self._at += ahead + (not is_shot)  # "a dashcam driving" is a shot as well
            return replace(clause, about="camera")
        verbs = {one.value.who for one in self._token().verbs("base")}
        leads = word_set("things", "camera_leads")
        verbs |= {"camera"} if self._at == 0 and self._token().text in leads else set()
        is_command = verbs == {"camera"} or ("camera" in verbs and self._at == 0)
        if clause == Clause() and is_command and not self._token().has("noun"):
            return Clause(about="camera", verb=self._take())
        return None

    def _read_absence(self, clause: Clause) -> Clause | None:
        """As "without cars"; a verb that is denied is not understood."""
        if not self._token().has("negations"):
            return None
        word, absent = self._take(), self._listed(self._group())
        return replace(clause, absent=(*clause.absent, *absent), negation=(*clause.negation, word))

    def _listed(self, first: Group) -> list[Group]:
        """Groups of a list that "and" or "or" ends, all with articles or none."""
        found, known, end = [first], 1, self._at
        while self._token().text in (",", "and", "or") and self._starts_group(1):
            is_last, group = self._take().text != ",", self._group()
            is_subject = self._is_verb(Clause((group,))) and not self._share_verb((*found, group))
            if bool(group.article) != bool(first.article) or is_subject:
                break
            found.append(group)
            known, end = (len(found), self._at) if is_last else (known, end)
        self._at = end
        return found[:known]

    def _read_setting(self, clause: Clause) -> Clause | None:
        """A word of the scene or of the camera, in any place."""
        token = self._token()
        is_verb = clause.verb is None and self._is_verb(clause)
        if not token.has("scene", "shot") or token.has("noun") or is_verb:
            return None
        return replace(clause, after=(*clause.after, self._take()))

    def _read_verb(self, clause: Clause) -> Clause | None:
        if clause.verb is not None or not self._is_verb(clause):
            return None
        verb = self._take()
        moves = any(one.value.who == "camera" for one in verb.all("verb"))
        if moves and self._token().has("articles") and self._token(1).has("camera"):
            self._at += 2  # "flies and tilts its camera down"
            return replace(clause, verb=verb, about="camera")
        is_object = self._starts_group() and not self._is_adverb()
        return replace(clause, verb=verb, objects=self._groups() if is_object else ())

    def _is_adverb(self) -> bool:
        """Whether what follows a verb is no object: "fast", "outside"."""
        token = self._token()
        is_bare = token.is_unknown and not (token.text.endswith("s") or self._starts_group(1))
        return is_bare or token.has("adverb")

    def _is_verb(self, clause: Clause) -> bool:
        """Whether the token is its verb: a bare form needs several subjects, a noun one before."""
        token = self._token()
        forms, before = {one.form for one in token.all("verb")}, self._token(-1).text
        is_open = clause.is_plural or (before == "to" and self._token(-2).has("style"))
        is_named = forms == {"base"} and self._token(-1).has("articles", "field")  # "a big wave"
        is_named &= " " not in before  # "trucks with headlights drive"
        is_named &= not self._token(-1).says("field", "count")  # "the two run"
        if not forms or is_named or (forms == {"base"} and not is_open):  # "starts to spin"
            return False
        if token.has("noun", "effect", "place", "scene", "field"):
            is_plural = bool(clause.subjects) and all(one.is_plural for one in clause.subjects)
            is_new = clause == Clause(about="then") and bool(self._token(1).verbs("base", "s"))
            is_many = forms == {"s"} and is_plural  # "cars and trucks"; "then smoke rises"
            return clause.has_subject and not (is_many or is_new)
        acts = {(one.value.who, one.value.relation) for one in token.verbs("ing")}
        is_act = ("person", "act on") in acts <= {("person", "act on"), ("person", None)}
        is_ego = "ing" in forms and (is_act or not self._token(1).has("noun"))
        return clause.has_subject or is_ego

    def _read_phrase(self, clause: Clause) -> Clause | None:
        token = self._token()
        is_doing = token.text in _IS and self._token(1).text.endswith("ing")
        is_other = token.text in ("and", "or") or token.text in word_set("things", "degrees")
        if not token.has("relation", "small") or is_other or is_doing:
            return None
        is_before = self._token(1).has("pronouns") and not self._starts_group(1)  # no "her car"
        is_back = token.has("relation") and is_before
        is_passive = token.text in ("being", "been") and bool(self._token(1).verbs("ed"))
        is_way = self._token(1).has("adverb") and not self._token(2).has("noun")
        is_lone = not self._starts_group(1) or is_way or is_passive  # "with oncoming cars" is not
        if token.text in _IS and self._token(1).text in _LIT and self._ends_clause(2):
            self._at += 2
            word = replace(self._token(-1), senses=lexicon_of(None)[(_LIT[self._token(-1).text],)])
            return replace(clause, after=(*clause.after, word))  # "the lamp is on"
        if not is_back and is_lone:
            if token.has("adverb") or not (token.has("relation") or is_passive):
                return None
            is_end = token.text in ("behind", "alongside") and self._token(1).text in (
                *",.;!?",
                "and",
            )
            is_back = is_end and clause.has_subject
            word = self._take()
            return replace(clause, after=(*clause.after, Phrase(word, ()) if is_back else word))
        self._at += 1 + is_back
        if token.text in _IS:  # "the ball is red"
            group = self._group()
            is_word = group.head is None or group.head.has("scene")  # "wet"
            words = (*group.modifiers, *group.unknown, *([group.head] if group.head else []))
            said = words if is_word else (Phrase(token, (group,)),)
            return replace(clause, after=(*clause.after, *said))
        phrase = Phrase(token, () if is_back else self._groups(token))
        return replace(clause, after=(*clause.after, phrase))

    def _ends_clause(self, ahead: int) -> bool:
        """Whether nothing more is said of a subject."""
        token = self._token(ahead)
        return token is NO_TOKEN or token.is_sign or token.text == "and"

    def _read_adverb(self, clause: Clause) -> Clause | None:
        token = self._token()
        is_owner = token.has("articles") and not clause.has_subject and clause.verb is None
        if token.has("pronouns") and not (is_owner and self._starts_group()):  # no "her family"
            is_back = clause.is_back or self._token(-1) is clause.verb
            self._take()
            is_subject = not clause.has_subject and clause.verb is None
            return replace(clause, about="same" if is_subject else clause.about, is_back=is_back)
        if not token.has("adverb"):
            return None
        if token.says("adverb", "start_s") and clause == Clause():
            return Clause(about="same", after=(self._take(),))
        return replace(clause, after=(*clause.after, self._take()))

    def _read_group(self, clause: Clause) -> Clause | None:
        is_said = clause.subjects if clause.verb is None else clause.objects or clause.after
        is_rest = self._token().is_unknown and (is_said or (clause.verb and self._is_adverb()))
        is_rest = is_rest or self._is_no_noun(clause)
        if is_rest or not self._starts_group():
            return None
        if clause.verb is None:
            return replace(clause, subjects=(*clause.subjects, self._group()))
        return replace(clause, objects=(*clause.objects, self._group()))

    def _read_rest(self, clause: Clause) -> Clause:
        """A word that is not known right after the subject is taken to be its verb."""
        token = replace(self._take(), senses=()) if self._is_no_noun(clause) else self._take()
        is_verb = clause.subjects and not clause.verb and token.is_unknown
        if not is_verb or token.text.endswith("ly"):
            return replace(clause, after=(*clause.after, token))
        if self._token().text in word_set("things", "particles") and self._starts_group(1):
            self._take()  # "picks up an apple"
        groups = self._groups() if self._starts_group() else ()
        return replace(clause, verb=token, objects=groups)

    def _is_no_noun(self, clause: Clause) -> bool:
        """Whether a bare noun follows a finished group: "are building a wall"."""
        token, before = self._token(), self._token(-1)
        is_noun = token.has("noun", "place", "effect", "pose") and not token.has(*MODIFIERS)
        is_doing = before.text in _IS and token.text.endswith("ing")
        is_after = before.has("noun", "place") or before.is_unknown
        return is_noun and ((clause.has_subject and (is_after or is_doing)) or self._has_object())

    # Noun groups

    def _groups(self, preposition: Token = NO_TOKEN) -> tuple[Group, ...]:
        """Groups with "and" up to a subject, no belongings: "a girl with a hat and a boy jumps"."""
        found = [self._group()]
        if preposition.text == "with" and self._token().text == ",":
            found = self._listed(found[0])
        while self._token().text == "and" and self._starts_group(1) and not self._has_object(1):
            start = self._at
            self._take()
            group = self._group()
            is_another = any(one.text == "another" for one in group.words)
            is_subject = bool(group.article) or group.is_plural or is_another
            small = nouns_with("in hand or on something")
            is_kept = any(can_be_worn(one) or one in small for one in nouns_of([group]))
            is_subject = is_subject and not (is_kept or self._share_verb((*found, group)))
            if (is_subject and self._is_verb(Clause((group,)))) or self._is_like(preposition):
                self._at = start
                break
            found.append(group)
        return tuple(found)
