"""Sphinx configuration of the documentation site: `make docs` writes it to docs/_build/html.

The pages are also read where the repository is hosted, so they are plain Markdown. What only the
site needs (navigation, figures, the film of the start page) is added here or made by docs/site.
"""

import os
import re
import sys
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.pycode import ModuleAnalyzer

import texvent

DOCS = Path(__file__).parent
MADE = DOCS / "_build" / "made"
sys.path[:0] = [str(DOCS / "site"), str(DOCS.parent)]  # making.py uses tools/licences.py
# Executed pages call `texvent` by name.
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
# What commands print in executed pages: no bars that move, no colours.
os.environ.update(TTY_COMPATIBLE="0", NO_COLOR="1", COLUMNS="90")

import camera_tables  # noqa: E402 - docs/site is on the path only now
import making  # noqa: E402
import scene_pictures  # noqa: E402

project = "texvent"
author = "The texvent authors"
copyright = author
version = release = texvent.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "**.ipynb_checkpoints", "examples", "gallery/*.ipynb", "site/_*"]
templates_path = ["site/_templates"]
default_role = "code"  # docstrings write `name`

# Pages
myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist"]
myst_heading_anchors = 4  # the anchors that forges make of headings
nb_execution_mode = "force"
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 600  # the first cell may compile kernels
nb_merge_streams = True
nb_output_stderr = "remove-warn"  # a warning in a cell is a warning of the build
nb_ipywidgets_js = {}  # nothing from other hosts
# Names in `code` are not links, so it does not matter that some occur twice.
suppress_warnings = ["config.cache", "ref.python"]

# API
# The site is built without torch, which the training stream loads.
autodoc_mock_imports = ["torch"]
autodoc_typehints = "signature"
autodoc_type_aliases = {"ArrayLike": "ArrayLike"}
autodoc_member_order = "bysource"
maximum_signature_line_length = 80
napoleon_google_docstring = True
napoleon_use_rtype = False
napoleon_custom_sections = ["Equation", "Deviation", "Source"]

# Gallery
sphinx_gallery_conf = {
    "examples_dirs": "examples",
    "gallery_dirs": "gallery",
    "filename_pattern": "",
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": ("matplotlib",),
    "matplotlib_animations": False,
    "capture_repr": (),
    "remove_config_comments": True,
    "show_memory": False,
    "min_reported_time": 1e6,
    "write_computation_times": False,
    "download_all_examples": False,
    "abort_on_example_error": True,
    "reset_modules": ("making.reset_matplotlib",),
    "plot_gallery": "True",
    "thumbnail_size": (400, 280),
}

# Look
html_theme = "furo"
html_title = "texvent"
html_static_path = ["site/_static", "_build/made/static"]
html_css_files = ["site.css"]
html_js_files = ["versions.js"]
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False
pygments_style = "default"
pygments_dark_style = "github-dark"
copybutton_prompt_text = r"\$ |>>> |\.\.\. "
copybutton_prompt_is_regexp = True
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "version.html",
        "sidebar/search.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1f5fbf", "color-brand-content": "#1f5fbf"},
    "dark_css_variables": {"color-brand-primary": "#8ab4f8", "color-brand-content": "#8ab4f8"},
}

# Pages below others. The pages themselves stay free of it, since forges would show it as text.
CHILDREN = {
    "simulators": [
        f"simulators/{name}"
        for name in ("texvent", "esim", "v2e", "physical", "cameras", "voltmeter", "senpi", "v2ce")
    ],
    # Pages of results are made by docs/site/making.py.
    "benchmark": ["results/fidelity", "results/fidelity-programs", "results/paper"],
    "real-data": ["results/real-slider_depth", "results/real-davis346"],
    "digits": ["results/digits", "results/digits-all", "results/digits-ablation"],
    "objects": [
        "results/objects",
        "results/objects-recorded",
        "results/objects-factors",
        "results/objects-clips",
        "results/objects-programs",
    ],
    "teaching": [
        "results/objects-recipes",
        "results/reconstruction-factors",
        "results/reconstruction-stream",
    ],
    "metrics": ["results/selftest"],
    "speed": ["results/speed"],
    "datasets": ["datasets-load", "spiking"],
    "notebooks": ["notebooks/your-video", "notebooks/train-a-network"],
    "site/architecture": ["design"],
}
# Pages outside of docs/ that the site shows.
OUTSIDE = {name: f"site/{name.lower()}" for name in ("ARCHITECTURE", "CONTRIBUTING", "CHANGELOG")}


