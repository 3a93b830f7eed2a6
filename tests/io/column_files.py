"""Files of named columns, as other programs write them."""

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from numpy.typing import NDArray


def write_columns(path: Path, columns: dict[str, NDArray[Any]]) -> Path:
    """A file whose name ends as its kind says; "rows.npy" has rows without names of columns."""
    kind = path.name.partition(".")[2]
    match kind:
        case "npz":
            np.savez(path, **columns)  # type: ignore[arg-type]  # of NumPy's stubs
        case "rows.npy":
            np.save(path, np.stack([columns[name] for name in "txyp"], axis=1))
        case "npy":
            fields = [(name, one.dtype) for name, one in columns.items()]
            records = np.zeros(len(columns["t"]), fields)
            for name, one in columns.items():
                records[name] = one
            np.save(path, records)
        case "h5":
            with h5py.File(path, "w") as file:
                for name, one in columns.items():
                    file[f"events/{name}"] = one
        case "parquet":
            arrow = pytest.importorskip("pyarrow")
            table = arrow.table({name: arrow.array(one) for name, one in columns.items()})
            parquet = pytest.importorskip("pyarrow.parquet")
            parquet.write_table(table, path, row_group_size=500)
        case _:
            mark = "," if kind == "csv" else " "
            rows = zip(*(one.tolist() for one in columns.values()), strict=True)
            texts = [[f"{one:.16g}" if isinstance(one, float) else str(one) for one in row]
                     for row in rows]  # fmt: skip
            path.write_text("".join(mark.join(row) + "\n" for row in [columns, *texts]))
    return path
