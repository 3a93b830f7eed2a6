"""Ways on a ground that words tell of: along a pavement, and of what bounces."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.read.draft.abilities import Indices
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import Token

OWN_BALL = frozenset({"bounce", "dribble", "juggle"})
"""Activities with a ball that stays by who does them: it meets no wall."""
ALONG = ("along", "down", "up")
"""Prepositions of ways that lead on."""


def claim_pavement(
    draft: SceneDraft, token: Token, heads: Sequence[Token], subjects: Indices
) -> None:
    """Leave it to the staged scene whether who is on a pavement keeps to it."""
    on_foot = [one for one in subjects if draft.keeps_to_ground(one)]
    for head in heads if token.text in ("on", *ALONG) else ():
        if head.text in word_set("things", "pavements"):
            draft.claim(head, "pavement", "", on_foot)


def lead_bounces(draft: SceneDraft, token: Token, subjects: Indices) -> None:
    """Have what bounces go on as it does so, as "across a table"; who bounces a ball stays."""
    is_way = token.text in ("across", "over", *ALONG)
    for one in subjects if is_way and draft.does(subjects) <= OWN_BALL else ():
        draft.claim(token, "way", "", [one] if draft.does([one]) else [])
        for motion in draft.things[one]["motions"] if token.text != "over" else ():
            motion |= {} if draft.walks(one) else {"direction": motion.get("direction", "across")}
