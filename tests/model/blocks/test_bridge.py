from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from shapely.geometry import Polygon
from shapely.ops import unary_union

from mbla.arrays import FloatArray
from mbla.contacts import find_contacts
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.blocks.bridge import BridgeItem, generate
from mbla.model.blocks.generated import Generated, ItemContext, ItemRefused
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polyhedra import join_polyhedra
from tests.contacts.structures import blocks_of, model_of

SITE = ItemContext(1e-3, lambda path, name: Path(name))
WIDTH = 3.0
BASE: dict[str, Any] = {
    "material": "stone",
    "spans": [5.0, 7.0],
    "shape": "segmental",
    "rise": [1.4, 1.8],
    "thickness": 0.45,
    "voussoirs": [13, 16],
    "width": WIDTH,
    "piers": {"width": 1.6, "height": 2.5, "courses": 4},
    "abutments": {"width": 2.2, "height": 2.0, "courses": 3},
    "unit": [0.9, 0.4],
    "cover": 0.35,
}
SHAPES: dict[str, dict[str, Any]] = {
    "semicircular": {"rise": None},
    "segmental": {},
    "pointed": {"rise": [3.2, 4.5]},
    "elliptic": {},
    "catenary": {"rise": 2.0},
    "basket": {"rise": 1.9},
}
EDGES = {"spandrels": "edges", "spandrel_thickness": 0.6}
every_shape = pytest.mark.parametrize("shape", list(SHAPES))


def bridge(**keys: Any) -> Generated:
    return generate(BridgeItem.model_validate(BASE | keys), SITE)


def of_shape(shape: str, **keys: Any) -> Generated:
    return bridge(shape=shape, **(SHAPES[shape] | keys))


def blocks(made: Generated) -> Blocks:
    return blocks_of(join_polyhedra([part.polyhedra for part in made.parts]))


def sections(made: Generated, *members: str) -> list[FloatArray]:
    """Polygons in the x-z plane of the blocks of some members, or of all."""
    polygons = []
    for part in made.parts:
        if not members or part.member in members:
            starts = part.polyhedra.vertex_start
            for first, last in pairwise(starts.tolist()):
                half = (first + last) // 2
                polygons.append(part.polyhedra.vertices[half:last][:, [0, 2]])
    return polygons


def contacts_of(made: Generated) -> float:
    found = find_contacts(model_of(blocks(made), fixed=[0]), ContactsSection(joint="dry"))
    assert not found.report.notices, [notice.message for notice in found.report.notices]
    return float(found.areas.sum())


