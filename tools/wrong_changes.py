"""Wrong changes of one place each, as a tired person makes them, drawn at random from the sources.

Left out are docstrings, annotations, decorators, imports and the words of errors and warnings.
"""

from __future__ import annotations

import ast
import fnmatch
import math
import random
import re
from bisect import bisect
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

SOURCES = Path("src", "texvent")
SCENES, LAB = "texvent_scenes", "texvent_lab"
PACKAGES = {SCENES: (SOURCES.parent, "tests/scenes"), LAB: (Path("lab", "src"), "lab/tests")}
"""The packages beside it: the folder that holds each, and its tests."""
WIDE = {
    "": ("tests/bounds/test_bounds.py", "tests/fuzz/test_fuzz.py"),
    SCENES: tuple(
        f"tests/scenes/{one}.py"
        for one in ("golden/test_golden_scenes", "read/test_read", "checks/test_words")
    ),
    **dict.fromkeys(("cli", "run", "settings"), ("tests/options/test_printed.py",)),
}
"""Files of tests of all rows of tables: of every file, and of those of a package or a room."""
MOST_TESTS = 16
"""Files of tests that are near a change: the whole suite judges what these let pass."""
MOST_ALIKE = 8
"""Those of them that are there for their words alone."""
WORD = re.compile("[A-Za-z]{4,}")
ENTRY = re.compile(r"texvent\w*(?:\.\w+)+:\w+")
"""A part that a registry loads by name."""
OPERATOR = re.compile(r"\*\*|//|<<|>>|[<>=!]=|[-+*/%&|<>]|\b(?:is not|not in|is|in|and|or)\b")


def _both_ways(*pairs: tuple[str, str]) -> dict[str, str]:
    return {one: other for pair in pairs for one, other in (pair, pair[::-1])}


EXCHANGED = {"//": "/", "%": "//"} | _both_ways(
    *[("+", "-"), ("*", "/"), ("<<", ">>"), ("&", "|"), ("<", "<="), (">", ">="), ("==", "!=")],
    *[("is", "is not"), ("in", "not in"), ("and", "or")],
)
PARTNERS = {"rint": "floor", "round": "int"} | _both_ways(
    *[("min", "max"), ("minimum", "maximum"), ("argmin", "argmax"), ("floor", "ceil")],
    *[("any", "all"), ("sin", "cos"), ("x", "y"), ("width", "height")],
)
EITHER_WAY = ("min", "max", "minimum", "maximum", "hypot")
"""Functions whose arguments may change places."""
UNTOUCHED = (ast.Raise, ast.JoinedStr, ast.Import, ast.ImportFrom)
WORDS_ALONE = re.compile(r".*(Error|Warning)|warn|debug|info|cast|TypeVar|TYPE_CHECKING|__all__")
"""Names of whatever only says something, or is for type checkers."""


class Change(NamedTuple):
    """A wrong change: bytes `start` to `end` of a file become `new`."""

    file: str
    """As `source_path` takes it."""
    line: int
    kind: str
    start: int
    end: int
    new: str

    def applied(self, text: str) -> str:
        """The text of the file with the change."""
        data = text.encode()
        return (data[: self.start] + self.new.encode() + data[self.end :]).decode()


def source_path(file: str) -> Path:
    """Path of a file that is named below `SOURCES`, or below the folder of another package."""
    return PACKAGES.get(Path(file).parts[0], (SOURCES,))[0] / file


def file_of(path: Path) -> str:
    """The name that `source_path` takes."""
    folders = (SOURCES, *(folder for folder, _ in PACKAGES.values()))
    return path.relative_to(next(one for one in folders if path.is_relative_to(one))).as_posix()


Found = tuple[str, int, int, str]
"""Kind, start, end and new text of a change."""


class _Source:
    """Bytes of a file, and the places of its nodes in them."""

    def __init__(self, text: str) -> None:
        self.data = text.encode()
        self.tree = ast.parse(text)
        self.starts = [0]
        for line in self.data.split(b"\n"):
            self.starts.append(self.starts[-1] + len(line) + 1)

    def start(self, node: ast.expr | ast.stmt | ast.keyword) -> int:
        return self.starts[node.lineno - 1] + node.col_offset

    def end(self, node: ast.expr | ast.stmt | ast.keyword) -> int:
        line, column = node.end_lineno or 1, node.end_col_offset or 0
        return self.starts[line - 1] + column

    def text(self, node: ast.expr | ast.stmt) -> str:
        return self.data[self.start(node) : self.end(node)].decode()

    def replace(self, kind: str, node: ast.expr | ast.stmt, new: str) -> Found:
        return kind, self.start(node), self.end(node), new


