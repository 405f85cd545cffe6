"""What a guard of kinds asks of the test of a kind, in words that say what to write."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from tests.decks.folder import ROOT


def check_tested(test: Path, name: str, uses: Sequence[str]) -> None:
    """Fails unless there is a test of a kind, in a file of its own, that uses the kind.

    uses : texts of which one stands in the file where it does
    """
    shown, wanted = test.relative_to(ROOT), f"write `def test_...` in it that uses {name} ({' or '.join(uses)})"
    assert test.exists(), f"{name} has no test: write {shown}, and {wanted}"
    text = test.read_text(encoding="utf-8")
    assert re.search(r"^def test_", text, re.MULTILINE), f"{shown} has no test: {wanted}"
    assert any(use in text for use in uses), f"{shown} does not use {name}: {wanted}"
