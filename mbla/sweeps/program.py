"""Which mbla this is, so that points of one sweep are all solved by the same one."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from mbla import __version__

PACKAGE = Path(__file__).parents[1]
LETTERS = 12
"""of the hash, 48 bits: it tells versions apart, it is no protection against a forged one"""
LIBRARIES = ("numpy", "scipy", "clarabel", "qdldl", "highspy", "shapely", "manifold3d", "cvxopt", "mkl")
"""libraries on which the last digits of an answer depend; the last two are used where they are found"""


@cache
def program_identity() -> str:
    """Version of mbla and hash of its sources, such as ``0.1.0+3f0a94c1d2e4``."""
    digest = hashlib.sha256()
    for path in sorted(PACKAGE.rglob("*.py"), key=lambda path: path.relative_to(PACKAGE).as_posix()):
        content = path.read_bytes()
        digest.update(f"{path.relative_to(PACKAGE).as_posix()} {len(content)}\n".encode())
        digest.update(content)
    return f"{__version__}+{digest.hexdigest()[:LETTERS]}"


def library_versions() -> dict[str, str]:
    """Version of each library; ``none`` for one that is not installed."""
    return {name: _version(name) for name in LIBRARIES}


def difference(ours: Mapping[str, str], theirs: Mapping[str, str]) -> str:
    """Versions that are not the same, in words; empty where all are."""
    names = [name for name in ours if theirs.get(name) != ours[name]]
    return ", ".join(f"its {name} is {theirs.get(name, 'none')}, here it is {ours[name]}" for name in names)


@cache
def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "none"
