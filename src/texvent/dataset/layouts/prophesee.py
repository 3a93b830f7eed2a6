"""Layouts gen1 and 1mpx: recordings of Prophesee's automotive data sets.

    train|val|test/KEY_td.dat      events
    train|val|test/KEY_bbox.npy    boxes: records t (µs), x, y, w, h (px), class_id,
                                   class_confidence, track_id

Both differ in their classes and in the sensor that readers expect. Small boxes stay: Prophesee's
evaluation leaves them out itself, with all boxes of a recording's first .5 s. A sample without
boxes has a file without records.

Source: Prophesee's automotive dataset toolbox; P. de Tournemire et al., "A large scale event-based
detection dataset for automotive", 2020; E. Perot et al., "Learning to detect objects with a 1
megapixel event camera", NeurIPS 2020.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from texvent.dataset.layouts.boxes import LABEL_RECORD, records_of
from texvent.dataset.layouts.layout import USUAL_SPLITS, Layout, LayoutSample
from texvent.io.atomic import atomic_file
from texvent.io.files import save

EVENTS_END, BOXES_END = "_td.dat", "_bbox.npy"
LARGE = "pedestrian,two wheeler,car,truck,bus,traffic sign,traffic light"


def _boxes_beside(path: Path) -> Path:
    return path.with_name(path.name.removesuffix(EVENTS_END) + BOXES_END)


def _write(sample: LayoutSample, path: Path) -> bool:
    """Write the boxes, then the events, whose file says that both are there."""
    with atomic_file(_boxes_beside(path), overwrite=True) as part, part.open("wb") as file:
        np.save(file, records_of(sample.boxes, LABEL_RECORD))
    events = replace(sample.read_events(), label=None, metadata={})
    save(path, events, format="dat")
    return True


GEN1 = Layout(
    place="{split}/{key}" + EVENTS_END,
    write=_write,
    beside=_boxes_beside,
    splits=USUAL_SPLITS,
    size=(304, 240),
    lost="captions",
    has_boxes=True,
    classes="car,pedestrian",
)
MEGAPIXEL = replace(GEN1, size=(1280, 720), classes=LARGE)
