"""What the base deck of a sweep gives, and what the key of a point depends on; faults are in tests/invalid_sweeps."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.deck.parameter_keys import path_of_key, unit_of
from mbla.errors import DeckError
from mbla.model.blocks.arch import ArchItem
from mbla.sweeps.base import Base, check_points
from mbla.sweeps.design.build import design_of
from mbla.sweeps.design.design import DesignPoint
from mbla.sweeps.identity import PointKeys, fingerprint_of, key_hash
from mbla.sweeps.plan import override_texts
from tests.deck.decks import write
from tests.sweeps.file.sweeps import ALL_WAYS, ARCH, GOOD, base_of


@pytest.fixture
def base(tmp_path: Path) -> Base:
    return base_of(tmp_path, ALL_WAYS)


def test_paths_units_vectors(base: Base) -> None:
    assert base.paths["t"] == (("parameters", "t"),)
    assert base.paths["n"] == (("blocks", 0, "arch", "voussoirs"),)
    assert base.paths["joints.dry.cohesion"] == (("joints", "dry", "cohesion"),)
    assert base.units == {
        "mu": "",
        "t": "m",  # a parameter of the deck has no unit there: this one is of the sweep file
        "n": "",
        "joints.dry.cohesion": "N/m^2",
        "tension": "N/m^2",
        "density": "kg/m^3",
        "radius": "",
        "d": "degree",
        "g": "degree",
        "law": "",
    }
    assert base.vectors == {"d": (1.0, 0.0, 0.0), "g": (0.0, 0.0, -1.0)}
    assert base.sources.known == {"mu": 0.65, "radius": 1.0, "t": 0.15, "spare": 1}
    assert base.cases == ("down", "push_x")
    assert base.fixed == ("blocks.0.arch.width=0.4", 'analysis.accuracy="draft"')
    arch = base.deck.content.blocks[0].item
    assert isinstance(arch, ArchItem)
    assert arch.width == 0.4


@pytest.mark.parametrize(
    ("key", "unit"),
    [
        ("joints.dry.cohesion", "N/cm^2"),
        ("blocks.0.arch.thickness", "cm"),
        ("materials.stone.unit_weight", "N/cm^3"),
        ("load_cases.push_x.live.0.acceleration", ""),
        ("load_cases.push_x.live.0.force", "N"),
        ("load_cases.push_x.live.0.on", ""),  # a section, or the name of a group in its place
        ("analysis.time_limit", "s"),
        ("parameters.t", ""),
    ],
)
def test_unit_of_key(tmp_path: Path, key: str, unit: str) -> None:
    base = base_of(tmp_path, GOOD, ARCH + "units: {length: cm}\n")
    assert unit_of([path_of_key(base.tree.data, key)], base.deck.units) == unit


@pytest.mark.parametrize(
    ("override", "expected"),
    [
        ("blocks.0.arch.width=-1", "--set:2:21 blocks[0].arch.width = -1: must be > 0"),
        ("blocks.0.arch.with=1", "--set:2:1 blocks[0].arch.with = 1: unknown key; the key reference"),
        ("parameters.t=0.3", "--set:2:1 parameters.t: has no effect: parameter t of the sweep sets it in every point"),
        ("nothing", "--set:2:1 nothing: must be key.path=value, on one line: there is no ="),
    ],
)
def test_faults_of_the_command_line_are_told_there(tmp_path: Path, override: str, expected: str) -> None:
    """They count from 1 as the user gave them, whatever ``set`` brings before."""
    text = GOOD + "set: {materials.stone.density: 1900, title: x}\n"
    if "with=" in override:
        expected = expected.split(";")[0]
    with pytest.raises(DeckError) as caught:
        base_of(tmp_path, text, ARCH, "blocks.0.arch.voussoirs=10", override)
    assert [str(fault).split("; did")[0] for fault in caught.value.faults] == [expected]


def test_what_another_parameter_brings_into_use_has_an_effect(tmp_path: Path) -> None:
    """The joint law mortar alone changes nothing: tests/invalid_sweeps."""
    text = """mbla_sweep: 1
