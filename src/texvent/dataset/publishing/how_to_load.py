"""How to load a data set, as its card says it; the tests run these lines."""

from __future__ import annotations

from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.publishing.index import INDEX_FILE

TEMPLATE = """With texvent:

```python
import texvent.dataset

samples = texvent.dataset.open("DIR", variant="VARIANT", split="SPLIT")
events, caption = samples[0].events, samples[0].caption
```

With [webdataset](https://github.com/webdataset/webdataset):

```python
import webdataset

samples = webdataset.WebDataset("DIR/VARIANT/FIRST.tar", shardshuffle=False).decode()
for sample in samples:
    x, y, t, p = (sample[f"{name}.npy"] for name in "xytp")
    caption = sample["txt"]
```

With [datasets](https://github.com/huggingface/datasets) 4.7 or newer, from the Hub or a folder:

```python
from datasets import load_dataset

samples = load_dataset("DIR", "VARIANT", split="HUB_SPLIT")
times = samples.select_columns(["t.npy"]).with_format("numpy")[0]["t.npy"]
```

With NumPy alone, any sample at once, by the index:

```python
import io

import numpy
import pandas

index = pandas.read_parquet("DIR/INDEX")
row = index[index["variant"] == "VARIANT"].iloc[0]
with open("DIR/" + row["shard"], "rb") as shard:
    shard.seek(row["t_offset"])
    times = numpy.load(io.BytesIO(shard.read(row["t_bytes"])))
```"""


def loading_text(made: MadeSet, place: tuple[str, str]) -> str:
    """The section of the card.

    Args:
        made: the data set.
        place: variant and split that the examples load.
    """
    variant, split = place
    first = next(shard for shard in made.shards(variant) if shard.record.split == split)
    words = {
        "HUB_SPLIT": split.replace("-", "_"),
        "VARIANT": variant,
        "SPLIT": split,
        "FIRST": first.record.name,
        "INDEX": INDEX_FILE,
    }
    text = TEMPLATE
    for word, value in words.items():
        text = text.replace(word, value)
    return text
