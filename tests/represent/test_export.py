import pytest

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(8, 6)
EVENTS = EventStream([3, 4], [0, 5], [10, 2**40], [1, 0], SIZE)
LABELLED = EventStream([3], [0], [10], [1], SIZE, label=[1])


def test_structured_records_keep_every_column_and_its_type():
    records = EVENTS.to_structured()
    assert records.tolist() == [(3, 0, 10, 1), (4, 5, 2**40, 0)]
    assert records.dtype.descr == [("x", "<u2"), ("y", "<u2"), ("t", "<i8"), ("p", "|u1")]
    assert LABELLED.to_structured().dtype.names == ("x", "y", "t", "p", "label")
    records["p"] = 0
    assert EVENTS.p.tolist() == [1, 0]


def test_tonic_records_have_signed_types_that_its_voxel_grid_can_hold():
    records = LABELLED.to_tonic()
    assert records.dtype.descr == [("x", "<i2"), ("y", "<i2"), ("t", "<i8"), ("p", "|i1")]
    assert EVENTS.to_tonic().tolist() == [(3, 0, 10, 1), (4, 5, 2**40, 0)]
    # What tonic does to OFF events: with an unsigned or bool p, −1 would not be −1.
    records["p"][:] = -1
    assert records["p"].tolist() == [-1]


def test_a_sensor_beyond_int16_does_not_fit_tonic():
    with pytest.raises(InputError, match=r"32,768; the sensor is 32769x1\. Use to_structured"):
        EventStream.empty(SensorSize(32_769, 1)).to_tonic()
    edge = EventStream([32_767], [0], [0], [1], SensorSize(32_768, 1))
    assert edge.to_tonic()["x"].tolist() == [32_767]


def test_a_dataframe_has_the_columns_and_their_types():
    import pandas  # it takes a second, in each worker that collects

    frame = LABELLED.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert list(frame.columns) == ["x", "y", "t", "p", "label"]
    assert [str(one) for one in frame.dtypes] == ["uint16", "uint16", "int64", "uint8", "uint8"]
    whole = EVENTS.to_dataframe()
    assert whole["t"].tolist() == [10, 2**40]
    whole.loc[0, "p"] = 0
    assert EVENTS.p.tolist() == [1, 0]