deck: deck.yaml
parameters:
  mortar: {key: joints.mortar.friction, values: [0.4, 0.5]}
  law: {key: contacts.joint, values: [dry, mortar]}
  spare: {values: [1, 2]}
  w: {key: blocks.0.arch.width, values: [0.2, "=spare/2"]}
"""
    assert base_of(tmp_path, text).units["w"] == ""


def points_of(base: Base) -> tuple[DesignPoint, ...]:
    return design_of(base.sources).points


def test_a_sweep_of_which_no_point_can_be_read_is_refused(tmp_path: Path) -> None:
    """The joint law has a friction angle: a friction beside it breaks a rule at every point."""
    text = GOOD.replace("  mu: {", "  mu: {key: joints.dry.friction, ")
    base = base_of(tmp_path, text, ARCH.replace('dry: {friction: "=mu"}', "dry: {friction_angle: 30}"))
    with pytest.raises(DeckError) as caught:
        check_points(base, points_of(base))
    assert [str(fault) for fault in caught.value.faults] == [
        f"{tmp_path}/sweep.yaml:4:1 parameters: the deck is refused at the first, middle and last point: "
        "joints.dry.friction_angle: only one of friction or friction_angle may be given, here are friction and "
        "friction_angle"
    ]


def test_a_sweep_with_a_corner_that_cannot_be_read_begins(tmp_path: Path) -> None:
    """An arch of radius 1 cannot be thicker than twice that; such points fail on their own, with their reason."""
    base = base_of(tmp_path, GOOD.replace("[0.1, 0.15, 0.2]", "[3, 0.15, 0.2]"))
    points = points_of(base)
    check_points(base, points)
    with pytest.raises(DeckError, match="the deck is refused at the only point: "):
        check_points(base, points[:1])


# --- fingerprint --------------------------------------------------------------------------------------------------


def fingerprint(folder: Path, deck: str, *overrides: str) -> str:
    return fingerprint_of(write(folder, deck), overrides)


SAME = {
    "comments": lambda deck: deck.replace("mbla: 1", "# other words\nmbla: 1"),
    "layout": lambda deck: deck.replace("  stone: {density: 2000}", "  stone:\n      density:   2000"),
    "title": lambda deck: deck.replace("title: Semi", "title: Demi"),
    "output": lambda deck: deck + "output: {vtu: false}\n",
    "expected": lambda deck: deck + "expected: {push_x: {load_factor: 1, source: none}}\n",
    "order of keys": lambda deck: deck.replace("      width: 0.3\n", "").replace(
        "      group: arch\n", "      width: 0.3\n      group: arch\n"
    ),
}
OTHER = {
    "a value": lambda deck: deck.replace("density: 2000", "density: 2001"),
    "last bit": lambda deck: deck.replace("width: 0.3", "width: 0.30000000000000004"),
    "a parameter": lambda deck: deck.replace("t: 0.15", "t: 0.16"),
    "a section": lambda deck: deck + "analysis: {accuracy: draft}\n",
    "order of a list": lambda deck: deck.replace("[0, 0, -1]", "[0, -1, 0]"),
}


@pytest.mark.parametrize("change", SAME.values(), ids=SAME)
def test_what_does_not_count(tmp_path: Path, change: Callable[[str], str]) -> None:
    assert change(ARCH) != ARCH
    assert fingerprint(tmp_path, change(ARCH)) == fingerprint(tmp_path, ARCH)


@pytest.mark.parametrize("change", OTHER.values(), ids=OTHER)
def test_what_counts(tmp_path: Path, change: Callable[[str], str]) -> None:
    assert change(ARCH) != ARCH
    assert fingerprint(tmp_path, change(ARCH)) != fingerprint(tmp_path, ARCH)


# --- keys of points -----------------------------------------------------------------------------------------------


def keys_of(base: Base) -> PointKeys:
    return PointKeys(base.fingerprint, base.deck)


def test_keys_of_points(base: Base) -> None:
    keys = {
        keys_of(base).of(settings)
        for settings in (
            {},
            {"parameters.mu": 0.3},
            {"parameters.mu": 0.30000000000000004},
            {"parameters.t": 0.3},
            {"parameters.mu": 0.3, "parameters.t": 0.3},
            {"parameters.mu": "0.3"},
        )
    }
    assert len(keys) == 6
    assert all(len(key) == 64 for key in keys)
    assert keys_of(base).of({"parameters.t": 0.1, "parameters.mu": 0.3}) == keys_of(base).of(
        {"parameters.mu": 0.3, "parameters.t": 0.1}
    )


def test_the_key_of_a_point_is_the_same_for_good() -> None:
    """In every process and on every machine, as the fingerprint above."""
    key = key_hash("0" * 64, {"parameters.t": 0.1, "parameters.mu": 1e-7, "a": [1, "\N{DEGREE SIGN}", True]}, ["b"])
    assert key == "0de9e83a32792b65751b87c50e1c9fe672d67d496e30b0085b323d014e773f6a"


TABLE = "group,index,fx,fy,fz\narch,10,0,0,{force}\n"
TABLE_DECK = ARCH.replace("live: [{acceleration: [1, 0, 0]}]", "live: [{table: loads.csv}]")
TABLE_SWEEP = """mbla_sweep: 1
deck: deck.yaml
parameters:
  loads: {key: load_cases.push_x.live.0.table, values: [loads.csv, more.csv]}
  live: {key: load_cases.down.live, values: [[{table: loads.csv}], [{table: more.csv}]]}
