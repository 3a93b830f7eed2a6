"""Report of NT-ImageNet: chosen streams, captions, and captions with problems."""

from __future__ import annotations

import math
import statistics
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from texvent.extending import full_version
from texvent_lab.nt_imagenet.captions import CHECKS, CaptionCheck, find_duplicates
from texvent_lab.nt_imagenet.selection import Selection

LONGEST_US = 55_000
"""N-ImageNet's streams are at most this long."""
TERMS = (
    "This folder holds ids, captions, counts and our own specification. ImageNet's images may not "
    "be redistributed, and N-ImageNet's events are AGPL-3.0: neither is here. The terms of the "
    "model that made the captions apply to them (LLaVA-1.5: Llama 2's)."
)


@dataclass(frozen=True, kw_only=True)
class Report:
    """Streams, captions and the results of their checks."""

    selection: Selection
    per_class: int
    captions: Mapping[str, str]
    """Id → caption, those that were left out included."""
    checks: Mapping[str, CaptionCheck]
    failures: Mapping[str, str] = field(default_factory=dict)
    """Id → why it has no caption."""
    left_out: Sequence[str] = ()
    """Ids whose caption failed a check that leaves it out."""
    levels: Sequence[float] = ()
    """Mean level of each image, 0..255; empty without the images."""
    captions_file: str | None = None
    """File that the captions are from."""
    captions_model: str | None = None
    """Made the captions that the file lacks, as answers to the paper's question."""

    @property
    def facts(self) -> dict[str, Any]:
        """Plain values, ready for JSON."""
        return {
            "texvent_version": full_version(),
            "captions_file": self.captions_file,
            "captions_model": self.captions_model,
            "streams": self._stream_facts(),
            "captions": self._caption_facts(),
            "left_out": list(self.left_out),
            "terms": TERMS,
        }

    def _stream_facts(self) -> dict[str, Any]:
        selection = self.selection
        durations = [stream.duration_us for stream in selection.streams]
        return {
            "count": len(durations),
            "classes": list(selection.classes),
            "incomplete_classes": selection.incomplete(self.per_class),
            "per_class": _spread(list(Counter(one.wnid for one in selection.streams).values())),
            "events": _spread([stream.events for stream in selection.streams]),
            "duration_us": _spread(durations),
            "median_speed_px_s": _spread([one.speed_px_s for one in selection.streams]),
            "image_level": _spread(self.levels),
            "longer_than_55_ms": sum(one > LONGEST_US for one in durations),
            "too_few_events": list(selection.too_few),
            "too_many_events": list(selection.too_many),
            "unreadable": dict(selection.unreadable),
        }

    def _caption_facts(self) -> dict[str, Any]:
        checks = self.checks
        return {
            "count": len(checks),
            "missing": dict(self.failures),
            "words": _spread([one.words for one in checks.values()]),
            "problems": {
                name: [id for id, one in checks.items() if name in one.problems] for name in CHECKS
            },
            "duplicates": [list(group) for group in find_duplicates(self.captions)],
        }

    @property
    def text(self) -> str:
        """Counts, and the rows of the paper's Table 10."""
        streams, captions = self._stream_facts(), self._caption_facts()
        problems = (f"{name} {len(ids)}" for name, ids in captions["problems"].items())
        rows = {
            "streams per class": streams["per_class"],
            "events per stream": streams["events"],
            "words per caption": captions["words"],
            "mean level of an image, 0 to 255": streams["image_level"],
            "median speed of edges, px/s": streams["median_speed_px_s"],
        }
        spreads = (f"{name}: {_spread_text(one)}\n" for name, one in rows.items())
        return (
            f"{streams['count']:,} streams of {len(streams['classes'])} classes; left out: "
            f"{len(streams['too_few_events'])} with too few events, "
            f"{len(streams['too_many_events'])} with too many, {len(streams['unreadable'])} "
            "unreadable\n"
            f"{captions['count']:,} captions, {len(captions['missing'])} missing, "
            f"{len(self.left_out)} left out\n"
            f"captions with problems: {', '.join(problems)}\n{''.join(spreads)}"
        )


def _spread(values: Sequence[float]) -> dict[str, float] | None:
    known = [one for one in values if not math.isnan(one)]
    if not known:
        return None
    return {"least": min(known), "median": statistics.median(known), "most": max(known)}


def _spread_text(found: Mapping[str, float] | None) -> str:
    if found is None:
        return "not known"
    return "{least:,.0f} to {most:,.0f}, median {median:,.0f}".format(**found)
