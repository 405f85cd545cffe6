"""Fill that holds blocks sideways: a wedge pushed into it and away from it, in closed form."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.pose import Pose
from mbla.model.ties.moved import TieHistory, moved_ties
from mbla.model.ties.ties import OUTSIDE
from mbla.solution.solution import Status
from tests.line import case_of

DECK = """mbla: 1
units: {{force: kN}}
materials: {{stone: {{unit_weight: 24}}, earth: {{unit_weight: 18}}}}
joints: {{dry: {{friction: 0.3}}}}
blocks:
  - polyhedron:
      group: wedge
      material: stone
      vertices: [[0,0,0],[6,0,0],[6,1,0],[0,1,0],[0,0,1],[4,0,1],[4,1,1],[0,1,1]]
      faces: [[0,3,2,1],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
fill:
  soil:
    on: wedge
    material: earth
    level: 1.5
    passive: {{friction_angle: 30, mobilisation: 0.5, cohesion: {cohesion}, cohesion_mobilisation: 0.1}}
load_cases:
  into: {{live: [{{force: [1, 0, 0], on: wedge, at: [3, 0.5, 0.1]}}]}}
  away: {{live: [{{force: [-1, 0, 0], on: wedge, at: [3, 0.5, 0.1]}}]}}
analysis: {{flow_rule: associative, accuracy: reference}}
"""
STONE, SOIL = 24 * 5.0, 18 * (0.5 * 4 + 2 * 1.0)
"""weights; the soil on the slope is 0.5 to 1.5 m deep"""
PRESSURE = 18 * (0.5 + 1.5) / 2 * 1.0
"""integral of the vertical stress over the height of the slope"""


def write(folder: Path, cohesion: float) -> Path:
    path = folder / "deck.yaml"
    path.write_text(DECK.format(cohesion=cohesion))
    return path


@pytest.mark.parametrize("cohesion", [0.0, 20.0])
def test_a_strut_on_the_slope(tmp_path: Path, cohesion: float) -> None:
    ties = build_model(read_deck(write(tmp_path, cohesion))).ties
    count = 2 if cohesion else 1  # none on the level top
    assert ties.forms == ("fill", "cohesion")[:count]
    cohesive = 0.1 * 2 * np.sqrt(3) * cohesion * 1.0
    assert ties.least == pytest.approx([-0.5 * 3 * PRESSURE, -cohesive][:count], rel=1e-12)
    assert ties.greatest == pytest.approx([-PRESSURE / 3, 0][:count], rel=1e-12)
    height = (1.5 + 2 * 0.5) / (1.5 + 0.5) / 3  # of a trapezium
    assert ties.places[0] == pytest.approx([6 - 2 * height, 0.5, height])
    assert ties.places[2 * count - 2] == pytest.approx([5, 0.5, 0.5] if cohesion else ties.places[0])
    assert ties.pulls[::2] == pytest.approx(np.array([[1, 0, 0]] * count))
    assert ties.bodies.tolist() == [0, OUTSIDE] * count
    assert ties.lengths.tolist() == [0.0] * count


def test_it_never_breaks_and_keeps_its_direction_as_the_block_moves(tmp_path: Path) -> None:
    """0.2 m into the soil and 0.3 m down: the push stays level, whatever the block has moved by."""
    model = build_model(read_deck(write(tmp_path, 0.0)))
    pose = Pose(np.array([[0.2, 0.0, -0.3]]), np.eye(3)[None])
    there = moved_ties(model.ties, model.blocks, pose)
    assert there.pulls == pytest.approx(model.ties.pulls)
    history = TieHistory.at_rest(model.ties).after(model.blocks, model.ties, np.array([[-0.2, 0, 0, 0, 0, 0.0]]), there)
    assert not history.broken(model.ties).any()


@pytest.mark.parametrize("flow", ["associative", "non_associative"])
def test_pushed_into_the_soil_and_away(flow: str) -> None:
    friction = 0.3 * (STONE + SOIL)
    for case, expected in enumerate((friction + 0.5 * 3 * PRESSURE, friction - PRESSURE / 3)):
        settings = f"analysis.flow_rule={flow}", "analysis.accuracy=standard"
        _, result = case_of(DECK.format(cohesion=0.0), *settings, case=case)
        assert result.status is Status.SOLVED
        assert result.solution.mechanics is not None
        assert result.solution.mechanics.load_factor == pytest.approx(expected, rel=1e-6)


BUTTRESS = """mbla: 1
materials: {{stone: {{density: 2000}}, soil: {{density: 1700}}}}
joints: {{dry: {{friction: 5}}}}
blocks:
  - polyhedron: {{group: a, material: stone, vertices: {vertices}, faces: {faces}}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
fill:
  soil: {{on: a, material: soil, level: {level}, passive: {{cohesion: {cohesion}, cohesion_mobilisation: 0.5}}}}
load_cases:
  over: {{live: [{{force: [{way}, 0, 0], on: a, at: [0.1, 0.25, 0.9]}}]}}
analysis: {{flow_rule: associative, accuracy: reference}}
"""


def buttress(base: float, level: float, cohesion: float, strips: int, *, away: bool = False) -> tuple[float, float]:
    """Load factor of a wedge with an upright face at x = 0 and a slope of ``strips`` faces; the closed form for it.

    It is 1 m high and 0.5 m wide, and turns about its toe, where x = base, or 0 if it is pulled away from the soil. At
    z the soil pushes with σ = K γ (level − z) + c, of which ∫ σ z dz is the moment about both.
    """
    line = [(base * (1 - k / strips), k / strips) for k in range(strips + 1)]
    outline = [(0.0, 0.0), *line]  # counter-clockwise in x and z
    n = len(outline)
    vertices = [[x, y, z] for y in (0.0, 0.5) for x, z in outline]
    faces = [list(range(n)), [n + k for k in reversed(range(n))]]
    faces += [[k, n + k, n + (k + 1) % n, (k + 1) % n] for k in range(n)]
    values = {
        "vertices": vertices,
        "faces": faces,
        "level": level,
        "cohesion": cohesion,
        "way": -1000 if away else 1000,
    }
    _, result = case_of(BUTTRESS.format(**values))
    assert result.status is Status.SOLVED
    assert result.solution.mechanics is not None
    top, g = min(level, 1.0), 9.81
    stone = 2000 * g * 0.5 * base * 0.5
    z = np.polynomial.Polynomial([0.0, 1.0])
    deep = ((level - z) * base * 1700 * g * 0.5, base * (1 - z))  # soil on the slope over dz, and its place
    heavy = (deep[0] * (deep[1] if away else base - deep[1])).integ()(top)
    share = 1 / 3 if away else 0.33 * 3
    sigma = share * 1700 * g * (level - z) * 0.5 + (0.0 if away else 0.5 * 2 * np.sqrt(3) * cohesion * 0.5)
    pushed = (sigma * z).integ()(top)
    expected = stone * base * (1 / 3 if away else 2 / 3) + heavy + (-pushed if away else pushed)
    return result.solution.mechanics.load_factor, float(expected) / (1000 * 0.9)


@pytest.mark.parametrize("strips", [1, 3])
@pytest.mark.parametrize(
    ("base", "level", "cohesion"), [(1.0, 1.0, 0.0), (1.0, 0.6, 0.0), (0.6, 1.0, 0.0), (1.0, 1.7, 5000.0)]
)
def test_turned_into_the_soil(base: float, level: float, cohesion: float, strips: int) -> None:
    """Hydrostatic at its passive limit: a third of the depth; a slope partly above the top, a steep one."""
    found, expected = buttress(base, level, cohesion, strips)
    assert found == pytest.approx(expected, rel=1e-6)


def test_the_lever_of_a_wedge() -> None:
    assert buttress(1.0, 1.0, 0.0, 1)[1] == pytest.approx(6.7062, abs=1e-4)


@pytest.mark.parametrize("strips", [1, 4])
def test_turned_away_from_the_soil(strips: int) -> None:
    """Active pressure follows at the same place, cohesion does not."""
    found, expected = buttress(1.0, 1.2, 5000.0, strips, away=True)
    assert found == pytest.approx(expected, rel=1e-6)


def test_units(tmp_path: Path) -> None:
    """The same wedge in mm and N."""
    text = DECK.format(cohesion=0.02).replace("units: {force: kN}", "units: {length: mm}")
    text = text.replace("unit_weight: 24", 'unit_weight: "24 kN/m^3"').replace(
        "unit_weight: 18", 'unit_weight: "18 kN/m^3"'
    )
    text = text.replace("level: 1.5", "level: 1500").replace(
        "      faces:", "      transform: {scale: 1000}\n      faces:"
    )
    path = tmp_path / "mm.yaml"
    path.write_text(text)
    found, plain = build_model(read_deck(path)).ties, build_model(read_deck(write(tmp_path, 20.0))).ties
    assert found.least == pytest.approx(1000 * plain.least, rel=1e-12)
    assert found.greatest == pytest.approx(1000 * plain.greatest, rel=1e-12)
    assert found.places == pytest.approx(1000 * plain.places, rel=1e-12)


def test_of_a_half_with_its_image() -> None:
    """The wedge cut along its middle: the strut on the half and its image push as that on the whole."""
    halved = DECK.replace(",1,0]", ",0.5,0]").replace(",1,1]", ",0.5,1]")
    halved = halved.replace("0.5, 0.1]", "0, 0.1]").replace("{{force: [1,", "{{force: [0.5,")
    halved = halved.replace("load_cases:", "symmetry: [{{y: 0, halves: wedge}}]\nload_cases:")
    model, result = case_of(halved.format(cohesion=0.0), "analysis.accuracy=standard")
    assert len(model.ties) == 2
    assert model.ties.least == pytest.approx([-0.5 * 3 * PRESSURE / 2] * 2)
    assert result.solution.mechanics is not None
    expected = 0.3 * (STONE + SOIL) + 0.5 * 3 * PRESSURE
    assert result.solution.mechanics.load_factor == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(
    ("load", "words"),
    [
        ("dead: [{gravity: none}], live: [{force: [1, 0, 0], on: wedge}]", "though gravity here is (0, 0, 0) m/s2"),
        ("dead: [{gravity: [0, 0, -1.62]}], live: [{force: [1, 0, 0], on: wedge}]", "gravity here is (0, 0, -1.62) m"),
        ("live: [{tilt: {axis: [0, 1, 0]}}]", "though gravity turns against it"),
        ("dead: [{gravity: [0, 0, -9.80665]}], live: [{acceleration: [1, 0, 0]}]", None),
    ],
)
def test_a_warning_where_gravity_is_another(tmp_path: Path, load: str, words: str | None) -> None:
    path = write(tmp_path, 0.0)
    path.write_text(path.read_text().partition("  into:")[0] + f"  case: {{{load}}}\n")
    texts = [each.message for each in build_model(read_deck(path)).notices if each.identifier == "soil-stress-stays"]
    assert len(texts) == (words is not None)
    assert all("case: the fill soil pushes" in text and str(words) in text for text in texts)


def test_a_notice_says_that_it_is_calibrated(tmp_path: Path) -> None:
    notices = build_model(read_deck(write(tmp_path, 0.0))).notices
    text = next(notice.message for notice in notices if notice.identifier == "fill-restrains")
    assert "1 face with 0.3333 to 1.5 times the vertical stress" in text
