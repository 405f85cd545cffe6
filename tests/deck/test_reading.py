from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mbla.deck import read_deck
from mbla.errors import DeckError, Fault, Message, Place
from mbla.model.blocks.box import BoxItem
from mbla.model.blocks.wall import WallItem
from tests.deck.decks import BLOCK, changed, write

COMPLETE = """mbla: 1                                  # deck format version, required
title: Running-bond wall with an opening, pushed in its plane
units: {length: m, force: N, mass: kg}   # the default; also mm cm ft in / kN MN lbf kip / t lb
parameters: {mu: 0.65, n: 5}             # used as "=..." anywhere below; `--set parameters.mu=0.5` overrides

materials:
  stone: {density: 2000}                 # or unit_weight: "18 kN/m^3" (a string with a unit is converted)
joints:                                  # joint laws; `dry` is only a name
  dry: {friction: "=mu"}                 # or friction_angle: 33 (degrees)

blocks:                                  # a list; each item has one key, its kind
  - wall:
      group: facade                      # selectors use groups
      material: stone
      unit: [0.40, 0.20, 0.175]          # length along the wall, thickness, height
      length: "=n*0.4"                   # runs along +x from the origin, rises along +z, thickness along +y
      courses: 6
      bond: running                      # half-unit offset; `start: half` begins the bottom course with a half unit
      openings: [{from: [0.8, 0.35], to: [1.2, 0.875]}]   # in the wall's plane; none by default
  - box: {group: lintel, material: stone, min: [0, 0, 1.05], max: [2, 0.2, 1.2]}

contacts: {joint: dry, tolerance: 1.e-3}   # tolerance relative to block size

supports:
  - {ground: {z: 0}, joint: dry}           # rigid ground under every face that lies on the plane

load_cases:
  push_x:
    dead: [{gravity: [0, 0, -9.81]}]       # the default
    live: [{acceleration: [1, 0, 0]}]      # mass-proportional, in units of g = 9.81 m/s²: the load factor is a/g
  lintel_push:
    live: [{force: [1000, 0, 0], on: lintel, at: [0, 0.1, 1.125]}]

analysis:
  flow_rule: non_associative               # default; or associative, or dilatancy (angle taken from the joints)
  contact_model: concave                   # default: contact points; or convex: interface resultants
  accuracy: standard                       # draft | standard | reference
output: {vtu: true, frames: 11, plots: false}
"""

FRAGMENTS = """mbla: 1
materials: {stone: {unit_weight: "18 kN/m^3"}}
joints: {dry: {friction_angle: "0.5 rad"}, mortar: {friction: 0.8, cohesion: "50 kPa", tensile_strength: 2.e+4}}
blocks:
  - polyhedron:
      group: wedge
      material: stone
      vertices: [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]
      faces: [[0,1,2],[0,1,3],[0,2,3],[1,2,3]]
  - mesh: {group: vault, material: stone, file: crossvault.obj, scale: 0.01}
  - arch: {group: arch, material: stone, shape: semicircular, span: 4.0, thickness: 0.3, width: 1.0, voussoirs: 27}
  - arch:
      group: low
      material: stone
      shape: segmental
      span: 4
      rise: 0.5
      thickness: 0.3
      width: 1
      voussoirs: 9
      springers: blocks
  - box:
      group: base
      material: stone
      min: [0, 0, -1]
      max: [4, 1, 0]
      transform: [{rotate: {axis: [0, 0, 1], angle: 90}}, {scale: 2}]
  - box: {material: stone, min: [0, 0, 0], max: [1, 1, 1], transform: {mirror: {normal: [1, 0, 0]}}}
contacts: {joint: dry, overrides: [{between: [arch, base], joint: mortar}, {between: [ground, wedge], joint: mortar}]}
supports:
  - {blocks: base}
  - {blocks: [low_springers, {group: vault, index: 3}, {box: [[0, 0, 0], [1, 1, 1]]}]}
  - {ground: {point: [0, 0, 0], normal: [0, 1, 1]}, blocks: {group: wedge}}
load_cases:
  push_x:
    live: [{acceleration: [1, 0, 0], on: [vault, arch]}]
expected:
  push_x: {load_factor: 0.643, tolerance: 1.e-3, source: "doi:..."}
"""


def test_complete_deck(tmp_path: Path) -> None:
    deck = read_deck(write(tmp_path, COMPLETE))
    wall = deck.content.blocks[0].item
    assert isinstance(wall, WallItem)
    assert wall.length == 2.0
    assert deck.content.joints["dry"].friction == 0.65
    assert deck.content.load_cases["lintel_push"].dead is None
    assert deck.notices == ()


def test_fragments(tmp_path: Path) -> None:
    content = read_deck(write(tmp_path, FRAGMENTS)).content
    assert content.materials["stone"].unit_weight == 18e3
    assert content.joints["dry"].friction_angle == pytest.approx(28.64788975654116)
    assert content.joints["mortar"].cohesion == 50e3
    assert [item.kind for item in content.blocks] == [
        *("polyhedron", "mesh", "arch", "arch", "box", "box"),
    ]


