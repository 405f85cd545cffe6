"""MKL is looked for, tried apart, and used for the largest programs alone; nothing here needs it to be installed."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from types import SimpleNamespace

import pytest

from mbla.solution.linear_algebra import mkl


@pytest.fixture(autouse=True)
def searched_afresh() -> Iterator[None]:
    mkl.mkl_works.cache_clear()
    yield
    mkl.mkl_works.cache_clear()


def installed(folder: Path, *names: str) -> SimpleNamespace:
    """A package with empty files of those names."""
    for name in names:
        (folder / name).touch()
    files = [SimpleNamespace(name=name, locate=lambda name=name: folder / name) for name in names]
    return SimpleNamespace(files=files)


def test_small_programs_do_not_even_look_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mkl, "mkl_library", lambda: pytest.fail("looked for"))
    assert mkl.factorization_for(mkl.UNKNOWNS - 1) == "qdldl"


@pytest.mark.parametrize(
    ("works", "threads", "name"), [(True, "1", "mkl"), (False, "1", "qdldl"), (True, "2", "qdldl")]
)
def test_large_programs_take_it_where_it_works(
    works: bool, threads: str, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And on one thread: on several its answers to the cone solver were wrong."""
    monkeypatch.setattr(mkl, "mkl_works", lambda: works)
    monkeypatch.setenv("MKL_NUM_THREADS", threads)
    assert mkl.factorization_for(mkl.UNKNOWNS) == name


@pytest.mark.parametrize(("threads", "layer"), [("1", "SEQUENTIAL"), ("3", "INTEL"), ("many", "SEQUENTIAL")])
def test_the_layer_of_threads_is_that_of_their_number(
    threads: str, layer: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MKL_NUM_THREADS", threads)
    assert mkl.layer_of_threads() == layer


def test_the_library_is_found_under_a_name_with_a_version(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(platform, "machine", lambda: "x86_64")
    package = installed(tmp_path, "libmkl_core.so.3", "libmkl_rt.so.3", "libiomp5.so", "libother.so")
    monkeypatch.setattr(mkl, "distribution", lambda name: package)
    library = mkl.mkl_library()
    assert library is not None
    assert library == (tmp_path / "libmkl_rt.so.3").resolve()
    links = mkl._directory_of_links(library)
    assert {path.name for path in links.iterdir()} == {
        "libmkl_core.so.3",
        "libmkl_rt.so.3",
        "libmkl_rt.so",
        "libiomp5.so",
    }


def test_a_library_that_cannot_be_loaded_is_not_used(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """An empty file in its place: the trial fails in its own process, and nothing of it stays behind."""
    installed(tmp_path, "libmkl_rt.so.3")
    monkeypatch.setattr(mkl, "mkl_library", lambda: tmp_path / "libmkl_rt.so.3")
    monkeypatch.delenv("MKL_PARDISO_PATH", raising=False)
    assert not mkl.mkl_works()
    assert "MKL_PARDISO_PATH" not in os.environ


def test_where_the_package_is_missing_there_is_no_library(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> None:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(mkl, "distribution", missing)
    assert mkl.mkl_library() is None
    assert not mkl.mkl_works()
