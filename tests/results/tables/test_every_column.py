"""Every column of the tables of blocks, interfaces, points and cases, worked out once more by plain loops."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.deck.sections.selectors import POSITIONS
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.results import CaseResult, Results
from mbla.results.tables.tables import tables_of
from mbla.run import RunOptions, run
from mbla.solution.solution import Mechanics, Standing, Status
from tests.results.synthetic import full_results, standing_at, tower_mechanics, tower_results

NAN3 = [np.nan] * 3
GRAVITY = 9.81
PILE = """\
mbla: 1
units: {length: mm, force: kN, mass: t}
materials: {stone: {density: "2000 kg/m^3"}}
joints: {dry: {friction: 0.5, cohesion: "2 kPa"}}
contacts: {joint: dry}
blocks:
  - box: {group: pile, material: stone, min: [0, 0, 0], max: [1000, 600, 400]}
  - box: {group: pile, material: stone, min: [100, 0, 400], max: [900, 600, 2000]}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  lift: {dead: [{gravity: none}, {force: [0, 0, 100], on: {group: pile, index: 1}}], live: [{acceleration: [1, 0, 0]}]}
  press: {live: [{acceleration: [0, 0, -1]}]}
"""
SPATIAL = """\
mbla: 1
materials: {stone: {density: 1800}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
blocks:
  - wall:
      {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 1.2, courses: 3,
       transform: {rotate: {axis: [0, 0, 1], angle: 25}}}
supports: [{ground: {z: 0}}]
load_cases:
  across:
    dead: [{gravity: none}, {force: [0, 0, -90], on: {group: wall, index: 0}, at: [0.05, 0.04, 0.2]}]
    live: [{acceleration: [0.3, 1, 0]}, {force: [0, 40, 0], on: {group: wall, index: 1}, at: [0.4, 0.2, 0.15]}]
analysis: {flow_rule: associative}
"""


def solved(folder: Path, text: str) -> Results:
    path = folder / "deck.yaml"
    path.write_text(text, encoding="utf-8")
    return run(path, RunOptions(folder / "deck.out", ("output.vtu=false",)))


@pytest.fixture(scope="module")
def every(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Results]:
    return {
        "tower": tower_results(),
        "full": full_results(),
        "pile": solved(tmp_path_factory.mktemp("pile"), PILE),
        "spatial": solved(tmp_path_factory.mktemp("spatial"), SPATIAL),
    }


def forces_and_motion(case: CaseResult) -> Mechanics | None:
    """Of a solved case, a result or not; none of these is solved in another way."""
    return case.solution.mechanics if case.status is Status.SOLVED else None


def figures(case: CaseResult) -> str:
    """Where the tower hangs between two walls its load factor is none."""
    standing = case.solution.standing
    if case.status is not Status.SOLVED:
        return ""
    return "best_iterate" if standing is not None and standing.verdict is Standing.SELF_STRESS else "result"


def put(row: dict[str, Any], name: str, values: Any, axes: str = "xyz") -> None:
    for axis, value in zip(axes, values, strict=True):
        row[f"{name}_{axis}"] = value


def block_rows(results: Results) -> list[dict[str, Any]]:
    blocks, rows = results.model.blocks, []
    solids = results.contacts.solid_of_block
    for case in results.cases:
        model, load = results.model.of_case(case.load_case), case.load_case
        mechanics = forces_and_motion(case)
        seen = dict.fromkeys(blocks.groups, 0)
        for b, group in enumerate(blocks.groups):
            row: dict[str, Any] = {"case": load.name, "block": b, "group": group, "index": seen[group]}
            row["name"] = f"{group}[{seen[group]}]"
            seen[group] += 1
            row["member"] = blocks.labels.members[b]
            put(row, "centroid", blocks.centroids[b])
            row["volume"], row["density"] = blocks.volumes[b], blocks.densities[b]
            row["added_mass"] = blocks.added_masses[b]
            # kN of t are N of kg, so that 9.81 m/s2 stands for both, whatever the length
            row["weight"] = (blocks.densities[b] * blocks.volumes[b] + blocks.added_masses[b]) * GRAVITY
            row["fixed"] = bool(model.fixed[b])
            row["guided"] = b in model.guides.blocks.tolist()
            row["settles"] = load.settlement is not None and b in load.settlement.blocks.tolist()
            row["body"] = None if solids is None else solids[b]
            for name, loads in (("dead", load.dead_load), ("live", load.live_load)):
                put(row, f"{name}_force", loads[b, :3])
                put(row, f"{name}_moment", loads[b, 3:])
            row["figures"] = figures(case)
            put(row, "velocity", mechanics.mechanism[b, :3] if mechanics else NAN3)
            put(row, "rotation", mechanics.mechanism[b, 3:] if mechanics else NAN3)
            certificate = case.solution.certificate if case.status is Status.NO_EQUILIBRIUM else None
            put(row, "certificate_velocity", NAN3 if certificate is None else certificate[b, :3])
            put(row, "certificate_rotation", NAN3 if certificate is None else certificate[b, 3:])
            rows.append(row)
    return rows


def relative(results: Results, motion: Any, i: int) -> tuple[Any, Any]:
    """Velocity at the centroid and rotation of b relative to a."""
    contacts, blocks = results.contacts, results.model.blocks
    parts = []
    for body in contacts.bodies[i].tolist():
        own = motion[body] if body < len(blocks) else np.zeros(6)
        arm = contacts.centroids[i] - blocks.centroids[body] if body < len(blocks) else np.zeros(3)
        parts.append((own[:3] + np.cross(own[3:], arm), own[3:]))
    return parts[1][0] - parts[0][0], parts[1][1] - parts[0][1]


def interface_rows(results: Results) -> list[dict[str, Any]]:
    contacts, model, rows = results.contacts, results.model, []
    names = [*(f"{g}[{i}]" for g, i in zip(model.blocks.groups, model.blocks.group_indices, strict=True))]
    names += [ground.label for ground in model.grounds]
    for case in results.cases:
        mechanics = forces_and_motion(case)
        for i, (a, b) in enumerate(contacts.bodies.tolist()):
            row: dict[str, Any] = {"case": case.load_case.name, "interface": i, "body_a": a, "body_b": b}
            row |= {"name_a": names[a], "name_b": names[b], "joint": contacts.joint_names[contacts.joints[i]]}
            points = range(contacts.point_start[i], contacts.point_start[i + 1])
            row |= {"points": len(points), "area": contacts.areas[i], "gap": contacts.gaps[i]}
            put(row, "centroid", contacts.centroids[i])
            put(row, "normal", contacts.normals[i])
            row["figures"] = figures(case)
            row |= interface_forces(results, mechanics, i, points)
            ranges = case.solution.force_ranges
            row["normal_force_min"], row["normal_force_max"] = (np.nan, np.nan) if ranges is None else ranges[i]
            v, w = (NAN3, NAN3) if mechanics is None else relative(results, mechanics.mechanism, i)
            put(row, "translation", v)
            put(row, "rotation", w)
            row["work"] = np.nan
            if mechanics:
                row["work"] = -sum(mechanics.contact_forces[p] @ mechanics.contact_velocities[p] for p in points)
            certificate = case.solution.certificate if case.status is Status.NO_EQUILIBRIUM else None
            v, w = (NAN3, NAN3) if certificate is None else relative(results, certificate, i)
            put(row, "certificate_translation", v)
            put(row, "certificate_rotation", w)
            rows.append(row)
        pressed = rows[-len(contacts.areas) :]
        largest = max(abs(row["normal_force"]) for row in pressed)
        for row in pressed:
            if not row["normal_force"] > 1e-7 * largest:  # a residual acts nowhere
                put(row, "application", NAN3)
            if row["normal_force"] + row["shear_force"] < 1e-9 * largest:  # and uses nothing
                row["friction_use"] = np.nan
    return rows


def interface_forces(results: Results, mechanics: Mechanics | None, i: int, points: Any) -> dict[str, Any]:
    contacts = results.contacts
    row: dict[str, Any] = {}
    force, moment = np.zeros(3), np.zeros(3)
    normal_at, allowed = contacts.normals[i], 0.0
    law = results.model.joints[contacts.joint_names[contacts.joints[i]]]
    for p in points if mechanics else ():
        assert mechanics is not None
        own = sum(mechanics.contact_forces[p, k] * contacts.frames[p, k] for k in range(3))
        force, moment = force + own, moment + np.cross(contacts.points[p] - contacts.centroids[i], own)
        allowed += max(law.friction * mechanics.contact_forces[p, 0] + law.cohesion * contacts.point_areas[p], 0.0)
    normal = force @ normal_at or 1e-300  # nothing acts nowhere and uses nothing, as told below
    allowed = allowed or 1e-300
    shear = np.linalg.norm(force - normal * normal_at)
    put(row, "force", force if mechanics else NAN3)
    put(row, "moment", moment if mechanics else NAN3)
    pressed = mechanics is not None and normal > 0  # others act at no point
    put(row, "application", contacts.centroids[i] + np.cross(normal_at, moment) / normal if pressed else NAN3)
    row["normal_force"] = normal if mechanics else np.nan
    row["shear_force"] = shear if mechanics else np.nan
    row["torsion"] = moment @ normal_at if mechanics else np.nan
    row["friction_use"] = shear / allowed if mechanics and allowed > 0 else np.nan
    return row


def point_rows(results: Results) -> list[dict[str, Any]]:
    contacts, rows = results.contacts, []
    for case in results.cases:
        mechanics = forces_and_motion(case)
        lock = case.solution.lock if case.status is Status.UNBOUNDED else None
        for i in range(len(contacts.areas)):
            for p in range(contacts.point_start[i], contacts.point_start[i + 1]):
                row: dict[str, Any] = {"case": case.load_case.name, "point": p, "interface": i}
                put(row, "position", contacts.points[p])
                for k, name in enumerate(("normal", "tangent_1", "tangent_2")):
                    put(row, name, contacts.frames[p, k])
                row["area"] = contacts.point_areas[p]
                row["figures"] = figures(case)
                forces = mechanics.contact_forces[p] if mechanics else NAN3
                row["N"], row["T1"], row["T2"] = forces
                put(row, "force", contacts.frames[p].T @ forces if mechanics else NAN3)
                row["mode"] = ("stick", "slide", "open")[mechanics.modes[p]] if mechanics else ""
                velocities = mechanics.contact_velocities[p] if mechanics else NAN3
                row["opening"], row["slip_1"], row["slip_2"] = velocities
                row["lock_N"], row["lock_T1"], row["lock_T2"] = NAN3 if lock is None else lock[p]
                rows.append(row)
    return rows


def case_rows(results: Results) -> list[dict[str, Any]]:
    rows = []
    for case in results.cases:
        solution, checks, mechanics = case.solution, case.checks, forces_and_motion(case)
        row: dict[str, Any] = {"case": case.load_case.name, "status": case.status.value, "reason": solution.reason}
        row |= {"verified": checks.verified, "failures": "; ".join(checks.failures)}
        row |= {"remarks": "; ".join(solution.remarks), "flow_rule": solution.flow_rule, "scheme": solution.scheme}
        row["contact_model"] = solution.contact_model
        row["load_factor"] = mechanics.load_factor if mechanics and figures(case) == "result" else np.nan
        row["best_iterate_load_factor"] = (
            mechanics.load_factor if mechanics and figures(case) == "best_iterate" else np.nan
        )
        for name in ("static_bound", "kinematic_bound", "gap", "equilibrium_residual", "yield_violation"):
            row[name] = getattr(checks, name)
        for name in ("tension_violation", "penetration", "complementarity_residual", "slip_residual", "live_power"):
            row[name] = getattr(checks, name)
        row["power_balance"], row["peak_load_factor"] = checks.power_balance, checks.peak_load_factor
        row["range_lower"], row["range_upper"] = (
            (checks.lower, checks.upper) if figures(case) == "result" else (np.nan, np.nan)
        )
        ends = [checks.lower, checks.upper, *(solution.spread or ())] if figures(case) == "result" else []
        known = [end for end in (row["load_factor"], *ends) if not np.isnan(end)] or [np.nan]
        row["least_load_factor"], row["greatest_load_factor"] = min(known), max(known)
        row["spread_lower"], row["spread_upper"] = solution.spread or (np.nan, np.nan)
        row["programs"] = len(solution.programs)
        row["iterations"] = sum(program.iterations for program in solution.programs)
        row["time"], row["solver_time"] = solution.seconds, sum(program.seconds for program in solution.programs)
        row["figures"] = figures(case)
        rows.append(row)
    return rows


EXPECTED = {"blocks": block_rows, "interfaces": interface_rows, "points": point_rows, "cases": case_rows}
ELSEWHERE = {
    "blocks": ("part", *POSITIONS),
    "interfaces": ("mode", "eccentricity", "torsion_use", "hinge_point", "hinge_direction"),
    "points": ("friction_use",),
    "cases": (
        *("standing", "factor_unique", "associative_load_factor", "angle", "reaction_", "moving_"),
        *(f"{mode.name.lower()}_interfaces" for mode in InterfaceMode),
    ),
}
"""what follows by more than arithmetic; tested with what computes it and in test_tables.py"""


@pytest.mark.parametrize("which", ["tower", "full", "pile", "spatial"])
@pytest.mark.parametrize("name", EXPECTED)
def test_columns_are_what_the_arrays_say(every: dict[str, Results], which: str, name: str) -> None:
    results = every[which]
    table, rows = tables_of(results)[name], EXPECTED[name](results)
    assert len(table) == len(rows)
    left = set(table.columns) - set(rows[0])
    assert {column for column in left if not column.startswith(ELSEWHERE[name])} == set()
    for column in rows[0]:
        found, values = table[column], [row[column] for row in rows]
        if found.dtype.kind == "f":
            numbers = np.array(values, dtype=float)
            size = np.abs(numbers[np.isfinite(numbers)]).max(initial=0.0)
            assert found == pytest.approx(numbers, rel=1e-9, abs=1e-9 * size, nan_ok=True), column
        else:
            assert found.tolist() == values, column


def test_series_and_reactions_of_settlements(every: dict[str, Results]) -> None:
    """Positions of a travelling load, the first not the worst; a support that gives way, moving and turning."""
    full = every["full"]
    case = replace(full.cases[0], solution=replace(full.cases[0].solution, standing=None))
    positions = [standing_at(number, 2, np.array([1.0, 2.0, number]), 2.5 * number) for number in (1, 2)]
    travelling = tuple(
        replace(
            case,
            load_case=replace(case.load_case, name=f"train_{p.number}", travel=p),
            solution=replace(case.solution, mechanics=replace(tower_mechanics(), load_factor=1.0 / p.number)),
        )
        for p in positions
    )
    series = tables_of(replace(full, cases=travelling))["series"]
    assert series["distance"].tolist() == [2.5, 5.0]
    assert series["load_factor"].tolist() == [1.0, 0.5]
    assert series["worst"].tolist() == [False, True]
    settlement = case.load_case.settlement
    assert settlement is not None
    for turns, filled, empty in ((False, "force", "moment"), (True, "moment", "force")):
        own = replace(case, load_case=replace(case.load_case, settlement=replace(settlement, turns=turns)))
        table = tables_of(replace(full, cases=(own,)))["cases"]
        assert table[f"reaction_{filled}"].tolist() == [settlement.reaction(0.5)]
        assert np.isnan(table[f"reaction_{empty}"]).all()
