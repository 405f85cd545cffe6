from __future__ import annotations

from tests.decks.dome_mesh import FILE, mesh_text


def test_the_dome_is_the_one_that_the_generator_writes() -> None:
    assert FILE.read_text(encoding="utf-8") == mesh_text(), "python -m tests.decks.dome_mesh writes it again"
