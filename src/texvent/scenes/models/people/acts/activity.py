"""What an activity of people is; loads nothing but the standard library."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Activity:
    """One activity; its name is an `ObjectMotion.kind`."""

    words: tuple[str, ...]
    """Verb phrases in their base form."""
    near: tuple[str, ...] = ()
    """Phrases of what it shows only nearly, which is reported: "play football" of a kick."""
    travels: bool = False
    """Whether the body goes from place to place."""
    is_sideways: bool = False
    """Whether it is best seen from the side."""
    is_still: bool = False
    """Whether the body keeps still apart from breathing."""
    is_close: bool = False
    """Whether it is done at the head, so that the image may end at the waist."""
    named: tuple[str, ...] = ()
    """Phrases that name it and do not begin with a verb: "peace sign"."""


def sign(*named: str, words: tuple[str, ...] = ()) -> Activity:
    """A sign that a hand shows."""
    return Activity(words, named=named)


def seen_from_side(*words: str, near: tuple[str, ...] = ()) -> Activity:
    """An activity that is best seen from the side."""
    return Activity(words, near, is_sideways=True)


def at_head(*words: str, near: tuple[str, ...] = ()) -> Activity:
    """An activity of hands at the own head, or of the head."""
    return Activity(words, near, is_close=True)


def sideways_at_head(*words: str) -> Activity:
    """An activity at the own head that is best seen from the side."""
    return Activity(words, is_sideways=True, is_close=True)


def done_to(verbs: str, things: str) -> tuple[str, ...]:
    """Every verb with every thing: "put on|apply", "lipstick|mascara"; the verbs may be phrases.

    Example:
        >>> done_to("comb|brush", "hair")
        ('comb hair', 'brush hair')
    """
    return tuple(f"{verb} {thing}" for verb in verbs.split("|") for thing in things.split("|"))
