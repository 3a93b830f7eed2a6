"""A Croissant 1.1 description: what files there are, and the columns of the index, as JSON-LD.

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
"""What every Croissant 1.1 file begins with."""


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
    given = {
        "url": info.url,
        "datePublished": info.date,
        "creator": info.creator and {"@type": "sc:Organization", "name": info.creator},
        "license": info.license_of(dataset) or None,
    }
    document = {
        "@context": CONTEXT,
        "@type": "sc:Dataset",
        "conformsTo": [*CONFORMS_TO],
        "name": dataset.name,
        "description": _description(dataset, total.samples, len(total.clips)),
        **{name: value for name, value in given.items() if value},
        "version": f"1.0.0+{dataset.identity[:12]}",
        "isLiveDataset": False,
        "keywords": ["event camera", "neuromorphic vision", "synthetic data", "texvent"],
        **_responsible_ai(dataset),
        "distribution": [_index_file(index), *_shard_files(dataset), *_file_sets(dataset)],
        "recordSet": [_record_set(index.name)],
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _description(dataset: StoredDataset, samples: int, clips: int) -> str:
    given = str(dataset.specification.get("description") or "").strip()
    facts = f"{samples:,} simulated event-camera samples of {clips:,} videos with captions."
    return f"{given} {facts}".strip()


def _responsible_ai(dataset: StoredDataset) -> dict[str, Any]:
    words = {
        "dataCollection": "Simulated from videos by models of event cameras; nothing was recorded "
        "by an event camera. The .json of each sample names every setting.",
        "dataCollectionType": "Software Collection",
        "dataBiases": "The content follows the chosen prompts or videos and their generator.",
        "dataLimitations": "Simulated events lack what the model of the sensor leaves out. "
        "Captions are prompts; a video may show less.",
        "machineAnnotationTools": [f"texvent {dataset.facts.get('texvent_version', '')}".strip()],
    }
    return {f"rai:{name}": value for name, value in words.items()}


def _index_file(index: Path) -> dict[str, Any]:
    with index.open("rb") as file:
        sha256 = hashlib.file_digest(file, "sha256").hexdigest()
    return _file(index.name, "application/x-parquet", index.stat().st_size, sha256)


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


def _shard_files(dataset: StoredDataset) -> Iterator[dict[str, Any]]:
    for shard in dataset.shards():
        record = shard.record
        yield _file(shard.place, "application/x-tar", record.bytes, record.sha256)


def _file_sets(dataset: StoredDataset) -> Iterator[dict[str, Any]]:
    """What lies in the tars of each variant."""
    kinds = {"json": "application/json", "txt": "text/plain", "npy": "application/x-npy"}
    for variant in dataset.variants:
        places = [{"@id": shard.place} for shard in dataset.shards(variant)]
        for extension, kind in kinds.items():
            if places:
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
