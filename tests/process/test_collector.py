"""The garbage collector is paused, given back as it was found, and passes over what was loaded."""

import gc
import sys
from pathlib import Path

import pytest

from mbla.process.collector import loading, no_collection


def _fail_within() -> None:
    with no_collection():
        assert not gc.isenabled()
        raise KeyError


@pytest.mark.parametrize("enabled", [True, False])
def test_the_collector_is_given_back_as_it_was(enabled: bool) -> None:
    was_enabled = gc.isenabled()
    try:
        (gc.enable if enabled else gc.disable)()
        with pytest.raises(KeyError):
            _fail_within()
        assert gc.isenabled() is enabled
    finally:
        (gc.enable if was_enabled else gc.disable)()


def test_what_is_loaded_is_passed_over_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a_module_to_be_loaded.py").write_text("held = [[] for _ in range(1000)]\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    try:
        before = gc.get_freeze_count()
        with loading():
            import json  # noqa: F401
        assert gc.get_freeze_count() == before  # it was there already
        with loading():
            import a_module_to_be_loaded  # type: ignore[import-not-found]  # noqa: F401
        assert gc.get_freeze_count() >= before + 1000
    finally:
        gc.unfreeze()
        sys.modules.pop("a_module_to_be_loaded", None)
