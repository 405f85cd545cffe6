from __future__ import annotations

import json
from pathlib import Path

from mbla.model.geometry.geometry import companions


def test_buffers_of_a_gltf(tmp_path: Path) -> None:
    """Those in files beside it; not those inside it, and not what is missing, which its reader tells."""
    (tmp_path / "two parts.bin").write_bytes(b"x")
    uris = ["two%20parts.bin", "data:application/octet-stream;base64,AA==", "none.bin"]
    buffers = [*({"uri": uri, "byteLength": 1} for uri in uris), {"byteLength": 1}]
    path = tmp_path / "vault.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, "buffers": buffers}), encoding="utf-8")
    assert companions(path) == [tmp_path.resolve() / "two parts.bin"]


def test_none_for_others_and_for_what_cannot_be_read(tmp_path: Path) -> None:
    for name, text in (("a.obj", "v 0 0 0"), ("b.gltf", "no"), ("c.gltf", "[]"), ("d.gltf", '{"buffers": 3}')):
        (tmp_path / name).write_text(text, encoding="utf-8")
        assert companions(tmp_path / name) == []
    (tmp_path / "folder.gltf").mkdir()
    assert companions(tmp_path / "folder.gltf") == []
