"""What is installed with mbla, and why: the list in the README, written from installed metadata.

::

    python -m tests.trust.supply.dependencies

Reasons of direct dependencies stand in the table of the README, those of the others follow: who asks for them.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.metadata import Distribution, PackageNotFoundError, distribution

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.decks.folder import ROOT

README = ROOT / "README.md"
BEGIN, END = "<!-- installed:begin -->\n", "<!-- installed:end -->\n"
EXTRAS = ("mkl", "cholmod", "pictures", "report", "tables", "dask")
"""those of users; the others are for tests and benchmarks"""
CLASSIFIER = "License :: "
LONG = 50
"""characters; a licence that is longer is its full text, whose first line names it"""


@dataclass(frozen=True)
class Installed:
    """A package that comes with mbla.

    licence  : as its metadata say; empty where it is not installed here
    asked_by : names of the packages that ask for it; ``mbla``, or ``mbla[extra]``
    """

    name: str
    licence: str
    asked_by: tuple[str, ...]


@cache
def project() -> dict[str, list[str]]:
    """Requirements by who asks: ``mbla`` and ``mbla[extra]``."""
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return {"mbla": declared["dependencies"]} | {
        f"mbla[{extra}]": declared["optional-dependencies"][extra] for extra in EXTRAS
    }


def installed() -> list[Installed]:
    """All that a user may get, by name: direct dependencies and what these ask for."""
    asked: dict[str, set[str]] = {}
    waiting = [(asker, Requirement(text)) for asker, texts in project().items() for text in texts]
    seen: set[tuple[str, str]] = set()
    while waiting:
        asker, requirement = waiting.pop()
        name = canonicalize_name(requirement.name)
        asked.setdefault(name, set()).add(asker)
        for extra in ("", *requirement.extras):
            if (name, extra) not in seen:
                seen.add((name, extra))
                waiting += [(name, further) for further in _requirements(name, extra)]
    return [Installed(name, _licence(name), tuple(sorted(asked[name]))) for name in sorted(asked)]


def _found(name: str) -> Distribution | None:
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None


def _requirements(name: str, extra: str) -> Iterator[Requirement]:
    """What a package asks for on this machine, with the extra alone where one is given."""
    found = _found(name)
    for text in (found.requires or ()) if found else ():
        requirement = Requirement(text)
        marker = requirement.marker
        if marker is None:
            if not extra:
                yield requirement
        elif marker.evaluate({"extra": extra}) and not (extra and marker.evaluate({"extra": ""})):
            yield requirement


def _licence(name: str) -> str:
    """From the expression, else the classifiers, else the field of old metadata."""
    found = _found(name)
    if found is None:
        return ""
    about = found.metadata
    classifiers = [text.split(" :: ")[-1] for text in about.get_all("Classifier", []) if text.startswith(CLASSIFIER)]
    field = (" ".join(about.get_all("License", []))).strip().splitlines()
    short = field[0] if field and len(field[0]) <= LONG else ""
    named = [text for text in classifiers if text != "OSI Approved"]
    return " ".join(about.get_all("License-Expression", [])) or ", ".join(dict.fromkeys(named)) or short or "not stated"


def table() -> str:
    """A line for each package."""
    lines = ["| package | licence, as it states | asked for by |", "|---|---|---|"]
    for package in installed():
        licence = package.licence or "not installed where this was written: see the table above"
        lines.append(f"| {package.name} | {licence} | {', '.join(package.asked_by)} |")
    return "\n".join(lines) + "\n"


def listed() -> dict[str, str]:
    """Who asks for each package of the README's list."""
    section = README.read_text(encoding="utf-8").split(BEGIN, 1)[1].split(END, 1)[0]
    return {cells[1]: cells[3] for line in section.splitlines()[2:] if (cells := re.split(r" *\| *", line))}


def reasons() -> str:
    """The table above the list: names, licences and reasons of direct dependencies."""
    readme = README.read_text(encoding="utf-8")
    return readme.split("## Dependencies", 1)[1].split(BEGIN, 1)[0]


def write() -> None:
    """Put the list in place of the one that is there."""
    text = README.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN, 1)
    README.write_text(before + BEGIN + table() + END + rest.split(END, 1)[1], encoding="utf-8")


if __name__ == "__main__":
    write()