def test_numbers_are_in_the_units_of_the_deck(tmp_path: Path) -> None:
    text = changed("length: m, force: N, mass: kg", "length: mm, force: kN, mass: t")
    deck = read_deck(write(tmp_path, text.replace("max: [1, 1, 1]", 'max: [1, "1 m", "=2*mu"]')))
    (item,) = deck.content.blocks
    assert isinstance(item.item, BoxItem)
    assert item.item.max == (1.0, 1000.0, 1.2)
    assert deck.units.length == "mm"


@pytest.mark.parametrize(("text", "count"), [('"=2*n"', 6), ('"=0.3/0.1"', 3), ("6.0", 6), ("6e0", 6)])
def test_counts_from_expressions(tmp_path: Path, text: str, count: int) -> None:
    deck = COMPLETE.replace("n: 5", "n: 3").replace("courses: 6", f"courses: {text}")
    deck = deck.replace("openings: [{from: [0.8, 0.35], to: [1.2, 0.875]}]", "")
    wall = read_deck(write(tmp_path, deck)).content.blocks[0].item
    assert isinstance(wall, WallItem)
    assert wall.courses == count
    assert isinstance(wall.courses, int)


def test_hash_depends_on_the_texts_alone(tmp_path: Path) -> None:
    first = read_deck(write(tmp_path, BLOCK, "a.yaml"))
    assert read_deck(write(tmp_path, BLOCK, "sub/b.yaml")).sha256 == first.sha256
    assert len(first.sha256) == 64
    others = [
        read_deck(write(tmp_path, BLOCK + "# a remark\n")),
        read_deck(tmp_path / "a.yaml", ["parameters.mu=0.6"]),
        read_deck(tmp_path / "a.yaml", ["parameters.mu=0.5"]),
        read_deck(tmp_path / "a.yaml", ["parameters.mu=0.6", "parameters.mu=0.5"]),
    ]
    assert len({first.sha256, *(deck.sha256 for deck in others)}) == 5


def test_file_beside_the_deck(tmp_path: Path) -> None:
    deck = read_deck(write(tmp_path, FRAGMENTS))
    found = write(tmp_path, "v 0 0 0\n", "crossvault.obj")
    assert deck.resolve_file(("blocks", 1, "mesh", "file"), "crossvault.obj") == found.resolve()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("nowhere.obj", "does not exist"),
        ("folder.obj", "is not a regular file"),
        ("../outside.obj", "leads out of the folder tree of the file that names it"),
        ("link.obj", "leads out of the folder tree of the file that names it"),
        ("/etc/hosts", "must be a path relative to the file that names it"),
    ],
)
def test_files_that_are_refused(tmp_path: Path, name: str, message: str) -> None:
    outside = write(tmp_path, "", "outside.obj")
    path = write(tmp_path, FRAGMENTS.replace("crossvault.obj", name), "inside/deck.yaml")
    (path.parent / "folder.obj").mkdir()
    (path.parent / "link.obj").symlink_to(outside)
    deck = read_deck(path)
    with pytest.raises(DeckError) as caught:
        deck.resolve_file(("blocks", 1, "mesh", "file"), name)
    assert str(caught.value) == f"{path}:10:49 blocks[1].mesh.file = {name}: {message}"


def test_file_named_in_an_included_deck_is_beside_that_deck(tmp_path: Path) -> None:
    write(tmp_path, "blocks:\n  - mesh: {material: stone, file: vault.obj}\n", "sub/vault.yaml")
    found = write(tmp_path, "", "sub/vault.obj")
    deck = read_deck(write(tmp_path, changed("units:", "include: [sub/vault.yaml]\nunits:")))
    assert deck.resolve_file(("blocks", 0, "mesh", "file"), "vault.obj") == found.resolve()


PIECES = st.sampled_from(
    [*BLOCK.split(" "), "[", "]", "{", "}", "true", "-1", ".nan", "~", "=mu", '"=mu"', "x: 1", "\n", "- "]
)


@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.integers(0, len(BLOCK)), st.integers(0, 30), st.lists(PIECES, max_size=3).map(" ".join))
def test_damaged_deck_gives_nothing_but_faults(tmp_path: Path, at: int, length: int, piece: str) -> None:
    text = BLOCK[:at] + piece + BLOCK[at + length :]
    path = write(tmp_path, text)
    lines = text.count("\n") + 2
    assert all(fault.message and 1 <= fault.place.line <= lines for fault in _faults(path))


def _faults(path: Path) -> tuple[Fault, ...]:
    """Faults of a deck that may well have none; a refusal without faults would be one itself."""
    try:
        read_deck(path)
    except DeckError as error:
        return error.faults or (Fault(Place("", 0, 0), "", Message("not-yaml", "")),)
    return ()
