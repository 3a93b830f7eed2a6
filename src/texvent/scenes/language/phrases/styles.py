"""Styles of pictures: what is painted, drawn or filmed in a style is shown as it is.

"An oil painting of a boat" and "a boat, oil painting" show a boat; the style is said once, and no
picture frame is put beside the boat.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from texvent.scenes.language.phrases.moods import MOODS
from texvent.scenes.language.vocabulary.film import GREYSCALE
from texvent.scenes.language.words.english import Pos, list_readings
from texvent.scenes.language.words.tokens import Token


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


PLAIN_SHAPES = "things are plain shapes"
OF_TODAY = "things are of today"
_SIGNS = frozenset(".,;:!?()[]\n")
_ENDS = frozenset(".;!?\n")
_MEDIA = tuple(
    tuple(phrase.split())
    for phrase in (
        "oil painting", "watercolor painting", "watercolour painting", "watercolor", "watercolour",
        "acrylic painting", "digital painting", "matte painting", "ink painting", "painting",
        "pencil drawing", "charcoal drawing", "ink drawing", "line drawing", "chalk drawing",
        "cartoon drawing", "drawing", "pencil sketch", "sketch", "illustration", "cartoon",
        "3d render", "3d rendering", "3d animation", "cgi", "cgi animation", "animation",
        "animated painting", "animated film", "rendering", "digital art", "concept art",
        "digital illustration", "comic", "comic strip", "anime", "tableau", "collage", "engraving",
        "woodcut", "mosaic", "line art", "vector art", "fan art", "sculpture in clay",
    )
)  # fmt: skip
"""What a picture is made as, before "of"."""
_LONE = frozenset(
    (*_MEDIA, *(tuple(one.split()) for one in (
        "pixel art", "cyberpunk", "steampunk", "vaporwave", "surrealism", "impressionism", "cubism",
        "pop art", "art nouveau", "low poly", "isometric", "sci fi", "fantasy", "portrait",
        "pen and ink", "ukiyo e", "graffiti art", "voxel art", "minimalism", "expressionism",
        "photorealism", "hyperrealism", "studio portrait", "studio shot", "studio photo")))
) - {("mosaic",), ("sketch",), ("engraving",)}  # fmt: skip
"""Styles that stand alone between commas."""
_GREY = ("black", "and", "white")
_PICTURES = _words(
    "photo photograph picture image photography scene still video footage film shot snapshot frame"
    " clip close photos pictures images"
)
_FILMED = frozenset({"filmed", "captured", "photographed", "pictured", "rendered", "recorded",
                     "presented", "depicted", "displayed", "seen", "shot", "taken"})  # fmt: skip
_HANGING = frozenset(
    {"wall", "gallery", "museum", "easel", "frame", "framed", "shelf", "fireplace",
     "hanging", "hangs", "hung", "desk", "exhibition", "studio"}
)  # fmt: skip
"""Words that tell that a picture is a thing of the scene."""
_PICTURED_ALONE = frozenset({"landscape", "landscapes"})
"""What names a picture with it: "painting of a landscape"."""
_ARTISTS = _words(
    "hokusai monet picasso dali rembrandt vermeer turner klimt matisse warhol magritte cezanne "
    "renoir hopper hiroshige banksy escher kandinsky basquiat botticelli caravaggio munch"
)
_NO_STYLE = frozenset({"of", "on", "at", "with", "from", "by", "is", "are", "in", "the", "and"})
_LONGEST = 4
"""Words of a style: "in a dark comic book style"."""


def set_styles_aside(tokens: Sequence[Token]) -> list[Token]:
    """The tokens with those of each style at the end, joined to one.

    Styles are "in watercolour style", "an oil painting of" and, between commas, "pixel art". Where
    nothing but styles is said, nothing is set aside.
    """
    rest = list(tokens)
    styles: list[Token] = []
    for find in (
        _find_of,
        _find_portrait,
        _find_grey,
        _find_in_style,
        _find_lone,
        _find_artist,
        _find_age,
    ):
        while (found := find(rest)) is not None:
            begin, end, kept = found
            styles.append(_join(rest[begin:end], kept))
            rest[begin:end] = []
            _tidy(rest, begin)
    if not styles or not any(token.text not in _SIGNS for token in rest):
        return list(tokens)
    while rest and rest[-1].text in (",", ";"):
        rest.pop()
    return [*rest, *(one for style in styles for one in (Token(";", ";"), style))]


def _join(tokens: Sequence[Token], reason: str) -> Token:
    words = [token for token in tokens if token.text not in _SIGNS]
    while len(words) > 1 and words[0].text in ("a", "an", "the", "in", "and"):
        words.pop(0)
    while len(words) > 1 and words[-1].text in ("of", "is"):
        words.pop()
    text = " ".join(token.text for token in words)
    return Token(text, " ".join(token.written for token in words), sense=("style", reason))


def _tidy(tokens: list[Token], at: int) -> None:
    """Leave one sign where a phrase between two was taken out."""
    if 0 < at < len(tokens) and tokens[at - 1].text == "," and tokens[at].text in _SIGNS:
        del tokens[at - 1]
    if at == 0 and tokens and tokens[0].text in ",;":
        del tokens[0]


def _find_of(tokens: Sequence[Token]) -> tuple[int, int, str] | None:
    """As in "A small oil painting of", at the start of a sentence."""
    for begin, token in enumerate(tokens):
        if begin and tokens[begin - 1].text not in _ENDS:
            continue
        at = begin + (token.text in ("a", "an", "the"))
        for skipped in range(3):
            if skipped and not _is_adjective(tokens[at + skipped - 1 : at + skipped]):
                break
            end = _medium_end(tokens, at + skipped)
            if end is not None and [one.text for one in tokens[end : end + 1]] == ["is"]:
                end += 1  # "the painting is of"
            if end is None or end >= len(tokens) or tokens[end].text != "of":
                continue
            sentence = _sentence_from(tokens, end)
            is_thing = bool(_PICTURED_ALONE & {one.text for one in tokens[end + 1 : end + 3]})
            if not (sentence & _HANGING or is_thing) and end + 1 < len(tokens):
                is_plain = tokens[end - 1].text == "tableau"
                return begin, end + 1, "" if is_plain else PLAIN_SHAPES
    return None


def _find_portrait(tokens: Sequence[Token]) -> tuple[int, int, str] | None:
    """As in "a detailed portrait of", "close-up portrait of": who is portrayed is shown."""
    for at, (token, after) in enumerate(pairwise(tokens)):
        if token.text != "portrait" or after.text != "of" or _sentence_from(tokens, 0) & _HANGING:
            continue
        begin = at
        while begin and _is_of_portrait(tokens[begin - 1]):
            begin -= 1
        has_article = bool(begin) and tokens[begin - 1].text in ("a", "an", "the")
        is_first = begin == has_article or tokens[begin - has_article - 1].text in _SIGNS
        if is_first or not has_article:
            return begin - has_article, at + 1 + is_first, ""
    return None


def _is_of_portrait(token: Token) -> bool:
    is_framing = token.text.replace("-", "") in ("close", "up", "closeup", "wide", "full")
    return token.text == "and" or (_is_adjective([token]) and not is_framing)


def _medium_end(tokens: Sequence[Token], at: int) -> int | None:
    texts = [token.text for token in tokens[at : at + 3]]
    for phrase in sorted(_MEDIA, key=len, reverse=True):
        if tuple(texts[: len(phrase)]) == phrase:
            return at + len(phrase)
    return None


def _is_adjective(tokens: Sequence[Token]) -> bool:
    if not tokens:
        return False
    readings = list_readings(tokens[0].text)
    return tokens[0].text in MOODS or any(one.pos is Pos.ADJECTIVE for one in readings)


def _sentence_from(tokens: Sequence[Token], at: int) -> set[str]:
    found: set[str] = set()
    for token in tokens[at:]:
        if token.text in _ENDS:
            break
        found.add(token.text)
    return found


def _find_grey(tokens: Sequence[Token]) -> tuple[int, int, str] | None:
    """As in "a black and white photo of", and ", black and white" at the end."""
    for at in range(len(tokens) - 2):
        if tuple(token.text for token in tokens[at : at + 3]) != _GREY:
            continue
        after = tokens[at + 3].text if at + 3 < len(tokens) else "."
        before = tokens[at - 1].text if at else ""
        done = tokens[at - 2].text if before == "in" and at > 1 else ""
        is_paint = done == "done" or (done.endswith("ed") and done not in _FILMED)
        is_alone = after in _SIGNS and before in (",", ";", ".", "in") and not is_paint
        if after in _PICTURES or is_alone:
            begin = at - 1 if before == "in" else at
            begin -= done in _FILMED
            return begin, at + 3, GREYSCALE
    return None


def _find_in_style(tokens: Sequence[Token]) -> tuple[int, int, str] | None:
    """As in "in cyberpunk style", "in the style of a comic", "Van Gogh style" between commas."""
    for at, (token, after) in enumerate(pairwise([*tokens, Token(".", ".")])):
        if token.text not in ("style", "styles", "aesthetic"):
            continue
        begin = _phrase_begin(tokens, at)
        if after.text == "of" and begin is not None:
            end = at + 2
            while end < len(tokens) and tokens[end].text not in _SIGNS:
                end += 1
            return begin, end, PLAIN_SHAPES
        is_closed = after.text in _SIGNS or after.text in ("with", "by", "and")
        if begin is not None and is_closed:
            return begin, at + 1, PLAIN_SHAPES
    return None


def _phrase_begin(tokens: Sequence[Token], at: int) -> int | None:
    """Where the phrase that ends with "style" begins: with "in", or after a sign."""
    for begin in range(at - 1, max(at - _LONGEST - 2, -1), -1):
        text = tokens[begin].text
        if text == "in":
            return begin
        if text in _SIGNS:
            return begin + 1 if at - begin > 1 else None
        if text in _NO_STYLE - {"the"}:
            return None
    return None


def _find_lone(tokens: Sequence[Token]) -> tuple[int, int, str] | None:
    """As in ", oil painting": a style between signs, after what is shown."""
    marks = [at for at, token in enumerate(tokens) if token.text in _SIGNS]
    for begin, end in pairwise([*marks, len(tokens)]):
        words = tuple(token.text for token in tokens[begin + 1 : end])
        if words[:1] in (("a",), ("an",)):
            words = words[1:]
        if words in _LONE and tokens[begin].text in (",", ";", "."):
            is_pose = "portrait" in words or words[0] == "studio"
            return begin + 1, end, "" if is_pose else PLAIN_SHAPES
    return None


def _find_artist(tokens: Sequence[Token]) -> tuple[int, int, str] | None:
    """As in "by Hokusai"."""
    for at, (token, name) in enumerate(pairwise(tokens)):
        if token.text == "by" and name.text in _ARTISTS and name.written[0].isupper():
            return at, at + 2, PLAIN_SHAPES
    return None


_ORDINALS = frozenset({"st", "nd", "rd", "th"})


def _find_age(tokens: Sequence[Token]) -> tuple[int, int, str] | None:
    """As in "a 19th century house", "1940s", "a 24 year old woman": no count of them."""
    for at, token in enumerate(tokens):
        if not token.is_number:
            continue
        texts = [one.text for one in tokens[at + 1 : at + 3]]
        if texts[:1] and texts[0] in _ORDINALS and texts[1:2] == ["century"]:
            return at, at + 3, OF_TODAY
        if texts[:1] == ["s"] and len(token.text) in (2, 4):
            return at, at + 2, OF_TODAY
        if texts[:1] in (["year"], ["years"]) and texts[1:2] == ["old"]:
            return at, at + 3, ""
    return None
