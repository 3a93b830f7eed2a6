"""The TOML files of `models/data` and `read/data` as tables: traits of nouns, formulas of sizes.

A noun's sizes have names; a formula has numbers, these names, + - * / **, brackets, and functions:

    sizes = { height = 1.2, leg = ".5*height" }
    parts = "limb wood   0 0 {leg}   0 0 {height-.1}   .05"
"""

from __future__ import annotations

import ast
import math
import operator
import re
import tomllib
from collections.abc import Callable, Mapping
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

_OPERATORS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
    ast.Div: operator.truediv, ast.Pow: operator.pow,
}  # fmt: skip
_FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "min": min, "max": max, "sin": math.sin, "cos": math.cos, "asin": math.asin,
}  # fmt: skip
_IN_BRACES = re.compile(r"\{([^{}]*)\}")


def list_data(folder: str) -> list[Traversable]:
    """The TOML files of a folder of `data`, in alphabetical order."""
    found = (files("texvent_scenes.models") / "data" / folder).iterdir()
    return sorted((one for one in found if one.name.endswith(".toml")), key=lambda one: one.name)


@cache
def read_table(name: str, room: str = "models") -> Mapping[str, Any]:
    """The content of `data/<name>.toml` of a room of scenes."""
    file = files(f"texvent_scenes.{room}") / "data" / f"{name}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def frozen(value: Any) -> Any:
    """A copy with lists as tuples, all the way down."""
    if isinstance(value, Mapping):
        return {name: frozen(one) for name, one in value.items()}
    return tuple(map(frozen, value)) if isinstance(value, list) else value


@cache
def _read() -> Mapping[str, Any]:
    """Trait → its nouns, or its nouns with their values."""
    found: dict[str, Any] = {}
    for file in list_data("traits"):
        found |= read_table(f"traits/{file.name.removesuffix('.toml')}")
    return {
        trait: {noun: value for key, value in nouns.items() for noun in key.split(", ")}
        if isinstance(nouns, Mapping) else nouns
        for trait, nouns in found.items()
    }  # fmt: skip


@cache
def nouns_with(trait: str) -> frozenset[str]:
    """Nouns that have a trait.

    Raises:
        KeyError: no file has the trait.
    """
    return frozenset(_read()[trait])


def has_trait(name: str) -> bool:
    """Whether a name is that of a trait."""
    return name in _read()


def trait_value(trait: str, noun: str) -> Any:
    """A noun's value of a trait that is a table; None where it has none."""
    return _read()[trait].get(noun)


def trait_values(trait: str) -> Mapping[str, Any]:
    """Noun → value of a trait that is a table."""
    values: Mapping[str, Any] = _read()[trait]
    return values


def fill_in(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """The table of a noun with numbers in place of its formulas.

    Raises:
        ValueError: a formula cannot be read.
    """
    filled: Mapping[str, Any] = _filled({**table, "sizes": {}, "each": {}}, _sizes_of(table))
    return filled


def fill_in_each(table: Mapping[str, Any]) -> list[str]:
    """The texts of `each`, as often as the sizes of their names say; `n` is their number from 0."""
    sizes = _sizes_of(table)
    return [
        _filled(text, {**sizes, "n": float(n)})
        for name, text in table.get("each", {}).items()
        for n in range(int(sizes[name]))
    ]


def _sizes_of(table: Mapping[str, Any]) -> dict[str, float]:
    said = table.get("sizes", {})
    sizes = dict[str, float]()
    left = list(said)
    while left:
        ready = [name for name in left if _needs(said[name]) <= sizes.keys()]
        if not ready:
            raise ValueError(f"sizes that no number is given for: {', '.join(left)}")
        sizes |= {name: _evaluate(str(said[name]), sizes) for name in ready}
        left = [name for name in left if name not in sizes]
    return sizes


def _needs(value: Any) -> set[str]:
    """Names in a formula."""
    return set(re.findall(r"[A-Za-z_]\w*", str(value))) - _FUNCTIONS.keys()


def _filled(value: Any, sizes: Mapping[str, float]) -> Any:
    """Formulas in a value, and in all within it, as numbers: alone, or in their text."""
    if isinstance(value, Mapping):
        return {name: _filled(one, sizes) for name, one in value.items()}
    if isinstance(value, list):
        return [_filled(one, sizes) for one in value]
    if not isinstance(value, str) or "{" not in value:
        return value
    alone = _IN_BRACES.fullmatch(value)
    if alone:
        return _evaluate(alone[1], sizes)
    return _IN_BRACES.sub(lambda found: f"{_evaluate(found[1], sizes):.15g}", value)


def _evaluate(formula: str, sizes: Mapping[str, float]) -> float:
    def value(node: ast.AST) -> float:
        match node:
            case ast.Constant(value=int() | float() as number):
                return float(number)
            case ast.Name(id=name) if name in sizes:
                return sizes[name]
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                return -value(inner)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
                return _OPERATORS[type(op)](value(left), value(right))
            case ast.Call(func=ast.Name(id=name), args=args) if name in _FUNCTIONS:
                return float(_FUNCTIONS[name](*map(value, args)))
        raise ValueError(f"known: numbers, {', '.join([*sizes, *_FUNCTIONS])}")

    try:
        return float(value(ast.parse(formula.strip(), mode="eval").body))
    except (SyntaxError, TypeError, ValueError, ArithmeticError) as error:
        raise ValueError(f"formula {formula!r}: {error}") from None
