import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from mbla import __version__
from mbla.deck import read_deck
from mbla.deck.section import Section
from mbla.deck.sections.analysis import AnalysisSection
from mbla.deck.sections.contacts import ContactsSection
from mbla.results.provenance import LIBRARIES, collect_provenance, settings_in_words
from mbla.solution.settings import solver_settings
from tests.line import BLOCK


def test_every_library_has_a_version() -> None:
    provenance = collect_provenance()
    assert provenance["mbla"] == __version__
    assert all(provenance[library][0].isdigit() for library in LIBRARIES)
    assert provenance["platform"]


def test_no_library_is_imported_for_it() -> None:
    code = (
        "import sys; from mbla.results.provenance import collect_provenance; collect_provenance(); "
        "print([name for name in ('h5py', 'meshio', 'clarabel') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


OTHERS: dict[str, list[Any]] = {
    "analysis.flow_rule": ["associative"],
    "analysis.contact_model": ["convex"],
    "analysis.solver": ["clarabel"],
    "analysis.scheme": ["published"],
    "analysis.path.ratio": [0.5],
    "analysis.path.until": [60],
    "analysis.published.slope": [0.1],
    "analysis.published.averaging": [0.5],
    "analysis.published.tolerance": [1e-3],
    "analysis.published.max_programs": [50],
    "analysis.search": [1, 2],
    "analysis.standing": [False],
    "analysis.sensitivity": [True, ["joints.dry.friction"]],
    "analysis.torsion": [False],
    "analysis.geometric_safety": [True],
    "analysis.soil_range": [True],
    "analysis.reductions": [False],
    "analysis.accuracy": ["draft"],
    "analysis.tolerance": [1e-8],
    "analysis.gap": [1e-6],
    "analysis.residual": [1e-5],
    "analysis.max_iterations": [100],
    "analysis.time_limit": [60],
    "contacts.tolerance": [0.01],
    "contacts.overlap_tolerance": [0.01],
    "contacts.joint_thickness": [0.01],
    "contacts.table": ["table.csv"],
    "contacts.isolated": ["allow"],
    "contacts.points.per_edge": [2],
    "contacts.points.spacing": [0.1],
    "contacts.points.inset": [0.1],
    "contacts.points.rounding": [0.1],
}
"""key paths of settings -> values that are not those by default"""
OF_MODEL = {"contacts.joint", "contacts.overrides"}
"""keys whose effect stands in arrays: the joint law of each interface"""


def keys_of(section: type[Section], place: str) -> Iterator[str]:
    """Key paths of a section and of those below it."""
    for name, field in section.model_fields.items():
        below = field.annotation
        if isinstance(below, type) and issubclass(below, Section):
            yield from keys_of(below, f"{place}.{name}")
        else:
            yield f"{place}.{name}"


def test_no_setting_is_missed_here() -> None:
    sections: dict[str, type[Section]] = {"analysis": AnalysisSection, "contacts": ContactsSection}
    keys = {key for name, section in sections.items() for key in keys_of(section, name)}
    assert keys - OF_MODEL == set(OTHERS)


@pytest.mark.parametrize("key", OTHERS)
def test_settings_tell_each_key_that_decides_the_figures(key: str, tmp_path: Path) -> None:
    deck = yaml.safe_load(BLOCK)
    deck["analysis"] = {"scheme": "published"} if ".published." in key else {}
    *names, last = key.split(".")
    section = deck
    for name in names:
        section = section.setdefault(name, {})
    (tmp_path / "table.csv").write_text("interface,group_a,index_a,group_b,index_b,x,y,z\n", encoding="utf-8")
    found = [told_of(tmp_path / "deck.yaml", deck)]
    for value in OTHERS[key]:
        section[last] = value
        found.append(told_of(tmp_path / "deck.yaml", deck))
    assert all(one != other for row, one in enumerate(found) for other in found[:row])


def told_of(path: Path, deck: Any) -> dict[str, str]:
    """The settings in words of a deck that is written to a file and read."""
    path.write_text(yaml.safe_dump(deck), encoding="utf-8")
    read = read_deck(path)
    return settings_in_words(read, solver_settings(read.analysis))
