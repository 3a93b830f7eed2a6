"""Pages and charts of the stored results, and digests of them.

python -m lab.tests.bench.stored_pages    # writes them anew, after a result or a page changed
"""

import hashlib
import json
from pathlib import Path

from texvent_lab.bench.document import read_document
from texvent_lab.bench.page import page_files

RESULTS = Path(__file__).parents[3] / "docs" / "results"
PAGES = Path(__file__).with_name("stored_pages.json")
OTHER = (
    "codecs",
    "detection",
    "gpu",
    "images-davis346",
    "images-slider_depth",
    "scenes",
    "speed",
    "stream",
    "street",
)
"""Results that pages of docs show themselves."""
NAMES = sorted(
    name for path in RESULTS.glob("*.json*") if (name := path.name.split(".")[0]) not in OTHER
)


def stored(name: str) -> dict[str, bytes]:
    """Files of the page of a stored result; and the result."""
    document = read_document(RESULTS / f"{name}.json.gz")
    files = page_files(document, f"{name}.json.gz")
    return files | {"result": json.dumps(document, sort_keys=True).encode()}


def digests(files: dict[str, bytes]) -> dict[str, str]:
    """File → its digest."""
    return {file: hashlib.sha256(content).hexdigest()[:12] for file, content in files.items()}


if __name__ == "__main__":
    PAGES.write_text(json.dumps({name: digests(stored(name)) for name in NAMES}) + "\n")
