"""Examples in docstrings, of the modules that have any."""

from __future__ import annotations

import doctest
import importlib
from pathlib import Path

import pytest

import mbla

PACKAGE = Path(mbla.__file__).parent
WITH_EXAMPLES = [path for path in sorted(PACKAGE.rglob("*.py")) if ">>> " in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize("path", WITH_EXAMPLES, ids=lambda path: path.stem)
def test_examples(path: Path) -> None:
    name = ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
    tried = doctest.testmod(importlib.import_module(name.removesuffix(".__init__")))
    assert tried.attempted > 0
    assert tried.failed == 0
