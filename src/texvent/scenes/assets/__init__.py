"""Models of one's own: folders of GLB, OBJ and PLY files as nouns."""

from texvent.scenes.assets.index import Asset, read_folder
from texvent.scenes.assets.nouns import (
    check_files,
    describe_file,
    list_files,
    load_model,
    merge_nouns,
    with_models,
)

__all__ = [
    "Asset",
    "check_files",
    "describe_file",
    "list_files",
    "load_model",
    "merge_nouns",
    "read_folder",
    "with_models",
]
