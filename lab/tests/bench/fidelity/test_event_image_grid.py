import cv2
import numpy as np

from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.fidelity.page import COLUMNS, event_image_grid
from texvent_lab.bench.fidelity.results import FidelityReport, Reference, Score

from ..synthetic_report import synthetic_details


def test_the_grid_shows_scene_truth_second_recording_and_the_scored_entries_best_first():
    entries = [Entry(simulator="esim", interpolate=name) for name in ("none", "blend")]
    scores = [
        Score(
            scene="translate",
            target="noisy",
            entry=entry.name,
            track=entry.track,
            threshold=0.1,
            is_matched=True,
            default_ratio=1.0,
            seconds=1.0,
            values={"stpp": [value]},
            details=synthetic_details(),
        )
        for entry, value in zip(entries, (0.4, 0.6), strict=True)
    ]
    reference = Reference(
        scene="translate",
        target="noisy",
        events=[1],
        floor={},
        null={},
        details=synthetic_details(),
    )
    report = FidelityReport(
        environment={}, fit_seeds=[7], score_seeds=[21], references=[reference], scores=scores
    )
    png = event_image_grid(report, "translate")
    image = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)
    # Scene, truth, second recording and two scored entries: two rows of four.
    rows, columns = image.shape[0] // 2, image.shape[1] // COLUMNS
    panels = [
        image[row * rows : (row + 1) * rows, column * columns : (column + 1) * columns]
        for row in range(2)
        for column in range(COLUMNS)
    ]
    is_empty = [np.ptp(panel.reshape(-1, 3), axis=0).max() == 0 for panel in panels]
    assert is_empty == [False] * 5 + [True] * 3
    scene, truth, second = panels[:3]
    assert (scene[40:-20, 10:-10, 0] == scene[40:-20, 10:-10, 2]).all()  # grey
    assert not np.array_equal(truth, second)
