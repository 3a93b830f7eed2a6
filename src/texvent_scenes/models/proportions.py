"""Proportions of a noun: named sizes, and formulas of them in its table.

    sizes = { height = 1.2, leg = ".5*height" }
    parts = "limb wood   0 0 {leg}   0 0 {height-.1}   .05"

A formula has numbers, names of sizes, + - * / **, brackets, and `_FUNCTIONS`.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping
from typing import Any

_OPERATORS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
    ast.Div: operator.truediv, ast.Pow: operator.pow,
}  # fmt: skip
_FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "min": min, "max": max, "sin": math.sin, "cos": math.cos, "asin": math.asin,
}  # fmt: skip
_IN_BRACES = re.compile(r"\{([^{}]*)\}")


def fill_in(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """The table of a noun with numbers in place of its formulas.

    Raises:
        ValueError: a formula cannot be read.
    """
    said = table.get("sizes", {})
    sizes = dict[str, float]()
    left = list(said)
    while left:
        ready = [name for name in left if _needs(said[name]) <= sizes.keys()]
        if not ready:
            raise ValueError(f"sizes that no number is given for: {', '.join(left)}")
        sizes |= {name: _evaluate(str(said[name]), sizes) for name in ready}
        left = [name for name in left if name not in sizes]
    filled: Mapping[str, Any] = _filled({**table, "sizes": {}}, sizes)
    return filled


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
