"""Results of compare, and samples of data sets, in a notebook."""

from __future__ import annotations

import json
import pickle

import texvent
from texvent.events import EventStream
from texvent.metrics.compare import load_metric
from texvent.sensor import SensorSize

EVENTS = EventStream([1, 2], [0, 0], [100, 900], [1, 0], SensorSize(4, 3))


def test_scores_are_a_dict_and_a_table():
    scores = texvent.compare(EVENTS, EVENTS, ["stpp", "nearest", "count_ratio"])
    assert scores == {"stpp": 1.0, "nearest": 0.0, "count_ratio": 1.0}
    assert json.loads(json.dumps(scores)) == scores
    again = pickle.loads(pickle.dumps(scores))
    bundle = scores._repr_mimebundle_()
    assert again == scores
    assert again._repr_mimebundle_() == bundle
    assert bundle["text/plain"] == "{'stpp': 1.0, 'nearest': 0.0, 'count_ratio': 1.0}"
    table = bundle["text/html"]
    assert table.count("<tr>") == 4
    assert ">1.0000<" in table
    assert ">near 1<" in table
    assert f">0.0000 {load_metric('nearest').unit}<" in table
