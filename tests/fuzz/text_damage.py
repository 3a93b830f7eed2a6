"""What happens to JSON, TOML, YAML, CSV and plain text: values of the wrong kind, deep nesting."""

import random
import re

from .byte_damage import Damage

TOKEN = re.compile(rb'"[^"\n]*"|[\w.+\-]+')
DEEP = 20_000
HOSTILE = (
    b"",
    b"[]",
    b"{}",
    b"[1, 2, 3]",
    b'{"a": 1}',
    b"{a = 1}",
    b'""',
    b"-1",
    b"0",
    b"1e308",
    b"1e999",
    b"nan",
    b".inf",
    b"1/0",
    b"9223372036854775807",
    b"1e9999999",
    b"9" * 5000,
    b"0x" + b"f" * 5000,
    b'"' + b"x y " * 800 + b'"',
    b'"' + b"x" * 200_000 + b'"',
    b"[" * DEEP + b"]" * DEEP,
    b'{"a":' * 2000 + b"1" + b"}" * 2000,
    b"[" + b"1," * 3000 + b"1]",
    b"2024-01-01",
    b'"a\\nb\\u0000c"',
    b'"\\ud800"',
    b'"../../../etc/passwd"',
    b'"' + b"n" * 300 + b'.mp4"',
    b"!!python/object/apply:os.getcwd []",
    b"\xc0\xff",
    "１２".encode(),
    "µ".encode(),
)


def replace_token(rng: random.Random, content: bytes) -> bytes:
    """Replace one word, number or quoted text by a hostile one."""
    tokens = list(TOKEN.finditer(content))
    if not tokens:
        return rng.choice(HOSTILE)
    token = rng.choice(tokens)
    return content[: token.start()] + rng.choice(HOSTILE) + content[token.end() :]


def replace_some_tokens(rng: random.Random, content: bytes) -> bytes:
    """The same two to five times."""
    for _ in range(rng.randint(2, 5)):
        content = replace_token(rng, content)
    return content


def replace_container(rng: random.Random, content: bytes) -> bytes:
    """Replace what stands between two brackets, or the whole."""
    pairs = [*re.finditer(rb"\[[^\[\]]*\]|\{[^{}]*\}", content)]
    if not pairs:
        return rng.choice(HOSTILE)
    pair = rng.choice(pairs)
    return content[: pair.start()] + rng.choice(HOSTILE) + content[pair.end() :]


def drop_bracket_or_quote(rng: random.Random, content: bytes) -> bytes:
    """Leave one bracket, quote, comma or colon out."""
    marks = [*re.finditer(rb'[\[\]{}",:=]', content)]
    if not marks:
        return content + b'"'
    mark = rng.choice(marks)
    return content[: mark.start()] + content[mark.end() :]


def shuffle_lines(rng: random.Random, content: bytes) -> bytes:
    """Drop, double or swap lines."""
    lines = content.splitlines(keepends=True)
    if not lines:
        return content
    chosen = [line for line in lines for _ in range(rng.choice((0, 1, 1, 1, 2)))]
    if rng.random() < 0.5:
        rng.shuffle(chosen)
    return b"".join(chosen)


def add_hostile_line(rng: random.Random, content: bytes) -> bytes:
    """A hostile value on a line of its own."""
    lines = content.splitlines(keepends=True)
    place = rng.randrange(len(lines) + 1)
    name = rng.choice((b"", b"seed: ", b"seed = ", b"x = ", b"simulator: ", b"- "))
    return b"".join([*lines[:place], name + rng.choice(HOSTILE) + b"\n", *lines[place:]])


def other_encoding(rng: random.Random, content: bytes) -> bytes:
    """The text as UTF-16, with a byte-order mark, or with line ends of others."""
    text = content.decode("utf-8", "replace")
    kind = rng.choice(("utf-16", "utf-8-sig", "utf-32"))
    return text.replace("\n", rng.choice(("\r\n", "\r", "\n"))).encode(kind)


def yaml_bomb(rng: random.Random, content: bytes) -> bytes:
    """Aliases of aliases: small as text and in memory, of 10^9 words when printed."""
    del content
    steps = rng.randint(4, 9)
    lines = [b"a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [
        b"a%d: &a%d [%s]" % (step, step, b", ".join([b"*a%d" % (step - 1)] * 10))
        for step in range(1, steps)
    ]
    name = rng.choice((b"seed", b"simulator", b"sensor", b"fps", b"interpolate", b"intrinsics"))
    return b"\n".join([*lines, name + b": *a%d" % (steps - 1), b""])


def nudge_number(rng: random.Random, content: bytes) -> bytes:
    """Replace one number by one near it, by its opposite, by none or by two."""
    numbers = [*re.finditer(rb"\d+(\.\d+)?", content)]
    if not numbers:
        return content
    number = rng.choice(numbers)
    digits, whole = number[0], int(number[0].split(b".")[0])
    near = (b"%d" % (whole + 1), b"%d" % max(0, whole - 1), b"-" + digits, b"0", b"",
            digits + b"," + digits, digits + b".5", b"%d" % (2 * whole))  # fmt: skip
    return content[: number.start()] + rng.choice(near) + content[number.end() :]


TEXT_DAMAGE: tuple[Damage, ...] = (
    replace_token,
    replace_token,
    replace_some_tokens,
    replace_container,
    drop_bracket_or_quote,
    shuffle_lines,
    add_hostile_line,
    other_encoding,
)
