"""What the site shows and the repository does not hold: a film by texvent, plots of the results.

Sphinx calls `make_all` before it reads pages. A film that is there already is kept.
"""

from pathlib import Path
from typing import Any

import matplotlib

import texvent
from texvent.view.render import RenderConfig, render_events

PROMPT = "a red car drives left past two trees at dusk"


def make_all(folder: Path) -> None:
    """Make the film of the start page and the plots of the benchmark page, in a folder."""
    matplotlib.use("agg")
    import plots

    (folder / "static").mkdir(parents=True, exist_ok=True)
    make_film(folder / "static")
    plots.make_plots(folder)


def make_film(folder: Path) -> None:
    """Frames beside events of the prompt of the start page: a film and its first image."""
    film, still = folder / "start.mp4", folder / "start.png"
    if film.exists() and still.exists():
        return
    options: Any = {"sensor": "240x180", "duration": 1.4, "seed": 3, "progress": False}
    frames = texvent.video(PROMPT, **options)
    events = texvent.generate(PROMPT, interpolate="flow", **options)
    render_events(events, film, frames=frames, config=RenderConfig(speed=0.5), overwrite=True)
    render_events(events, still, frames=frames, overwrite=True)


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
