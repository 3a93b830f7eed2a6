"""Results of compare, and samples of data sets, in a notebook."""

from __future__ import annotations

import gc
import json
import math
import pickle
import weakref

import texvent
from texvent.events import EventStream
from texvent.metrics.compare import Scores, load_metric
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


def test_scores_let_their_metrics_go():
    metric = load_metric("nearest")
    scores, gone = Scores({"nearest": 1.0}, [metric]), weakref.ref(metric)
    del metric
    gc.collect()
    assert gone() is None
    assert b"NearestTime" not in pickle.dumps(scores)
    assert "nearest" in scores._repr_mimebundle_()["text/html"]


def test_an_undefined_score_says_so_and_names_are_escaped():
    table = Scores({"<b>": math.nan}, [])._repr_mimebundle_()["text/html"]
    assert "undefined" in table
    assert "&lt;b&gt;" in table
