"""What produced a result: versions of the program and of the libraries that its numbers depend on, and the platform."""

from __future__ import annotations

import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version

from mbla import __version__

LIBRARIES = (
    "numpy",
    "scipy",
    "clarabel",
    "qdldl",
    "highspy",
    "shapely",
    "manifold3d",
    "meshio",
    "h5py",
    "pyyaml",
    "pydantic",
    "pint",
)

OPTIONAL = ("cvxopt",)
"""Libraries that are used where they are installed."""


def collect_provenance() -> dict[str, str]:
    """Versions and platform by name, read from the installed packages without importing them.

    Read once in a process, whose libraries stay the same: it takes as long as a fifth of a small run.
    """
    return dict(_found())


@cache
def _found() -> dict[str, str]:
    versions = {"mbla": __version__, "python": platform.python_version()}
    for library in (*LIBRARIES, *OPTIONAL):
        try:
            versions[library] = version(library)
        except PackageNotFoundError:
            versions[library] = "not installed"
    return versions | {"platform": platform.platform(), "machine": platform.machine()}