def openings(made: Generated, keys: dict[str, Any]) -> float:
    """Area under the chords of every intrados."""
    area, span = 0.0, 0
    for part in made.parts:
        if part.member == "voussoir":
            inner = np.array(sections(Generated((part,))), dtype=object)
            first_ring = [polygon for polygon, ring in zip(inner, part.labels["ring"], strict=True) if ring == 0]
            chain = [np.array(first_ring[0], dtype=float)[0]]
            for polygon in first_ring:
                corners = np.array(polygon, dtype=float)
                chain += list(corners[1 : len(corners) // 2])
            area += float(Polygon(chain).area)
            span += 1
    assert span == len(keys["spans"])
    return area


@every_shape
@pytest.mark.parametrize("rings", [1, 2])
def test_volume_is_a_rectangle_less_the_openings(shape: str, rings: int) -> None:
    keys = BASE | {"rings": rings}
    made = of_shape(shape, rings=rings)
    vertices = np.concatenate([part.polyhedra.vertices for part in made.parts])
    top, crown = vertices[:, 2].max(), max(p[:, 1].max() for p in sections(made, "voussoir"))
    assert top == pytest.approx(crown + 0.35)
    length = sum(keys["spans"]) + 1.6 + 2 * 2.2
    assert np.ptp(vertices[:, 0]) == pytest.approx(length)
    below = 1.6 * 2.5 + 2 * 2.2 * 2.0
    area = length * top + below - openings(made, keys)
    assert blocks(made).volumes.sum() == pytest.approx(area * WIDTH, rel=1e-12)


@every_shape
def test_no_gaps_no_overlaps_and_contacts_complete(shape: str) -> None:
    """In section every edge lies on the outline or is shared by two blocks: contacts are half of what is shared."""
    made = of_shape(shape)
    polygons = [Polygon(each) for each in sections(made)]
    assert all(each.is_valid for each in polygons)
    whole = unary_union([each.buffer(1e-7, join_style="mitre") for each in polygons]).buffer(-1e-7, join_style="mitre")
    assert whole.geom_type == "Polygon"
    assert not whole.interiors
    assert whole.area == pytest.approx(sum(each.area for each in polygons), rel=1e-6)
    shared = (sum(each.length for each in polygons) - whole.length) / 2
    assert contacts_of(made) == pytest.approx(shared * WIDTH, rel=1e-5)


def test_walls_along_both_faces_and_backing_between_them_fill_the_width() -> None:
    full = bridge()
    beds = int(next(part for part in full.parts if part.member == "spandrel").labels["course"].max()) + 1
    filled = bridge(**EDGES, backing=beds)
    assert blocks(filled).volumes.sum() == pytest.approx(blocks(full).volumes.sum(), rel=1e-12)
    masonry = sum(Polygon(each).area for each in sections(full, "spandrel"))
    assert contacts_of(filled) == pytest.approx(contacts_of(full) + 2 * masonry, rel=1e-9)


def test_backing_fills_the_lowest_courses_between_the_walls() -> None:
    made = bridge(**EDGES, backing=2)
    walls, backing = (next(part for part in made.parts if part.member == name) for name in ("spandrel", "backing"))
    assert set(backing.labels["course"].tolist()) == {0, 1}
    both = blocks_of(walls.polyhedra).volumes[walls.labels["course"] < 2].sum()
    assert blocks_of(backing.polyhedra).volumes.sum() == pytest.approx(both / 1.2 * (WIDTH - 1.2), rel=1e-12)
    assert walls.labels["leaf"].tolist() == np.repeat([0, 1], len(walls.polyhedra) // 2).tolist()
    far = blocks_of(walls.polyhedra).centroids[walls.labels["leaf"] == 1]
    assert far[:, 1] == pytest.approx(np.full(len(far), WIDTH - 0.3))


def test_parapets_stand_on_the_spandrels() -> None:
    made = bridge(parapets={"height": 0.8, "thickness": 0.3})
    parapets = next(part for part in made.parts if part.member == "parapet")
    length = 12.0 + 1.6 + 4.4
    assert blocks_of(parapets.polyhedra).volumes.sum() == pytest.approx(2 * length * 0.8 * 0.3, rel=1e-12)
    bare = bridge()
    joints = len(parapets.polyhedra) // 2 - 1
    beds = 2 * length * 0.3 + 2 * joints * 0.8 * 0.3
    assert contacts_of(made) == pytest.approx(contacts_of(bare) + beds, rel=1e-9)


def test_one_span_between_abutments_that_start_at_the_springings() -> None:
    made = bridge(spans=[6.0], rise=1.5, voussoirs=15, piers=None, abutments={"width": 1.5})
    assert {part.member for part in made.parts} == {"voussoir", "springer", "spandrel"}
    assert np.concatenate([part.polyhedra.vertices for part in made.parts])[:, 2].min() == 0.0


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("voussoirs", [14, 15])
def test_a_symmetric_bridge_has_symmetric_blocks(count: int, voussoirs: int) -> None:
    piers = BASE["piers"] if count > 1 else None
    made = bridge(spans=[6.0] * count, rise=1.7, voussoirs=voussoirs, piers=piers)
    found = blocks(made)
    length = 6.0 * count + 1.6 * (count - 1)
    mirrored = np.column_stack([length - found.centroids[:, 0], found.centroids[:, 2], found.volumes])
    own = np.column_stack([found.centroids[:, 0], found.centroids[:, 2], found.volumes])
    distances = np.linalg.norm(own[:, None] - mirrored[None], axis=2)
    assert distances.min(axis=1).max() < 1e-9


@pytest.mark.every(4)
@pytest.mark.parametrize("seed", [*range(6), 24, 125, 257, 299])
def test_bridges_of_any_size_have_no_slivers(seed: int) -> None:
    """Lengths in any proportion: blocks are closed, contacts complete, the smallest piece not absurdly small."""
    random = np.random.default_rng(seed)
    spans = random.uniform(3, 12, random.integers(1, 4)).round(2).tolist()
    rise = [float(span * random.uniform(0.15, 0.49)) for span in spans]
    thickness = float(random.uniform(0.25, 0.6))
    piers = {"width": 3 * thickness, "height": 2.0, "courses": 3} if len(spans) > 1 else None
    unit = [float(random.uniform(0.5, 1.2)), float(random.uniform(0.2, 0.5))]
    cover = float(random.uniform(0.2, 0.9))
    made = bridge(
        spans=spans,
        rise=rise,
        voussoirs=[int(random.integers(9, 25)) for _ in spans],
        thickness=thickness,
        piers=piers,
        abutments={"width": thickness * float(random.uniform(1.5, 5.0))},
        unit=unit,
        cover=cover,
        shape=["segmental", "elliptic", "catenary"][seed % 3],
    )
    polygons = [Polygon(each) for each in sections(made)]
    whole = unary_union([each.buffer(1e-7, join_style="mitre") for each in polygons]).buffer(-1e-7, join_style="mitre")
    assert whole.geom_type == "Polygon"
    assert not whole.interiors
    assert whole.area == pytest.approx(sum(each.area for each in polygons), rel=1e-6)
    shared = (sum(each.length for each in polygons) - whole.length) / 2
    assert contacts_of(made) == pytest.approx(shared * WIDTH, rel=1e-4)
    pieces = [Polygon(each).area for each in sections(made, "spandrel")]
    assert min(pieces) > 0.03 * unit[0] * min(unit[1], cover)


def test_units_of_length_do_not_matter() -> None:
    large = bridge(
        spans=[5000.0, 7000.0],
        rise=[1400.0, 1800.0],
        thickness=450.0,
        width=3000.0,
        piers={"width": 1600.0, "height": 2500.0, "courses": 4},
        abutments={"width": 2200.0, "height": 2000.0, "courses": 3},
        unit=[900.0, 400.0],
        cover=350.0,
    )
    for one, other in zip(bridge().parts, large.parts, strict=True):
        assert other.polyhedra.vertices / 1000 == pytest.approx(one.polyhedra.vertices, abs=1e-9)


@pytest.mark.parametrize(
    ("keys", "path"),
    [
        ({"piers": {"width": 0.5, "height": 2.5, "courses": 4}}, ("piers", "width")),
        ({"abutments": {"width": 0.2}}, ("abutments", "width")),
        ({"voussoirs": 1, "shape": "semicircular", "rise": None}, ("voussoirs",)),
        ({"voussoirs": [13, 1], "shape": "semicircular", "rise": None}, ("voussoirs", 1)),
        ({"rise": [1.4, 3.49]}, ("rise", 1)),
    ],
)
def test_refused(keys: dict[str, Any], path: tuple[str | int, ...]) -> None:
    with pytest.raises(ItemRefused) as caught:
        bridge(**keys)
    assert [found for found, _ in caught.value.findings] == [path]
