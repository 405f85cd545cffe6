"""Files that belong to a geometry file: the buffers of a glTF."""

from __future__ import annotations

import json
from pathlib import Path
from urllib.parse import unquote


def companions(path: Path) -> list[Path]:
    """Files that are read with a geometry file, in its order; none where it cannot be read, which its reader tells."""
    if path.suffix.lower() != ".gltf":
        return []
    try:
        document = json.loads(path.read_bytes())
        names = [
            unquote(each["uri"]) for each in document["buffers"] if not each.get("uri", "data:").startswith("data:")
        ]
        return [file for name in names if (file := (path.parent / name).resolve()).is_file()]
    except (OSError, RecursionError, ValueError, TypeError, KeyError, AttributeError):
        return []
