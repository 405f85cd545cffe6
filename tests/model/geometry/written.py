"""Mesh files as other programs leave them, written by meshio."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import meshio

from mbla.arrays import FloatArray


def write_mesh(path: Path, points: FloatArray, cells: Sequence[tuple[str, Any]], file_format: str = "vtu") -> None:
    """Points, (n, 3), and meshio's (type, rows of points) blocks of cells."""
    meshio.write(path, meshio.Mesh(points, list(cells)), file_format=file_format)
