"""Pages of stored results: the site lists those that it makes, and all of them."""

import ast
import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"


def test_every_page_of_results_is_listed_and_made() -> None:
    made = next(
        ast.literal_eval(node.value)
        for node in ast.parse((DOCS / "site/making.py").read_text(encoding="utf-8")).body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "BENCHMARKS"
    )
    listed = re.findall(r'"results/([\w-]+)"', (DOCS / "conf.py").read_text(encoding="utf-8"))
    assert sorted(listed) == sorted([*made, "speed"])
    assert all((DOCS / f"results/{name}.json.gz").is_file() for name in listed)
