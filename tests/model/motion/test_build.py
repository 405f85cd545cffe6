"""Time histories of decks: what they are built of, and what is remarked on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import Model
from mbla.model.motion.baseline import without_line
from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import TimeHistory
from mbla.questions.modes import FirstPeriod
from mbla.questions.time_history import PeakDisplacement
from tests.model.motion.files import written
from tests.model.shapes import write_deck

BLOCKS = [
    "box: {group: base, material: stone, min: [0, 0, 0], max: [1, 1, 1]}",
    "box: {group: wall, material: stone, min: [0, 0, 1], max: [1, 1, 3]}",
    "box: {group: wall, material: stone, min: [0, 0, 3], max: [1, 1, 4]}",
]
TIMES = np.arange(0.0, 4.0005, 0.01)
SHAKES = 0.3 * without_line(Signal(TIMES, np.sin(2.0 * np.pi * TIMES) * np.sin(0.25 * np.pi * TIMES) ** 2)).values
SINE = "{pulse: sine, amplitude: 0.3 g, duration: 0.5, direction: x}"


def record(folder: Path, values: np.ndarray = SHAKES, times: np.ndarray = TIMES, name: str = "record.csv") -> None:
    rows = "".join(f"{time:.6f},{value:.9f}\n" for time, value in zip(times, values, strict=True))
    written(folder, "t,a\n" + rows, name)


def model(folder: Path, history: str, beside: str = "", units: str = "", supports: str = "[{blocks: base}]") -> Model:
    loads = f"time_history: {{{history}}}{beside}"
    return build_model(read_deck(write_deck(folder, BLOCKS, supports, loads, units)))


def history_of(model: Model) -> TimeHistory:
    history = model.load_cases[0].time_history
    assert history is not None
    return history


def remarks(model: Model) -> list[tuple[str, str]]:
    return [(notice.severity, notice.identifier) for notice in model.notices]


def test_what_is_not_given(tmp_path: Path) -> None:
    found = model(tmp_path, f"motion: {SINE}")
    case, history = found.load_cases[0], history_of(found)
    assert isinstance(case.question, PeakDisplacement)
    assert not case.live_load.any()
    assert (case.modes, case.pushover, case.live) == (0, None, ())
    assert (history.step, history.duration, history.every) == (0.002, 0.5, 0.01)
    assert (history.damping, history.contact_damping, history.check) == (0.0, 0.3, False)
    assert (history.stop_displacement, history.stop_at_rest) == (np.inf, False)
    assert (history.points, history.interfaces, history.rigid, history.forces) == ((), (), (), ())
    assert remarks(found) == []


def test_what_is_given(tmp_path: Path) -> None:
    keys = "step: 0.001, duration: 3, damping: 0.02, contact_damping: 0, check: true, record: {every: 0.02}"
    found = model(tmp_path, f"motion: {SINE}, {keys}, stop: {{displacement: 0.5, rest: true}}", ", modes: 5")
    history = history_of(found)
    assert (history.step, history.duration, history.every) == (0.001, 3.0, 0.02)
    assert (history.damping, history.contact_damping, history.check) == (0.02, 0.0, True)
    assert (history.stop_displacement, history.stop_at_rest) == (0.5, True)
    assert found.load_cases[0].modes == 5


def test_modes_alone(tmp_path: Path) -> None:
    found = build_model(read_deck(write_deck(tmp_path, BLOCKS, "[{blocks: base}]", "modes: 3")))
    case = found.load_cases[0]
    assert isinstance(case.question, FirstPeriod)
    assert (case.modes, case.time_history) == (3, None)
    assert case.dead_load[1, 2] < 0.0
    assert not case.live_load.any()


@pytest.mark.parametrize(
    ("unit", "factor"), [("g", 9.81), ("m/s2", 1.0), ("m/s^2", 1.0), ("cm/s2", 0.01), ("gal", 0.01), ("in/s^2", 0.0254)]
)
@pytest.mark.parametrize(("units", "length"), [("", 1.0), ("length: mm", 1e3)])
def test_units_of_records(tmp_path: Path, unit: str, factor: float, units: str, length: float) -> None:
    record(tmp_path)
    found = history_of(model(tmp_path, f"motion: {{file: record.csv, unit: {unit}, direction: [0, -2, 0]}}", "", units))
    motion = found.motions[0]
    assert motion.source == "record.csv"
    assert motion.direction.tolist() == [0.0, -1.0, 0.0]
    assert motion.signal.times == pytest.approx(TIMES)
    assert motion.signal.values == pytest.approx(SHAKES * factor * length, abs=1e-8 * length)
    assert (found.step, found.duration) == (0.002, 4.0)


@pytest.mark.parametrize(("units", "amplitude"), [("", 2.943), ("length: mm", 2943.0)])
def test_pulses_and_records_add_up(tmp_path: Path, units: str, amplitude: float) -> None:
    record(tmp_path)
    pulse = "{pulse: rectangle, amplitude: 0.3 g, duration: 0.25, direction: -z, start: 1, scale: 2}"
    found = history_of(model(tmp_path, f"motion: [{{file: record.csv, unit: g, direction: y}}, {pulse}]", "", units))
    assert found.base_acceleration(1.1)[2] == pytest.approx(-2.0 * amplitude)
    assert found.base_acceleration(1.3)[2] == 0.0
    assert found.base_acceleration(1.1)[1] == pytest.approx(np.interp(1.1, TIMES, SHAKES) * amplitude / 0.3, rel=1e-6)


def test_one_file_with_three_components(tmp_path: Path) -> None:
    rows = "".join(f"{time},{time},{2 * time},{-time}\n" for time in range(4))
    written(tmp_path, "t,n,e,up\n" + rows, "three.csv")
    asked = "{file: three.csv, columns: [t, n, e, up], unit: m/s2}"
    found = history_of(model(tmp_path, f"motion: {asked}, step: 0.01"))
    assert found.base_acceleration(2.0).tolist() == [2.0, 4.0, -2.0]
    turned = asked.replace("unit", "directions: [y, [-3, 0, 0], z], unit")
    found = history_of(model(tmp_path, f"motion: {turned}, step: 0.01"))
    assert found.base_acceleration(2.0).tolist() == [-4.0, 2.0, -2.0]


def test_components_without_times(tmp_path: Path) -> None:
    written(tmp_path, "0 0\n1 3\n2 6\n", "two.txt")
    found = history_of(
        model(tmp_path, "motion: {file: two.txt, columns: [2, 1], interval: 0.5, unit: m/s2}, step: 0.01")
    )
    assert found.base_acceleration(0.75) == pytest.approx([4.5, 1.5, 0.0])
    assert found.duration == 1.0


def test_short_pulses_and_fine_records_shorten_the_step(tmp_path: Path) -> None:
    record(tmp_path, SHAKES[:50], TIMES[:50] / 10.0)
    assert history_of(model(tmp_path, f"motion: {SINE.replace('0.5', '0.1')}")).step == 0.001
    fine = history_of(model(tmp_path, "motion: {file: record.csv, unit: g, direction: x}"))
    assert fine.step == pytest.approx(0.001)


def test_a_corrected_baseline(tmp_path: Path) -> None:
    record(tmp_path, SHAKES + 0.01)
    asked = "{{file: record.csv, unit: g, direction: x, baseline: {}}}"
    for baseline in ("linear", "highpass", "highpass, corner: 0.3"):
        found = model(tmp_path, f"motion: {asked.format(baseline)}")
        assert np.abs(history_of(found).base_velocity(4.0)).max() < 1e-10
        assert remarks(found) == []
    plain = model(tmp_path, f"motion: {asked.format('none')}")
    assert remarks(plain) == [("warning", "motion-baseline")]


@pytest.mark.parametrize(
    ("baseline", "change", "peak"), [("linear", "0.191 g, 64%", "0.191 g"), ("highpass", "0.205 g, 68%", "0.165 g")]
)
def test_a_correction_that_is_as_large_as_the_record(tmp_path: Path, baseline: str, change: str, peak: str) -> None:
    """A half sine less its mean; uneven times, one of them twice, make none where nothing is to be corrected."""
    record(tmp_path, 0.3 * np.sin(np.pi * TIMES / 4.0))
    (notice,) = model(tmp_path, f"motion: {{file: record.csv, unit: g, direction: x, baseline: {baseline}}}").notices
    assert (notice.severity, notice.identifier) == ("warning", "motion-baseline-large")
    says = f"changes accelerations by up to {change} of the peak, which goes from 0.3 g to {peak}"
    assert notice.message.endswith(f"{says}: if the base is left displaced, baseline: none")
    record(tmp_path, np.r_[0.0, 0.1, -0.1, 0.0, 0.0, -0.1, 0.1, 0.0], np.r_[0.0, 1.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0])
    found = model(tmp_path, "motion: {file: record.csv, unit: g, direction: x, baseline: linear}")
    assert "motion-baseline-large" not in [identifier for _, identifier in remarks(found)]


def test_a_baseline_that_may_be_meant(tmp_path: Path) -> None:
    record(tmp_path, 0.3 * np.sin(np.pi * TIMES / 4.0))
    (notice,) = model(tmp_path, "motion: {file: record.csv, unit: g, direction: x}").notices
    assert notice.identifier == "motion-baseline"
    assert notice.message.endswith(
        "may be meant, a pulse leaves the base displaced; else baseline: linear or highpass brings it to rest"
    )


def test_forces_over_time(tmp_path: Path) -> None:
    written(tmp_path, "0;0\n1;2,5\n2;0\n", "force.csv")
    on = "on: {group: wall, index: 1}"
    forces = (
        f"forces: [{{{on}, at: [1, 0.5, 4], file: force.csv, unit: kN, direction: [2, 0, 0], scale: -1, start: 1}}]"
    )
    found = history_of(model(tmp_path, forces))
    force = found.forces[0]
    assert float(force.signal.value(2.0)) == -2500.0
    assert force.wrenches[2, :6].tolist() == [1.0, 0.0, 0.0, 0.0, 0.5, 0.0]
    assert force.wrenches[2, 6:].tolist() == [0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0]
    assert not force.wrenches[:2].any()
    assert (found.duration, found.motions, force.source) == (3.0, (), "force.csv")


def test_recorded_points_and_interfaces(tmp_path: Path) -> None:
    points = "points: {top: {on: {group: wall, index: 1}, at: [0, 0, 4]}, foot: {on: base}}"
    interfaces = "interfaces: {bed: {between: [{group: wall, index: 1}, {group: wall, index: 0}]}}"
    found = history_of(model(tmp_path, f"motion: {SINE}, record: {{{points}, {interfaces}}}"))
    assert [(point.name, point.block, point.point.tolist()) for point in found.points] == [
        ("top", 2, [0.0, 0.0, 4.0]),
        ("foot", 0, [0.5, 0.5, 0.5]),
    ]
    assert [(each.name, each.bodies.tolist()) for each in found.interfaces] == [("bed", [2, 1])]


def test_ground_as_a_side_of_an_interface(tmp_path: Path) -> None:
    asked = f"motion: {SINE}, record: {{interfaces: {{foot: {{between: [ground, base]}}}}}}"
    found = history_of(model(tmp_path, asked, supports="[{ground: {z: 0}}]"))
    assert [(each.name, each.bodies.tolist()) for each in found.interfaces] == [("foot", [3, 0])]
    several = model(tmp_path, asked, supports="[{ground: {z: 0}}, {ground: {x: 0}}]")
    assert [(each.name, each.bodies.tolist()) for each in history_of(several).interfaces] == [
        ("foot[0]", [3, 0]),
        ("foot[1]", [4, 0]),
    ]


def test_kinematic_blocks(tmp_path: Path) -> None:
    found = model(tmp_path, f"motion: {SINE}, rigid: [wall]")
    assert [blocks.tolist() for blocks in history_of(found).rigid] == [[1, 2]]
    alone = model(tmp_path, f"motion: {SINE}, rigid: [{{group: wall, index: 1}}]")
    assert history_of(alone).rigid == ()
    assert remarks(alone) == [("warning", "rigid-alone")]


def test_dead_loads_that_turn_with_their_block(tmp_path: Path) -> None:
    force = "{force: [5, 0, 0], on: {group: wall, index: 1}, at: [1, 0.5, 4], follows: true}"
    found = history_of(model(tmp_path, f"motion: {SINE}", f", dead: [{force}]"))
    assert found.dead_following[2, :3].tolist() == [5.0, 0.0, 0.0]
    assert found.dead_levers.shape == (3, 9)


@pytest.mark.parametrize(
    ("values", "times", "more", "severity", "identifier"),
    [
        (20.0 * SHAKES, TIMES, "", "warning", "motion-unit"),
        (1e-3 * SHAKES, TIMES, "", "warning", "motion-unit"),
        (SHAKES[:150], TIMES[:150], "", "warning", "motion-baseline"),
        (np.r_[0.0, 1.0, -1.0, 0.0] * 0.1, np.r_[0.0, 0.5, 1.5, 2.0], ", start: 0", "warning", "motion-unit"),
        (SHAKES[:201], np.r_[TIMES[:200], 2.0003], "", "notice", "motion-uneven"),
    ],
)
def test_odd_records(
    tmp_path: Path, values: np.ndarray, times: np.ndarray, more: str, severity: str, identifier: str
) -> None:
    record(tmp_path, values, times)
    found = model(tmp_path, f"motion: {{file: record.csv, unit: g, direction: x{more}}}, step: 0.002")
    assert (severity, identifier) in remarks(found)


def test_a_record_that_drifts(tmp_path: Path) -> None:
    """At rest at its end, but farthest away there."""
    record(tmp_path, np.where(TIMES < 2.0, 0.1, -0.1) * np.sin(np.pi * TIMES) ** 2)
    found = model(tmp_path, "motion: {file: record.csv, unit: g, direction: x}")
    assert [identifier for _, identifier in remarks(found)] == ["motion-baseline"]
    assert "drifts" in found.notices[0].message


def test_a_scale_is_no_wrong_unit(tmp_path: Path) -> None:
    record(tmp_path)
    assert remarks(model(tmp_path, "motion: {file: record.csv, unit: g, direction: x, scale: 40}")) == []


def test_steps_that_are_too_long(tmp_path: Path) -> None:
    record(tmp_path)
    of_record = model(tmp_path, "motion: {file: record.csv, unit: g, direction: x}, step: 0.02")
    of_pulse = model(tmp_path, f"motion: {SINE}, step: 0.01")
    assert remarks(of_record) == remarks(of_pulse) == [("warning", "motion-step")]
    assert of_record.notices[0].message.endswith("use step: 0.01")
    assert of_pulse.notices[0].message.endswith("use step: 0.005")


def test_durations_beside_that_of_a_record(tmp_path: Path) -> None:
    record(tmp_path)
    for duration, words in ((5, "moves freely"), (3, "leaves out the last 1 s")):
        found = model(tmp_path, f"motion: {{file: record.csv, unit: g, direction: x}}, duration: {duration}")
        assert remarks(found) == [("notice", "motion-ends")]
        assert words in found.notices[0].message
    assert remarks(model(tmp_path, f"motion: {SINE}, duration: 5")) == []


def test_a_header_with_another_unit(tmp_path: Path) -> None:
    values = "\n".join(f"{value:.6E}" for value in SHAKES)
    head = "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 401, DT= .01 SEC\n"
    written(tmp_path, head + values + "\n", "r.AT2")
    asked = "motion: {{file: r.AT2, unit: {}, direction: x}}"
    assert remarks(model(tmp_path, asked.format("g"))) == []
    wrong = model(tmp_path, asked.format("m/s2"))
    assert remarks(wrong) == [("warning", "motion-unit")]
    assert wrong.notices[0].message.endswith("the deck m/s2: unit: g?")


def test_points_outside_of_blocks_are_remarked_on(tmp_path: Path) -> None:
    found = model(tmp_path, f"motion: {SINE}, record: {{points: {{far: {{on: base, at: [0, 0, 9]}}}}}}")
    assert remarks(found) == [("warning", "recorded-point-outside")]


def test_what_has_no_effect_is_told(tmp_path: Path) -> None:
    often = model(tmp_path, f"motion: {SINE}, step: 0.002, record: {{every: 0.001}}")
    assert remarks(often) == [("notice", "record-every")]
    assert remarks(model(tmp_path, f"motion: {SINE}, step: 0.002, record: {{every: 0.002}}")) == []
    nothing = model(tmp_path, f"motion: {SINE[:-1]}, scale: 0}}")
    assert remarks(nothing) == [("notice", "motion-scale")]
    assert nothing.notices[0].message.endswith("its scale is 0, so that nothing of it acts")
