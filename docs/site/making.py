"""Parts of the site that the repository does not hold: a film, plots, pictures, pages of tables.

Sphinx calls `make_all` before it reads pages. Files newer than their sources are kept.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import matplotlib

from texvent.cli.app import main

ROOT = Path(__file__).parents[2]
RESULTS = ROOT / "docs/results"
BENCHMARKS = {
    "fidelity": (),
    "fidelity-programs": (),
    "paper": (),
    "real-slider_depth": ("--baseline", "texvent accurate, flow"),
    "real-davis346": ("--baseline", "texvent accurate, flow"),
    "digits": (),
    "digits-all": (),
    "digits-ablation": (),
    "objects": (),
    "objects-factors": (),
    "objects-clips": (),
    "objects-recipes": (),
    "objects-recorded": (),
    "objects-programs": (),
    "reconstruction-factors": (),
    "reconstruction-stream": (),
    "selftest": (),
}
"""Results that `texvent bench page` turns into a page of the same name, and its options."""


def make_all(folder: Path) -> None:
    """Make the film, plots and pictures of scenes, in a folder; pages of results and licences."""
    matplotlib.use("agg")
    import film
    import plots
    import scene_pictures

    (folder / "static").mkdir(parents=True, exist_ok=True)
    film.make_film(folder / "static")
    plots.make_plots(folder)
    scene_pictures.make_pictures(folder)
    make_result_pages()
    make_licences()


def make_result_pages() -> None:
    """Write a page beside each stored result: of benchmarks and of speed."""
    for name, options in BENCHMARKS.items():
        if _is_old(RESULTS / f"{name}.md", [RESULTS / f"{name}.json.gz"]):
            result = str(RESULTS / f"{name}.json.gz")
            if main(["bench", "page", result, *options, "--overwrite"]):
                raise RuntimeError(f"texvent bench page {result} failed")
    make_speed_page()


def make_speed_page() -> None:
    """All tables of the stored measurement of speed."""
    from texvent_lab.bench.document import read_document
    from texvent_lab.measure.speed.tables import as_markdown

    text = [
        "# Speed: the tables",
        "Written from `docs/results/speed.json.gz`; [speed.md](../speed.md) has the summary. "
        "`clip`: one thread; `clips`: two threads with a clip each. Peers below 1 are faster than "
        "texvent.",
        as_markdown(read_document(RESULTS / "speed.json.gz")),
    ]
    (RESULTS / "speed.md").write_text("\n\n".join(text) + "\n", encoding="utf-8")


def make_licences() -> None:
    """The page of licences, from every environment of this checkout, else the running one."""
    import sys

    from tools import licences

    found = [path for path in sorted(ROOT.glob(".venv*")) if list(path.glob("lib/python3*"))]
    packages: dict[str, licences.Package] = {}
    for folder in found or [Path(sys.prefix)]:
        packages |= licences.environment(folder)
    (ROOT / "docs" / "licences.md").write_text(licences.page(packages), encoding="utf-8")


def _is_old(page: Path, sources: Iterable[Path]) -> bool:
    """Whether a page is missing, or older than one of its sources."""
    return not page.exists() or any(
        source.stat().st_mtime > page.stat().st_mtime for source in sources
    )


def reset_matplotlib(gallery_conf: dict[str, Any], file: str) -> None:
    """Give each example of the gallery the same look, whatever the one before changed.

    Args:
        gallery_conf: configuration of sphinx-gallery; not used.
        file: the example about to run; not used.
    """
    del gallery_conf, file
    import matplotlib.pyplot as plt

    plt.rcdefaults()
    plt.rcParams.update(
        {
            "figure.figsize": (7, 4),
            "figure.dpi": 100,
            "savefig.dpi": 130,
            "figure.constrained_layout.use": True,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.titlesize": "medium",
            "font.size": 11,
            "image.interpolation": "nearest",
        }
    )
