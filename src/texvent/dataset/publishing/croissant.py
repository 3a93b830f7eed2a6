"""Croissant 1.1 description: files and columns of the index, as JSON-LD.

Source: the Croissant format specification 1.1 and its RAI vocabulary 1.0, MLCommons.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from texvent.dataset.publishing.card import PublicationInfo
from texvent.dataset.publishing.index import FIELDS
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.statistics import DatasetStatistics

CROISSANT_FILE = "croissant.json"
CONFORMS_TO = ("http://mlcommons.org/croissant/1.1", "http://mlcommons.org/croissant/RAI/1.0")
DATA_TYPES = {"string": "sc:Text", "strings": "sc:Text", "int32": "cr:Int32", "int64": "cr:Int64"}
INDEX_ID = "samples"
_OF_CROISSANT = (
    "arrayShape citeAs column containedIn equivalentProperty extract field fileProperty fileObject "
    "fileSet format includes isArray isLiveDataset jsonPath key md5 parentField path recordSet "
    "references regex repeated replace samplingRate separator source subField transform"
)
CONTEXT: dict[str, Any] = {
    "@language": "en",
    "@vocab": "https://schema.org/",
    **{name: f"cr:{name}" for name in _OF_CROISSANT.split()},
    "conformsTo": "dct:conformsTo",
    "cr": "http://mlcommons.org/croissant/",
    "rai": "http://mlcommons.org/croissant/RAI/",
    "data": {"@id": "cr:data", "@type": "@json"},
    "dataType": {"@id": "cr:dataType", "@type": "@vocab"},
    "dct": "http://purl.org/dc/terms/",
    "description": {"@container": "@language"},
    "examples": {"@id": "cr:examples", "@type": "@json"},
    "name": {"@container": "@language"},
    "sc": "https://schema.org/",
}
"""Context of every Croissant 1.1 file."""


def croissant_text(
    dataset: StoredDataset, statistics: DatasetStatistics, info: PublicationInfo, index: Path
) -> str:
    """The description, checked by `mlcroissant validate` in the tests.

    Args:
        dataset: the data set.
        statistics: of it.
        info: author, licence, address.
        index: the Parquet index that was written.
    """
    total = statistics.total
    described = str(dataset.specification.get("description") or "").strip()
    counts = f"{total.samples:,} simulated event-camera samples of {len(total.clips):,} videos."
    given = {
        "url": info.url,
        "datePublished": info.date,
        "creator": info.creator and {"@type": "sc:Organization", "name": info.creator},
        "license": info.license_of(dataset) or None,
    }
    with index.open("rb") as file:
        sha256 = hashlib.file_digest(file, "sha256").hexdigest()
    document = {
        "@context": CONTEXT,
        "@type": "sc:Dataset",
        "conformsTo": [*CONFORMS_TO],
        "name": dataset.name,
        "description": f"{described} {counts}".strip(),
        **{name: value for name, value in given.items() if value},
        # Another version for other samples: the identity as a build number.
        "version": f"1.0.0+{dataset.identity[:12]}",
        "isLiveDataset": False,
        "keywords": ["event camera", "neuromorphic vision", "synthetic data", "texvent"],
        "rai:dataCollection": "Simulated from videos by models of event cameras; nothing was "
        "recorded by an event camera. The .json of each sample names every setting.",
        "rai:dataCollectionType": "Software Collection",
        "rai:dataBiases": "The content follows the chosen prompts or videos and their generator.",
        "rai:dataLimitations": "Simulated events lack what the model of the sensor leaves out. "
        "Captions are prompts; a video may show less.",
        "distribution": [
            _file(index.name, "application/x-parquet", index.stat().st_size, sha256),
            *(
                _file(shard.place, "application/x-tar", shard.record.bytes, shard.record.sha256)
                for shard in dataset.shards()
            ),
            *_file_sets(dataset),
        ],
        "recordSet": [_record_set(index.name)],
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _file(place: str, kind: str, size: int, sha256: str) -> dict[str, Any]:
    return {
        "@type": "cr:FileObject",
        "@id": place,
        "name": place,
        "contentUrl": place,
        "contentSize": f"{size} B",
        "encodingFormat": kind,
        "sha256": sha256,
    }


def _file_sets(dataset: StoredDataset) -> Iterator[dict[str, Any]]:
    """Members of the tars of each variant."""
    kinds = {"json": "application/json", "txt": "text/plain", "npy": "application/x-npy"}
    for variant in dataset.variants:
        places = [{"@id": shard.place} for shard in dataset.shards(variant)]
        for extension, kind in kinds.items() if places else ():
            yield {
                "@type": "cr:FileSet",
                "@id": f"{variant}-{extension}",
                "name": f"{variant}-{extension}",
                "containedIn": places,
                "encodingFormat": kind,
                "includes": f"*.{extension}",
            }


def _record_set(index: str) -> dict[str, Any]:
    fields = [
        {
            "@type": "cr:Field",
            "@id": f"{INDEX_ID}/{name}",
            "name": name,
            "description": text,
            "dataType": DATA_TYPES[kind],
            **({"isArray": True, "arrayShape": "-1"} if kind == "strings" else {}),
            "source": {"fileObject": {"@id": index}, "extract": {"column": name}},
        }
        for name, (kind, text) in FIELDS.items()
    ]
    return {
        "@type": "cr:RecordSet",
        "@id": INDEX_ID,
        "name": INDEX_ID,
        "description": "One record per sample, from the index.",
        "key": {"@id": f"{INDEX_ID}/key"},
        "field": fields,
    }