"""


def with_tables(folder: Path, first: int, second: int) -> Base:
    write(folder, TABLE.format(force=first), "loads.csv")
    write(folder, TABLE.format(force=second), "more.csv")
    return base_of(folder, TABLE_SWEEP, TABLE_DECK)


def test_files_that_the_deck_names_count(tmp_path: Path) -> None:
    same = [with_tables(tmp_path / name, -1, -2).fingerprint for name in "ab"]
    assert same[0] == same[1] != with_tables(tmp_path / "c", -3, -2).fingerprint


@pytest.mark.parametrize(
    "settings", [{"load_cases.push_x.live.0.table": "more.csv"}, {"load_cases.down.live": [{"table": "more.csv"}]}]
)
def test_files_that_a_point_names_count(tmp_path: Path, settings: dict[str, object]) -> None:
    a, b = with_tables(tmp_path / "a", -1, -2), with_tables(tmp_path / "b", -1, -3)
    assert a.fingerprint == b.fingerprint
    assert keys_of(a).of(settings) != keys_of(b).of(settings)
    assert keys_of(a).of({"parameters.mu": 1.0}) == keys_of(b).of({"parameters.mu": 1.0})


def test_files_that_a_setting_of_a_study_names_count(tmp_path: Path) -> None:
    """In a load case that the deck does not have, too."""
    settings = {"load_cases.interact": {"live": [{"table": "more.csv"}]}}
    decks = [with_tables(tmp_path / name, -1, force).deck for name, force in (("a", -2), ("b", -2), ("c", -3))]
    first, same, other = (PointKeys("0" * 64, deck).of(settings) for deck in decks)
    assert first == same != other


@pytest.mark.parametrize("text", ["\N{GRINNING FACE}", "a\x85b", "a\u2028b", 'q"\\', "tab\tx", "=mu", "no", "1e3", "é"])
def test_texts_of_settings_are_read_back(tmp_path: Path, text: str) -> None:
    """JSON writes some characters so that YAML reads them otherwise."""
    deck = read_deck(
        write(tmp_path, ARCH), override_texts({"expected": {"push_x": {"load_factor": 1, "source": text}}})
    )
    assert deck.content.expected["push_x"].source == text
