"""Loads that spread in fill: closed forms on level and on bent tops, what goes beyond or sideways, rigid motions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from mbla.arrays import FloatArray
from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model

DECK = """mbla: 1
units: {{{units}}}
materials: {{stone: {{density: 2400}}, earth: {{density: 1800}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks:
{blocks}
contacts: {{joint: dry}}
supports: {supports}
vehicles: {{lorry: {{force: [0, 0, -60], axles: [{{behind: 3, force: [0, 0, -40]}}]{width}}}}}
fill: {{soil: {{on: row, material: earth, {top}, dispersal: {{{dispersal}}}}}}}
load_cases: {{push: {{dead: [{{gravity: none}}], live: [{{{load}}}]}}}}
"""
ROW = tuple(f"box: {{group: row, material: stone, min: [{x}, 0, 0], max: [{x + 1}, 2, 1]}}" for x in range(10))
ARCH = (
    "arch: {group: row, material: stone, shape: segmental, span: 8, rise: 2, thickness: 0.5, width: 2, voussoirs: 17, "
    "springers: ground}",
)
LINE = "line: {from: [4.3, 0, 9], to: [4.3, 2, 9], force_per_length: [0, 0, -50]}"
POINT = "travel: {force: [0, 0, -100], path: [[4.3, 1, 9], [5, 1, 9]], positions: 2}"
LAWS = {"boussinesq": "law: boussinesq, angle: 30", "uniform": "law: uniform, angle: 26.565051177077986"}


def model(
    folder: Path,
    load: str,
    *blocks: str,
    top: str = "level: 2.2",
    dispersal: str = "",
    supports: str = "[{ground: {z: 0}}]",
    units: str = "",
    width: str = "",
) -> Model:
    path = folder / "deck.yaml"
    lines = "\n".join(f"  - {block}" for block in blocks)
    text = DECK.format(
        blocks=lines,
        load=f"{load}, through: soil",
        top=top,
        dispersal=dispersal,
        supports=supports,
        units=units,
        width=width,
    )
    path.write_text(text)
    return build_model(read_deck(path))


def shares(found: Model, case: int = 0) -> FloatArray:
    """Vertical load on each block."""
    return np.asarray(-found.load_cases[case].live_load[:, 2])


def moment(found: Model, case: int = 0) -> float:
    """Of the vertical load about x = 0."""
    load = found.load_cases[case].live_load
    return float(load[:, 4].sum() - found.blocks.centroids[:, 0] @ load[:, 2])


def law_up_to(law: str, x: NDArray[np.floating], depth: FloatArray | float) -> FloatArray:
    """Share of a load left of x, at some depth."""
    if law == "uniform":
        return np.clip(x / depth + 0.5, 0, 1)  # 1:2
    alpha = np.pi / 6
    theta = np.clip(np.arctan2(x, depth), -alpha, alpha)
    strip = (theta + np.sin(theta) * np.cos(theta)) / np.pi
    most = (alpha + np.sin(alpha) * np.cos(alpha)) / np.pi
    return np.asarray((strip / most + 1) / 2)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("load", [LINE, POINT])
def test_on_a_level_top(tmp_path: Path, law: str, load: str) -> None:
    """The strip's formula on every block, the whole load, and its resultant where it stands."""
    found = model(tmp_path, load, *ROW, dispersal=LAWS[law])
    expected = 100 * np.diff(law_up_to(law, np.arange(11) - 4.3, 1.2))
    assert shares(found) == pytest.approx(expected, rel=1e-9, abs=1e-6)
    assert shares(found).sum() == pytest.approx(100, rel=1e-12)
    assert moment(found) == pytest.approx(430, rel=1e-8)
    assert not [notice for notice in found.notices if notice.identifier == "load-beyond-fill"]


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("load", [LINE, POINT])
@pytest.mark.parametrize("level", [2.9, 4.0])
def test_on_an_arch(tmp_path: Path, law: str, load: str, level: float) -> None:
    """Between the corners of the extrados goes what goes down between two slopes, whatever lies between them."""
    found = model(tmp_path, load, *ARCH, top=f"level: {level}", dispersal=LAWS[law], supports="[]")
    blocks = found.blocks
    corners = blocks.vertices.reshape(len(blocks), -1, 3)
    radius = np.hypot(corners[..., 0] - 4, corners[..., 2] + 3)
    outer = np.sort(corners[radius > 5.25].reshape(len(blocks), 4, 3), axis=1)
    ends = np.append(outer[:, 0, 0], outer[-1, -1, 0])
    heights = np.sqrt(5.5**2 - (ends - 4) ** 2) - 3
    expected = 100 * np.diff(law_up_to(law, ends - 4.3, level - heights))
    assert shares(found) == pytest.approx(expected, rel=1e-8, abs=1e-5)


def test_boussinesq_is_the_integral_of_the_stress(tmp_path: Path) -> None:
    """2 q z³ / (π (x² + z²)²) over the top of a block, divided by the same over all that lies within 30°."""
    found = model(tmp_path, LINE, *ROW)
    x = np.linspace(4, 5, 200001) - 4.3
    x = x[np.abs(x) <= 1.2 * np.tan(np.pi / 6)]
    stress = 2 * 1.2**3 / (np.pi * (x**2 + 1.2**2) ** 2)
    kept = (np.pi / 6 + np.sin(np.pi / 6) * np.cos(np.pi / 6)) * 2 / np.pi
    assert shares(found)[4] == pytest.approx(100 * np.trapezoid(stress, x) / kept, rel=1e-5)


def test_of_a_load_with_a_length(tmp_path: Path) -> None:
    """Uniform within 0.4 + 2 h tan 30°."""
    found = model(tmp_path, LINE, *ROW, dispersal="law: uniform, angle: 30, contact: 0.4")
    half = 0.2 + 1.2 * np.tan(np.pi / 6)
    expected = 100 * np.diff(np.clip((np.arange(11) - 4.3) / (2 * half) + 0.5, 0, 1))
    assert shares(found) == pytest.approx(expected, rel=1e-9, abs=1e-6)


def test_beyond_the_end(tmp_path: Path) -> None:
    """A load 0.2 m inside of the end: what goes left of it is not on the blocks, and a notice says how much."""
    found = model(tmp_path, LINE.replace("4.3", "0.2"), *ROW)
    left = float(law_up_to("boussinesq", np.array([-0.2]), 1.2)[0])
    assert shares(found).sum() == pytest.approx(100 * (1 - left), rel=1e-8)
    text = next(notice.message for notice in found.notices if notice.identifier == "load-beyond-fill")
    assert f"{100 * left:.3g} % of it" in text


def wall(group: str) -> str:
    """As high as the top, 0.2 m from the load at x = 0.2."""
    return f"box: {{group: {group}, material: stone, min: [-1, 0, 0], max: [0, 2, 2.2]}}"


@pytest.mark.parametrize("load", [LINE, POINT])
@pytest.mark.parametrize(
    ("group", "identifier", "name"), [("row", "load-towards-wall", "row[10]"), ("end", "load-off-fill", "end[0]")]
)
def test_a_wall_in_the_way(tmp_path: Path, load: str, group: str, identifier: str, name: str) -> None:
    """Nothing goes beyond where a wall stands, under the fill or not: the rest of the formula, in proportion."""
    found = model(tmp_path, load.replace("4.3", "0.2"), *ROW, wall(group))
    right = np.diff(law_up_to("boussinesq", np.arange(11) - 0.2, 1.2))
    assert shares(found) == pytest.approx(np.append(100 * right / right.sum(), 0), rel=1e-8, abs=1e-6)
    met, text = next((each.identifier, each.message) for each in found.notices if each.identifier != "material-unused")
    assert met == identifier
    assert f"{100 * (1 - right.sum()):.3g} % of it goes" in text
    assert name in text


def test_no_advice_to_add_what_is_there(tmp_path: Path) -> None:
    """A lower block of a wall that the fill is on already has no free upward face: told as of upright faces."""
    lower, upper = wall("row").replace("2.2]", "1.6]"), wall("row").replace("-1, 0, 0]", "-1, 0, 1.6]")
    found = model(tmp_path, LINE.replace("4.3", "0.2"), *ROW, lower, upper)
    said = {each.identifier: each.message for each in found.notices if each.identifier.startswith("load-")}
    assert list(said) == ["load-towards-wall"]
    assert "add them" not in said["load-towards-wall"]


def test_a_wall_beside_the_way(tmp_path: Path) -> None:
    """A wall next to the end of the row, where no line of the load goes, holds nothing back."""
    aside = wall("row").replace("[-1, 0, 0], max: [0, 2", "[-1, 2, 0], max: [0, 3")
    found = model(tmp_path, LINE.replace("4.3", "0.2"), *ROW, aside)
    assert shares(found).sum() == pytest.approx(100 * (1 - law_up_to("boussinesq", np.array([-0.2]), 1.2)[0]), rel=1e-8)


def test_an_axle_that_meets_a_block_from_beside(tmp_path: Path) -> None:
    """The second axle, 0.5 m outside of the row and above its end: left out, with a warning that names the block."""
    load = "vehicle: {name: lorry, at: [2.5, 1, 9]}"
    found = model(tmp_path, load, *ROW, top="level: 1.3", width=", width: 1")
    assert shares(found).sum() == pytest.approx(60, rel=1e-8)
    text = next(notice.message for notice in found.notices if notice.identifier == "load-off-fill")
    assert "row[0] from beside, and is left out" in text


def test_what_would_leave_sideways_is_kept(tmp_path: Path) -> None:
    """A force near the side of the row: the strip's formula along it all the same."""
    found = model(tmp_path, POINT.replace("1, 9", "0.1, 9"), *ROW)
    expected = 100 * np.diff(law_up_to("boussinesq", np.arange(11) - 4.3, 1.2))
    assert shares(found) == pytest.approx(expected, rel=1e-8, abs=1e-6)


def test_what_lies_behind_is_in_the_shade(tmp_path: Path) -> None:
    """A step 1 m high: lines that it stops do not reach the blocks behind it."""
    high = "box: {group: row, material: stone, min: [4, 0, 1], max: [4.5, 2, 2]}"
    found = model(tmp_path, LINE.replace("4.3", "4.2"), *ROW, high, top="level: 3", dispersal="law: uniform, angle: 45")
    on_step = 100 * (0.3 + 0.2) / 2
    assert shares(found)[-1] == pytest.approx(on_step, rel=1e-6)
    assert shares(found).sum() == pytest.approx(100, rel=1e-9)
    assert shares(found)[5:10].sum() == pytest.approx(100 * (1 - 0.4) / 2, rel=1e-6)


def test_on_a_dome(tmp_path: Path) -> None:
    """All of a force lands, on blocks of which none hides another, and a dome that is turned takes it alike."""
    dome = "dome: {group: row, material: stone, span: 8, thickness: 0.4, oculus: 0.6, rings: 8, segments: 20}"
    load = "travel: {force: [0, 0, -100], path: [[-2, 0.3, 9], [2, 0.3, 9]], positions: 5}"
    found = model(tmp_path, load, dome, top="level: 5")
    for case in range(5):
        assert shares(found, case).sum() == pytest.approx(100, rel=1e-9)
        assert np.isfinite(found.load_cases[case].live_load).all()
    turned = load.replace("[-2, 0.3, 9], [2, 0.3, 9]", "[-0.3, -2, 9], [-0.3, 2, 9]")
    other = model(tmp_path, turned, dome, top="level: 5")
    assert np.sort(shares(other, 2)) == pytest.approx(np.sort(shares(found, 2)), rel=1e-9, abs=1e-9)


def test_below_a_sloping_top(tmp_path: Path) -> None:
    """The depth is that under the load."""
    found = model(tmp_path, LINE, *ROW, top="surface: {point: [4.3, 0, 2.2], normal: [-0.1, 0, 1]}")
    level = model(tmp_path, LINE, *ROW)
    assert shares(found) == pytest.approx(shares(level), rel=1e-9, abs=1e-6)


def test_halves_of_a_skew_line_add_up(tmp_path: Path) -> None:
    """Below a top that slopes both ways the images of the joints are curves, which chords do not follow."""
    top, ends = "surface: {point: [0, 0, 1.6], normal: [-0.1, 0.1, 1]}", [(3.8, 0.9), (3.95, 1.0), (4.1, 1.1)]
    lines = [
        f"line: {{from: [{a[0]}, {a[1]}, 9], to: [{b[0]}, {b[1]}, 9], force_per_length: [0, 0, -1000]}}"
        for a, b in ((ends[0], ends[2]), (ends[0], ends[1]), (ends[1], ends[2]))
    ]
    whole, first, last = (shares(model(tmp_path, line, *ROW, top=top)) for line in lines)
    assert first + last == pytest.approx(whole, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("angle", [0.0, 33.0, 90.0])
def test_wherever_it_is(tmp_path: Path, angle: float) -> None:
    """The arch turned about an upright axis and moved, in other units: the same shares."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    ends = [1e3 * np.array([c * 4.3 - s * y, s * 4.3 + c * y, 9]) + [2000, -500, 300] for y in (0, 2)]
    rotate = f"{{rotate: {{axis: [0, 0, 1], angle: {angle}}}}}, {{translate: [2, -0.5, 0.3]}}, {{scale: 1000}}"
    moved = ARCH[0].replace("springers: ground}", f"springers: ground, transform: [{rotate}]}}")
    load = f"line: {{from: {ends[0].tolist()}, to: {ends[1].tolist()}, force_per_length: [0, 0, -0.05]}}"
    found = model(tmp_path, load, moved, top="level: 4300", supports="[]", units="length: mm")
    plain = model(tmp_path, LINE, *ARCH, top="level: 4", supports="[]")
    assert shares(found) == pytest.approx(shares(plain), rel=1e-9, abs=1e-7)


@pytest.mark.parametrize(
    ("load", "top", "words"),
    [
        ("line: {from: [4, 0, 9], to: [4, 2, 9], force_per_length: [1, 0, -50]}", "level: 2", "only vertical ones"),
        ("line: {from: [4, 0, 9], to: [4, 2.1, 9], force_per_length: [0, 0, -50]}", "level: 2", "beside the fill"),
        (
            "line: {from: [4, -1, 9], to: [4, 3, 9], force_per_length: [0, 0, -50]}",
            "level: 2",
            r"-1, 9\) .* shorten it",
        ),
        ("line: {from: [14, 0, 9], to: [14, 2, 9], force_per_length: [0, 0, -50]}", "level: 2", "goes beyond"),
        ("line: {from: [4, 1, 9], to: [4, 1, 8], force_per_length: [0, 0, -50]}", "level: 2", "must not run along"),
        ("vehicle: {name: lorry, at: [4, 1, 9], along: [0, 0, 1]}", "level: 2", "upright"),
        ("vehicle: {name: lorry, at: [-4, 1, 9]}", "level: 2", "all of it goes beyond"),
        ("travel: {force: [0, 0, -1], path: [[-4, 1, 2], [4, 1, 2]], positions: 3}", "level: 2", "position 1 of 3"),
        ("travel: {force: [0, 0, -1], path: [[4, 3, 2], [5, 3, 2]], positions: 3}", "level: 2", "beside the fill"),
        (
            LINE,
            "surface: {point: [5, 0, 1], normal: [-0.5, 0, 1]}",
            r"row\[4\] rises out of the fill",
        ),
    ],
)
def test_refused(tmp_path: Path, load: str, top: str, words: str) -> None:
    with pytest.raises(DeckError, match=words):
        model(tmp_path, load, *ROW, top=top)


def test_over_a_block_without_fill_refused(tmp_path: Path) -> None:
    """A deck of another group at the end of the row, as wide as all that the load reaches."""
    other = "box: {group: end, material: stone, min: [-3, 0, 0], max: [0, 2, 1]}"
    with pytest.raises(DeckError, match=r"stands over end\[0\], on which the fill soil does not lie"):
        model(tmp_path, LINE.replace("4.3", "-1"), *ROW, other)
