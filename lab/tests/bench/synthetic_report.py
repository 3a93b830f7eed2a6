"""A report with known numbers, for the tests of tables and charts."""

import math

from texvent_lab.bench.fidelity.results import FidelityReport, Reference, Score


def synthetic_report():
    metrics = {"stpp": [0.9, 0.8], "nearest": [1.0, 3.0]}
    reference = Reference(
        scene="mixed",
        target="noisy",
        events=[100, 200],
        floor=metrics,
        null={"stpp": [0.1, 0.3], "nearest": [9.0, 9.0]},
    )

    def score(entry, stpp, **changes):
        return Score(
            **{
                "scene": "mixed",
                "target": "noisy",
                "entry": entry,
                "track": "frames",
                "threshold": 0.1,
                "is_matched": True,
                "default_ratio": 0.5,
                "values": {"stpp": stpp, "nearest": [5.0, 7.0]},
                **changes,
            }
        )

    scores = [
        score("texvent paper, blend", [0.5, 0.4]),
        score("better", [0.7, 0.8], is_matched=False),
        score("lost", [math.nan, math.nan]),
    ]
    return FidelityReport(
        environment={"commit": "0123abc", "device": "a processor, 2 cores"},
        fit_seeds=[7],
        score_seeds=[21, 33],
        references=[reference],
        scores=scores,
        skipped={"esim, motion": "needs motion"},
    )
