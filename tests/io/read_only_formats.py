"""Files of formats that texvent only reads, made as their own programs make them."""

import json
from pathlib import Path

import h5py
import numpy as np

from texvent.events import EventStream

from .prophesee.ecf_bodies import make_chunk

ECF_FILTER = 0x8ECF
CHUNK_EVENTS = 16_384
ECF_EVENT = np.dtype(
    {
        "names": ["x", "y", "p", "t"],
        "formats": ["<u2", "<u2", "<i2", "<i8"],
        "offsets": [0, 2, 4, 8],
        "itemsize": 16,
    }
)


def write_evreal(folder: Path, events: EventStream) -> Path:
    """EVREAL's folder of arrays."""
    folder.mkdir()
    np.save(folder / "events_ts.npy", events.t / 1e6)
    np.save(folder / "events_xy.npy", np.stack([events.x, events.y], axis=1))
    np.save(folder / "events_p.npy", events.p.astype(bool))
    facts = {"sensor_resolution": [events.size.height, events.size.width]}
    (folder / "metadata.json").write_text(json.dumps(facts))
    return folder


def write_ecf(path: Path, events: EventStream) -> Path:
    """Metavision's HDF5; every chunk is a packed ECF body."""
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    # Optional, as in Metavision: HDF5 then does not ask for the filter itself.
    properties.set_filter(ECF_FILTER, h5py.h5z.FLAG_OPTIONAL)
    rows = list(
        zip(events.x.tolist(), events.y.tolist(), events.t.tolist(), events.p.tolist(), strict=True)
    )
    with h5py.File(path, "w") as file:
        dataset = file.create_dataset(
            "CD/events",
            shape=(len(rows),),
            maxshape=(None,),
            chunks=(CHUNK_EVENTS,),
            dtype=ECF_EVENT,
            dcpl=properties,
        )
        for start in range(0, len(rows), CHUNK_EVENTS):
            chunk = make_chunk(rows[start : start + CHUNK_EVENTS], "packed")
            dataset.id.write_direct_chunk((start,), chunk)
        file.attrs.create("geometry", str(events.size), dtype=h5py.string_dtype("ascii"))
    return path
