"""Reads what a prompt says about the camera."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import CameraMove, Shot
from texvent.scenes.language.grammar.syntax import Clause, NounGroup, PrepPhrase
from texvent.scenes.language.meaning import camera_ways as ways
from texvent.scenes.language.meaning.adjectives import Attributes
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.vocabulary.film import OF_CAMERA, TRAVEL_MEANS
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word

_PLAIN_MOVE = frozenset({"move", "slide", "hover", "rise", "sink", "fall"})
_OF_CAMERA = {verb: move for move, verbs in OF_CAMERA.items() for verb in verbs}
_TURNED = ("pan", "tilt")
"""Moves of a camera that stays where it is, along whatever it looks."""
_OUT_OF_WINDOW = CameraMove("truck", "right", 2.0)
_HIGH = ("aerial", "top")
_RISE_PACE = 1.6
"""Pace of a crane that rises from the ground to a view from above."""
_OWN_TRAVEL = CameraMove("travel", "forward")
"""What "first person" alone means."""


class CameraReader:
    """Collects camera moves, view and framing."""

    def __init__(self, draft: Draft, *, is_carried: bool = False, means: str | None = None) -> None:
        """Start a shot.

        Args:
            draft: what is known of the scene.
            is_carried: whether the camera rides in or on something that the prompt names.
            means: how that goes, or "window" where it looks out sideways.
        """
        self._draft = draft
        self._own = _OUT_OF_WINDOW if means == "window" else replace(_OWN_TRAVEL, means=means)
        """Move of what carries it."""
        self._moves: list[CameraMove] = [self._own] if is_carried else []
        self._view: str | None = "aerial" if means == "fly" else None
        self._framing: str | None = None
        self._target: int | None = None
        self._station: int | None = None
        """What the camera stands beside."""
        self._claimed: Word | None = None
        """The verb of its last move."""
        self._is_placed = False
        """Whether its moves so far say only where it is."""
        self._phase = 0
        self._sentence = 0

    @property
    def has_moves(self) -> bool:
        """Whether any move was read."""
        return bool(self._moves)

    @property
    def is_first_person(self) -> bool:
        """Whether the camera is the eyes of a person."""
        return self._view == "first person"

    def read_word(self, word: Word) -> bool:
        """Take a view, a framing or a move that stands alone: "close-up", "handheld"."""
        if word.role is Role.VIEW:
            self._view = word.meaning.value
            if self._view == "back" and self._moves and self._moves[-1].kind == "follow":
                self._moves[-1] = replace(self._moves[-1], direction="behind")
                self._view = None
            if self._view == "first person" and not self._moves:
                self._moves.append(CameraMove("travel", "forward"))
        elif word.role is Role.FRAMING:
            self._framing = word.meaning.value
        elif word.role is Role.CAMERA_MOVE:
            kind, direction = word.meaning.value
            means = TRAVEL_MEANS.get(word.lemma) if kind == "travel" else None
            self._add(CameraMove(kind, direction, means=means))
        else:
            return False
        word.is_used = True
        return True

    def read_phrases(self, adverbs: Sequence[Word]) -> None:
        """Views, framings and moves among the adverbs: "a slow tracking shot"."""
        before: Word | None = None
        for word in adverbs:
            if word.role in (Role.VIEW, Role.FRAMING, Role.CAMERA_MOVE):
                self.read_word(word)
                if word.role is Role.CAMERA_MOVE and before is not None:
                    self.pace(before)
            elif before is not None and before.role is Role.CAMERA_MOVE:
                self.pace(word)
            before = word

    def pace(self, word: Word) -> None:
        """As in "a slow tracking shot": how fast the last move is."""
        if word.role is Role.PACE and self._moves and not word.is_used:
            last = self._moves[-1]
            self._moves[-1] = replace(last, pace=last.pace * word.meaning.value)
            self._claim(word)

    def read_attributes(self, attributes: Attributes) -> None:
        """As in "A slow pan", "a static shot"."""
        for word in attributes.words:
            self.read_word(word)

    def read_clause(
        self,
        clause: Clause,
        objects: Sequence[Referent],
        phrases: Sequence[tuple[PrepPhrase, Referent]],
    ) -> None:
        """A clause whose subject is the camera, the viewer or a shot."""
        is_later = clause.order == "after" or clause.sentence > self._sentence
        if is_later and self._moves and clause.verb is not None and not self._is_placed:
            self._phase += 1
        self._sentence = clause.sentence
        if clause.verb is not None:
            self._read_verb(clause, clause.verb, phrases)
        for group in clause.complements:
            for word in group.words:
                self.read_word(word)
        is_lost = clause.verb is not None and self._is_lost(clause.verb)
        for word in clause.adverbs:
            if not (is_lost and word.role in (Role.DIRECTION, Role.PACE)):
                self._read_adverb(word)
        for phrase, referent in phrases:
            self._read_phrase(phrase, referent)
        for referent in objects:
            self.aim(referent)

    @staticmethod
    def _is_lost(verb: Word) -> bool:
        """As in "dodging the trunks left and right": no camera goes left and right for that."""
        return verb.role in (Role.UNKNOWN, Role.SIMILAR, Role.ACTIVITY) and not verb.is_used

    def _read_verb(
        self, clause: Clause, word: Word, phrases: Sequence[tuple[PrepPhrase, Referent]]
    ) -> None:
        if clause.negation is not None:
            self._add(CameraMove("static"))
            word.is_used = clause.negation.is_used = True
            return
        if word.lemma in ways.LOOKING and self._moves:
            word.meaning = replace(word.meaning, role=Role.FUNCTION)
            word.is_used = True  # the camera looks at what is named
            return
        means = TRAVEL_MEANS.get(word.lemma)
        move = word.read_as(Role.CAMERA_MOVE)
        own = _OF_CAMERA.get(word.lemma) if move is None and means is None else None
        if own is not None:
            is_carried = self._moves[:1] == [self._own]
            goes_on = own == ("dolly", "in") and (is_carried or self._goes_through(phrases))
            value = ("travel", "forward") if goes_on else own
            word.meaning = Meaning(Role.CAMERA_MOVE, word.pos, value, word.meaning.form)
            self._add(CameraMove(*value))
            self._is_placed = word.lemma in ways.PLACED
            word.is_used = True
            return
        if means is not None:
            self._travel(word, means, clause, phrases)
        elif move is not None and (
            move.value[0] in _TURNED or word.lemma == "truck" or not self._goes_through(phrases)
        ):
            kind, direction = move.value
            self._add(CameraMove(kind, direction))
            self._claimed = word
            word.is_used = True
        elif word.role is Role.VERB and isinstance(word.meaning.value, Verb):
            # No camera slips a bottle into a jacket.
            is_done_to = bool(clause.objects) and word.lemma in ways.BY_HAND
            if not is_done_to:
                self._read_motion(word, word.meaning.value, phrases)

    def _goes_through(self, phrases: Sequence[tuple[PrepPhrase, Referent]]) -> bool:
        return any(
            phrase.preposition.text in ("through", "along") and one.kind in ("place", "things")
            for phrase, one in phrases
        )

    def _travel(
        self,
        word: Word,
        means: str,
        clause: Clause,
        phrases: Sequence[tuple[PrepPhrase, Referent]],
    ) -> None:
        follows = any(p.preposition.text in ("behind", "alongside", "beside") and r.is_things
                      for p, r in phrases)  # fmt: skip
        word.is_used = True
        if follows:
            self._add(CameraMove("follow"))
            self._claim(word)
            return
        is_over = any(phrase.preposition.text in ("over", "above") for phrase, _ in phrases)
        if word.lemma == "glide" and not is_over:
            means = "walk"
        if means == "fly" and self._view is None:
            self._view = "aerial"
        self._add(CameraMove("travel", "forward", means=means))
        self._claim(word)
        del clause

    def _claim(self, word: Word) -> None:
        """This word asks for the last move."""
        last, self._claimed = self._moves[-1], word
        value = (last.kind, last.direction)
        word.meaning = Meaning(Role.CAMERA_MOVE, word.pos, value, word.meaning.form)
        word.is_used = True

    def _read_motion(
        self, word: Word, verb: Verb, phrases: Sequence[tuple[PrepPhrase, Referent]]
    ) -> None:
        if verb.relation == "follow":
            self._add(CameraMove("follow", pace=verb.pace))
        elif verb.kind == "turn":
            self._add(CameraMove("pan"))
        elif verb.kind in ("rise", "sink", "fall"):
            self._add(CameraMove("pedestal", "up" if verb.kind == "rise" else "down"))
        elif verb.kind == "stand":
            self._add(CameraMove("static"))
        elif verb.kind == "orbit":
            self._add(CameraMove("orbit"))
        elif verb.kind in ("spin", "roll"):
            self._add(CameraMove("roll"))
        elif verb.kind in _PLAIN_MOVE or self._goes_through(phrases):
            is_towards = verb.direction == "towards"
            self._add(CameraMove("dolly" if is_towards else "travel",
                                 "in" if is_towards else "forward", verb.pace))  # fmt: skip
        else:
            return
        if verb.end_pace is None:  # no camera brakes
            self._claim(word)

    def _add(self, move: CameraMove) -> None:
        move = replace(move, phase=self._phase)
        if self._moves and self._moves[-1].kind == "static" and self._phase == 0:
            self._moves.pop()
        if self._moves and self._moves[-1] == move:
            return
        if self._moves and move.kind == "travel" and self._moves[-1] == self._own:
            self._moves.pop()
        self._moves.append(move)

    def _read_adverb(self, word: Word) -> None:
        if self.read_word(word):
            return
        if word.role is Role.STILL:
            self._add(CameraMove("static"))
            self._claim(word)
        elif not self._moves:
            return
        elif word.role is Role.DIRECTION:
            self._direct(word)
        elif word.role is Role.PACE:
            self.pace(word)
        elif word.text in ("in", "out") and self._moves[-1].kind in ("zoom", "dolly"):
            self._moves[-1] = replace(self._moves[-1], direction=word.text)
            self._claim(word)
        elif word.text in ways.WITH and self._draft.subjects:
            # As in "the camera moves alongside": of what was said before.
            self._go_with(word, Referent("things", NounGroup(), list(self._draft.subjects)))
            if self._moves[-1].kind == "follow":
                self._claim(word)

    def _direct(self, word: Word) -> None:
        last, said = self._moves[-1], word.meaning.value
        if said in ways.BOTH_WAYS:
            self._go_and_return(word, *ways.BOTH_WAYS[said])
            return
        kind, direction = last.kind, said
        if kind == "roll" and said in ("left", "right") and self._is_rotated():
            kind, direction = "pan", said
        elif kind == "travel" and said in ways.ASIDE:
            if last.means is None:
                kind, direction = ways.TRUCK[said]
        elif kind in ("zoom", "dolly"):
            direction = ways.IN_OUT.get(said, said)
        elif kind == "truck":
            kind, direction = ways.TRUCK.get(said, (kind, said))
        elif kind in ("pan", "tilt", "orbit", "pedestal", "crane", "roll", "travel"):
            direction = said
        else:
            return
        self._moves[-1] = replace(last, kind=kind, direction=direction)
        self._claim(word)

    def _is_rotated(self) -> bool:
        """As in "rotates left", which is no roll."""
        return self._claimed is not None and self._claimed.lemma.startswith("rotate")

    def _go_and_return(self, word: Word, there: str, back: str) -> None:
        """As in "tilts up and down", "moves from side to side": one way, then the other."""
        if self._moves[-1].kind == "handheld":
            self._claim(word)
            return
        last = self._moves.pop()
        is_ahead = last.kind == "travel" and last.means is None
        kind = ("pedestal" if there == "up" else "truck") if is_ahead else last.kind
        for way in (there, back):
            self._moves.append(replace(last, kind=kind, direction=way, phase=self._phase))
            self._phase += way == there
        self._claim(word)

    def _read_phrase(self, phrase: PrepPhrase, referent: Referent) -> None:
        word = phrase.preposition
        if self._moves:
            self._go_upright(word, referent)
        if referent.is_things:
            if self.stand_by(word, referent) or not self._moves:
                return
            self._go_with(word, referent)
            last = self._moves[-1]
            if word.text in ways.ALONG and last.kind == "dolly" and last.direction is None:
                self._moves[-1] = replace(last, kind="truck")
            if last.kind == "follow" and word.text in ways.SIDES:
                self._moves[-1] = replace(last, direction=ways.SIDES[word.text])
            elif word.text == "around" and last.kind in ("travel", "truck", "roll"):
                self._moves[-1] = replace(last, kind="orbit", direction=None, means=None)
            elif word.text in ("towards", "toward", "to") and last.kind == "travel":
                self._moves[-1] = replace(last, kind="dolly", direction="in", means=None)
            elif last.kind == "static":
                word.is_lost = True
                return
            word.is_used = True
            self.aim(referent)
        elif referent.kind == "place" and word.text in ways.TRAVEL_PREPOSITIONS | {"at", "on"}:
            word.is_used = True

    def _go_with(self, word: Word, referent: Referent) -> None:
        """As in "moves alongside her", "pans after the ball": it follows what goes."""
        last = self._moves[-1]
        noun = self._draft.noun(referent.things[0])
        is_led = last.kind == "pan" and last.direction is not None
        is_free = last.kind in ways.FREE and last.means is None and not is_led
        if word.text in ways.WITH and is_free and noun.speed_m_s:
            self._moves[-1] = replace(last, kind="follow", direction=ways.WITH[word.text])
            if self._claimed is not None:
                self._claim(self._claimed)

    def _go_upright(self, word: Word, referent: Referent) -> None:
        """As in "tilts down a tree", "tilts toward the street": down."""
        last = self._moves[-1]
        is_goal = word.text in ("toward", "towards", "to") and referent.kind in ("place", "sky")
        if word.text in ("up", "down") and last.kind in ways.UPRIGHT:
            self._moves[-1] = replace(last, direction=word.text)
        elif is_goal and last.kind == "tilt" and last.direction is None:
            self._moves[-1] = replace(last, direction="up" if referent.kind == "sky" else "down")

    def _rise_to_view(self) -> None:
        """As in "rises to a high aerial view": it begins low."""
        goes = [move for move in self._moves if move.kind in ("pedestal", "crane")]
        if self._view not in _HIGH or not goes or goes[0].direction != "up":
            return
        self._moves = [
            replace(move, kind="crane", pace=_RISE_PACE) if move is goes[0] else move
            for move in self._moves
        ]
        self._view = "rising"

    def stand_by(self, word: Word, referent: Referent) -> bool:
        """As in "the camera is placed behind the catcher": whether it is read so."""
        is_static = all(move.kind == "static" for move in self._moves)
        view = ways.STATIONS.get(word.text)
        if not is_static or view is None or not referent.things:
            return False
        noun = self._draft.noun(referent.things[0])
        if view not in ("top", "aerial") and (noun.speed_m_s == 0.0 or noun.habitat == "fixed"):
            return False  # what has no front has no back
        self._station, self._view = referent.things[0], view
        word.meaning, word.is_used = Meaning(Role.VIEW, Pos.ADJUNCT, self._view), True
        return True

    def aim(self, referent: Referent) -> None:
        """Point the camera at an object that its clause names."""
        can_aim = bool(self._moves) and self._moves[-1].kind in ways.AIMED and self._target is None
        if can_aim and referent.things:
            self._target = referent.things[0]

    def build(self) -> Shot:
        """The shot as understood."""
        target = self._station if self._target is None else self._target
        self._rise_to_view()
        return Shot(tuple(self._moves), self._view, self._framing, target)
