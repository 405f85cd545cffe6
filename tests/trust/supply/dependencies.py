"""What mbla asks for, itself and by its extras for users, and the page that says why."""

from __future__ import annotations

import tomllib
from functools import cache

from tests.decks.folder import ROOT

PAGE = ROOT / "schemas" / "dependencies.md"
EXTRAS = ("cholmod", "pictures", "report", "tables", "dask")
"""those of users; the others are for tests and benchmarks"""


@cache
def project() -> dict[str, list[str]]:
    """Requirements by who asks: ``mbla`` and ``mbla[extra]``."""
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return {"mbla": declared["dependencies"]} | {
        f"mbla[{extra}]": declared["optional-dependencies"][extra] for extra in EXTRAS
    }