def _relevant(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes whose change can be met by who runs the program."""
    named = getattr(node, "func", None) or getattr(node, "test", None) or node
    named = node.targets[0] if isinstance(node, ast.Assign) else named
    name = getattr(named, "id", getattr(named, "attr", ""))
    is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    is_strict = isinstance(node, ast.keyword) and node.arg == "strict"  # sizes of the code itself
    if isinstance(node, UNTOUCHED) or is_text or is_strict or WORDS_ALONE.fullmatch(name):
        return
    yield node
    for field, value in ast.iter_fields(node):
        if field not in ("annotation", "returns", "decorator_list"):
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from _relevant(child)


def _operators(source: _Source, node: ast.AST) -> Iterator[Found]:
    operands: Sequence[ast.expr] = ()
    match node:
        case ast.BinOp():
            operands = [node.left, node.right]
        case ast.Compare():
            operands = [node.left, *node.comparators]
        case ast.BoolOp():
            operands = node.values
        case ast.AugAssign():
            operands = [node.target, node.value]
    for left, right in pairwise(operands):
        gap = source.data[source.end(left) : source.start(right)].decode()
        found = OPERATOR.search(gap)
        if found and found[0] in EXCHANGED:
            at = source.end(left) + len(gap[: found.start()].encode())
            yield "operator", at, at + len(found[0]), EXCHANGED[found[0]]


def _constants(source: _Source, node: ast.AST) -> Iterator[Found]:
    defaults: Sequence[ast.AST | None] = []
    match node:
        case ast.Constant(value=bool()):
            yield source.replace("constant", node, str(not node.value))
        case ast.Constant(value=int() as value):
            for new in {0: [1], 1: [0, 2]}.get(value, [value - 1, value + 1, 2 * value]):
                yield source.replace("constant", node, str(new))
        case ast.Constant(value=float() as value) if math.isfinite(value):
            yield source.replace("constant", node, repr(2 * value or 1.0))
        case ast.arguments():
            defaults = [*node.defaults, *node.kw_defaults]
        case ast.ClassDef():
            defaults = [one.value for one in node.body if isinstance(one, ast.AnnAssign)]
    for default in defaults:
        if isinstance(default, ast.Constant):
            yield from (("default", *found[1:]) for found in _constants(source, default))


def _calls(source: _Source, node: ast.AST) -> Iterator[Found]:
    if not isinstance(node, ast.Call) or any(isinstance(one, ast.Starred) for one in node.args):
        return
    name = getattr(node.func, "id", getattr(node.func, "attr", ""))
    for left, right in pairwise(() if name in EITHER_WAY else node.args):
        gap = source.data[source.end(left) : source.start(right)].decode()
        if source.text(left) != source.text(right):
            new = source.text(right) + gap + source.text(left)
            yield "arguments", source.start(left), source.end(right), new
    before: ast.expr | ast.keyword | None = node.args[-1] if node.args else None
    for one in node.keywords:
        if one.arg not in (None, "strict"):
            start = source.end(before) if before else source.start(one)
            end = source.end(one) + (not before and source.data[source.end(one)] == ord(","))
            yield "keyword", start, end, ""
        before = one


def _names(source: _Source, node: ast.AST) -> Iterator[Found]:
    if isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load):
        name = node.id if isinstance(node, ast.Name) else node.attr
        if name in PARTNERS:
            yield "name", source.end(node) - len(name), source.end(node), PARTNERS[name]


def _statements(source: _Source, node: ast.AST) -> Iterator[Found]:
    match node:
        case (
            ast.Continue()
            | ast.AugAssign()
            | ast.Expr(value=ast.Call())
            | ast.Assign(targets=[ast.Attribute() | ast.Subscript(), *_])
        ):
            yield source.replace("deletion", node, "pass")
        case ast.If() | ast.While() | ast.IfExp():
            yield source.replace("condition", node.test, f"(not ({source.text(node.test)}))")
        case ast.comprehension(ifs=tests):
            for test in tests:
                yield source.replace("condition", test, f"(not ({source.text(test)}))")
        case ast.UnaryOp(op=ast.Not() | ast.USub()):
            yield source.replace("negation", node, f"({source.text(node.operand)})")


def _indexes(source: _Source, node: ast.AST) -> Iterator[Found]:
    match node:
        case ast.Slice():
            for bound in (node.lower, node.upper):
                if bound is not None and not isinstance(bound, ast.Constant):
                    yield source.replace("index", bound, f"{source.text(bound)} + 1")
        case ast.Subscript(slice=ast.Name(id=name) | ast.BinOp(left=ast.Name(id=name))):
            if len(name) < 3 or name in ("index", "row", "column", "number", "pixel"):
                yield source.replace("index", node.slice, f"{source.text(node.slice)} + 1")


def _returns(source: _Source, node: ast.AST) -> Iterator[Found]:
    if not isinstance(node, ast.FunctionDef) or node.returns is None:
        return
    kept = ast.unparse(node.returns)
    for one in ast.walk(node):
        if not isinstance(one, ast.Return) or one.value is None:
            continue
        text = source.text(one.value)
        if isinstance(one.value, ast.Tuple) and len(one.value.elts) > 1:
            first, second, *rest = (source.text(element) for element in one.value.elts)
            yield source.replace("return", one.value, f"({', '.join((second, first, *rest))})")
        elif "None" in kept and text != "None":
            yield source.replace("return", one.value, "None")
        elif kept in ("bool", "int", "float"):
            new = f"not ({text})" if kept == "bool" else f"({text}) + 1"
            yield source.replace("return", one.value, new)


RULES = (_operators, _constants, _calls, _names, _statements, _indexes, _returns)


def changes_of(file: str, text: str) -> list[Change]:
    """Every change that can be made in a file; some may not compile, or change nothing."""
    source = _Source(text)
    found = {
        (one[1], one[2], one[3]): Change(file, bisect(source.starts, one[1]), *one)
        for node in _relevant(source.tree)
        for rule in RULES
        for one in rule(source, node)
    }
    return list(found.values())


def is_wrong(change: Change, text: str) -> bool:
    """Whether the file compiles with the change, to something else."""
    new = change.applied(text)
    try:
        compile(new, change.file, "exec", dont_inherit=True)
    except (SyntaxError, ValueError):
        return False
    return ast.dump(ast.parse(new)) != ast.dump(ast.parse(text))


def _sources(root: Path) -> list[Path]:
    folders = dict.fromkeys(folder for folder, _ in PACKAGES.values())
    return [path for folder in folders for path in sorted((root / folder).rglob("*.py"))]


def draw(
    count: int,
    seed: int,
    root: Path,
    rooms: Sequence[str] = (),
    lines: Mapping[str, Container[int]] | None = None,
) -> list[Change]:
    """Changes in random order; every folder of the sources has its share, by lines of code.

    Args:
        count: how many changes, at most.
        seed: seed of the draw.
        root: the repository.
        rooms: folders of the sources; none: all.
        lines: lines that may be changed, by the names of files; None: all.
    """
    rng = random.Random(seed)
    found, weights = {}, {}
    for path in _sources(root):
        file = file_of(path.relative_to(root))
        if rooms and file.partition("/")[0] not in rooms:
            continue
        allowed = None if lines is None else lines.get(file, ())
        changes = changes_of(file, path.read_text("utf-8"))
        changes = [one for one in changes if allowed is None or one.line in allowed]
        if changes:
            found[file] = changes
            weights[file] = len({one.line for one in changes})
    drawn: list[Change] = []
    for file in _spread(rng, weights, count):
        text = (root / source_path(file)).read_text("utf-8")
        kinds = sorted({one.kind for one in found[file]})
        for _ in range(100):
            kind = rng.choice(kinds)
            change = rng.choice([one for one in found[file] if one.kind == kind])
            if change not in drawn and is_wrong(change, text):
                drawn.append(change)
                break
    rng.shuffle(drawn)
    return drawn


def _spread(rng: random.Random, weights: Mapping[str, int], count: int) -> Iterable[str]:
    """Files at equal distances along all lines, in their order."""
    step = sum(weights.values()) / count
    at, passed = rng.random() * step, 0.0
    for file, weight in weights.items():
        passed += weight
        while at < passed:
            yield file
            at += step


@cache
def _imports(root: Path) -> dict[Path, frozenset[str]]:
    """The modules, and perhaps names in them, that each file imports, by paths below `root`."""
    found = {}
    tests = (path for folder in ("tests", "lab/tests") for path in (root / folder).rglob("*.py"))
    modules = [_module_of(Path(file_of(path.relative_to(root)))) for path in _sources(root)]
    for path in (*_sources(root), *tests):
        names = set()
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            match node:
                case ast.ImportFrom(module=str(module)):
                    names |= {module, *(f"{module}.{one.name}" for one in node.names)}
                case ast.Import():
                    names |= {one.name for one in node.names}
                case ast.Constant(value=str(text)) if ENTRY.fullmatch(text):
                    names.add(text.partition(":")[0])
                case ast.JoinedStr(values=[ast.Constant(value=str(first)), *_]):
                    if first.startswith(f"{SOURCES.name}.") and first.count(".") > 1:
                        names |= {*fnmatch.filter(modules, _pattern(node))}
        found[path.relative_to(root)] = frozenset(names)
    return found


def _pattern(text: ast.JoinedStr) -> str:
    parts = (one.value if isinstance(one, ast.Constant) else "*" for one in text.values)
    return "".join(map(str, parts))


def _module_of(file: Path) -> str:
    """The module of a file that is named as `source_path` takes it."""
    inside = file if file.parts[0] in PACKAGES else Path(SOURCES.name, file)
    return ".".join(inside.with_suffix("").parts).removesuffix(".__init__")


def _mirrors(file: Path, root: Path) -> list[Path]:
    """Files of tests with the name of a source file, then all of the nearest folder."""
    first, *inner = file.parent.parts or ("",)
    folder = root.joinpath(PACKAGES[first][1] if first in PACKAGES else f"tests/{first}", *inner)
    while not folder.is_dir():
        folder = folder.parent
    found = folder.rglob("test_*.py") if folder.name != "tests" else folder.glob("test_*")
    tests = sorted(found, key=lambda one: (len(one.parts), one))
    return [one for one in tests if one.name.startswith(f"test_{file.stem}")] + tests


def _is_source(path: Path) -> bool:
    return any(path.is_relative_to(folder) for folder, _ in PACKAGES.values())


def _importing(modules: Iterable[Path], root: Path) -> list[Path]:
    """Files that import modules, directly or from a package that hands on their names."""
    imports, found, handing = _imports(root), list[Path](), [*modules]
    for one in handing:  # grows by packages
        name = _module_of(one)
        for path in sorted(path for path, names in imports.items() if name in names):
            found.append(path)
            source = Path(file_of(path)) if _is_source(path) else one
            if path.name == "__init__.py" and source not in handing:
                handing.append(source)
    return found


@cache
def _words(root: Path) -> dict[str, frozenset[str]]:
    """The words of each file of tests, by its path below `root`."""
    tests = sorted(
        one for folder in ("tests", "lab/tests") for one in (root / folder).rglob("test_*.py")
    )
    return {one.relative_to(root).as_posix(): _words_of(one.read_text("utf-8")) for one in tests}


def _words_of(text: str) -> frozenset[str]:
    return frozenset(WORD.findall(text.lower().replace("_", " ")))


def _alike(file: str, root: Path) -> list[str]:
    """Files of tests of its package in the order of the words that they share with a source file.

    Rare words come first. What a registry loads is tested by its name, without an import.
    """
    folder = PACKAGES.get(Path(file).parts[0], ("", "tests"))[1]
    tests = {one: words for one, words in _words(root).items() if Path(one).is_relative_to(folder)}
    found = Counter(word for words in tests.values() for word in words)
    weight = {word: math.log(len(tests) / count) ** 2 for word, count in found.items()}
    own = _words_of(f"{file} {(root / source_path(file)).read_text('utf-8')}")

    def likeness(test: str) -> float:
        every = 1.0 + sum(weight[word] for word in tests[test])
        return sum(weight[word] for word in tests[test] & own) / math.sqrt(every)

    return sorted((one for one in tests if likeness(one)), key=likeness, reverse=True)


def near_tests(file: str, root: Path) -> list[str]:
    """Files of tests that may notice a change, nearest first, below `root`."""
    inner = Path(file)
    importing = _importing([inner], root)
    own = [one.relative_to(root) for one in _mirrors(inner, root)]
    chosen = [one for one in own if one.name.startswith(f"test_{inner.stem}")]
    chosen += [one for one in own if one in importing]
    chosen += [one for one in importing if one.name.startswith("test_") and one.parts[0] != "lab"]
    chosen = [*dict.fromkeys(chosen)][: MOST_TESTS - MOST_ALIKE]
    chosen += [one for one in map(Path, _alike(file, root)) if one not in chosen][:MOST_ALIKE]
    chosen += own + [one for one in importing if one.name.startswith("test_")]
    seen = {inner}
    # Who imports it, then who imports these.
    while len({*chosen}) < MOST_TESTS:
        users = [Path(file_of(one)) for one in importing if _is_source(one)]
        users = [one for one in dict.fromkeys(users) if one not in seen]
        if not users:
            break
        seen |= {*users}
        nearby = ((one, near.relative_to(root)) for one in users for near in _mirrors(one, root))
        chosen += [near for one, near in nearby if near.parts[1:-1] or one.stem in near.stem]
        importing = _importing(users, root)
        chosen += [one for one in importing if one.name.startswith("test_")]
    return [*dict.fromkeys(map(Path.as_posix, chosen))][:MOST_TESTS]


def wide_tests(file: str, root: Path) -> list[str]:
    """Files of tests of all rows of tables, which import what they look at by its name."""
    chosen = (one for package in ("", Path(file).parts[0]) for one in WIDE.get(package, ()))
    return [one for one in chosen if (root / one).exists()]
