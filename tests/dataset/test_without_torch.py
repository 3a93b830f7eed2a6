import importlib
import sys

import pytest

from texvent.errors import MissingDependencyError


def test_without_torch_the_dataset_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "torch.utils.data", None)
    monkeypatch.delitem(sys.modules, "texvent.dataset.loading.torch_loader", raising=False)
    with pytest.raises(MissingDependencyError, match=r"pip install 'texvent\[torch\]'"):
        importlib.import_module("texvent.dataset.loading.torch_loader")