def adapt_page(_: Sphinx, page: str, source: list[str]) -> None:
    """Add the pages below this one, and lead links out of docs/ to where the site has the page."""
    text = source[0]
    up = "../" * page.count("/")
    for name, target in OUTSIDE.items():
        text = re.sub(rf"\]\({up}\.\./{name}\.md(#[\w-]+)?\)", rf"]({up}{target}.md\1)", text)
    text = re.sub(rf"\[([^\]]+)\]\({up}\.\./[\w/-]+\)", r"\1", text)  # folders of the repository
    if page == "index":
        text += unlisted(text)
    if page == "simulators/cameras":
        text = camera_tables.with_tables(text)
    if page == "site/scene-pictures":
        text += "\n".join(scene_pictures.cards())
    if CHILDREN.get(page):
        names = "\n".join(f"/{child}" for child in CHILDREN[page])
        text += f"\n```{{toctree}}\n:hidden:\n\n{names}\n```\n"
    source[0] = text


def unlisted(index: str) -> str:
    """Pages of docs/ that the start page does not list yet, so that none is lost."""
    listed = {*index.splitlines(), *(child for names in CHILDREN.values() for child in names)}
    names = sorted({path.stem for path in DOCS.glob("*.md")} - listed - {"index"})
    lines = "\n".join(names)
    return f"\n```{{toctree}}\n:hidden:\n:caption: More\n\n{lines}\n```\n" if names else ""


def one_signature_each() -> None:
    """Signatures say what the function takes once, not once per overload."""
    for module in (
        "texvent.api.functions",
        "texvent.dataset",
        "texvent.event_packets",
        "texvent.events",
    ):
        analyzer = ModuleAnalyzer.for_module(module)
        analyzer.analyze()
        analyzer.overloads.clear()
    for function in (texvent.generate, texvent.simulate, texvent.video):
        del function.__signature__  # it names all options, which have a page of their own


def short_types(*event: Any) -> tuple[str | None, str | None]:
    """Write `ndarray[uint16]` for the long names of array types, `...` for default factories."""
    array = r"~?(?:numpy\.)?ndarray\[~?tuple\[~?(?:typing\.)?Any, \.\.\.\], ~?(?:numpy\.)?dtype\["
    arguments, result = (
        text and re.sub(array + r"~?(?:numpy\.|typing\.)?(\w+)\]\]", r"ndarray[\1]", text)
        for text in event[-2:]
    )
    if arguments:
        arguments = arguments.replace("<factory>", "...")
    return arguments, result


class AttributeDocstrings:
    """Docstrings of attributes as they are: napoleon takes what precedes a colon for a type."""

    def __init__(self) -> None:
        self.kept: dict[str, list[str]] = {}

    def keep(self, _: Sphinx, what: str, name: str, *rest: Any) -> None:
        """Before napoleon."""
        if what == "attribute":
            self.kept[name] = list(rest[-1])

    def restore(self, _: Sphinx, what: str, name: str, *rest: Any) -> None:
        """After napoleon."""
        if what == "attribute":
            rest[-1][:] = self.kept.pop(name)


def setup(app: Sphinx) -> None:
    """Make what pages show, before they are read."""
    making.make_all(MADE)
    one_signature_each()
    app.connect("source-read", adapt_page)
    app.connect("autodoc-process-signature", short_types)
    attributes = AttributeDocstrings()
    app.connect("autodoc-process-docstring", attributes.keep, priority=1)
    app.connect("autodoc-process-docstring", attributes.restore, priority=900)
