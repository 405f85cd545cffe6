"""Every column of the tables of blocks, interfaces and points, worked out once more by plain loops."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.deck.sections.selectors import POSITIONS
from mbla.questions.reaction import Reaction
from mbla.results.results import CaseResult, Results
from mbla.results.tables.tables import tables_of
from mbla.run import RunOptions, run
from mbla.solution.solution import Mechanics, Standing, Status
from tests.asked import settlement_of
from tests.results.synthetic import full_results, standing_at, tower_mechanics, tower_results

NAN3 = [np.nan] * 3
SIX = ("x", "y", "z", "rx", "ry", "rz")
LOCAL = ("N", "T1", "T2")
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


def forces_of(case: CaseResult) -> Any:
    """Contact forces of a solved case, or those that lock it; None where there are none."""
    mechanics = forces_and_motion(case)
    return mechanics.contact_forces if mechanics else case.solution.lock if figures(case) == "lock" else None


def figures(case: CaseResult) -> str:
    """Where the tower hangs between two walls its load factor is none."""
    standing = case.solution.standing
    if case.status is not Status.SOLVED:
        return "lock" if case.status is Status.UNBOUNDED and case.solution.lock is not None else ""
    return "best_iterate" if standing is not None and standing.verdict is Standing.SELF_STRESS else "result"


def put(row: dict[str, Any], name: str, values: Any, axes: Sequence[str] = "xyz") -> None:
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
            row: dict[str, Any] = {"case": load.name, "block": b, "groups": group, "group_indices": seen[group]}
            row["block_name"] = f"{group}[{seen[group]}]"
            seen[group] += 1
            row["members"] = blocks.labels.members[b]
            put(row, "centroids", blocks.centroids[b])
            row["volumes"], row["densities"] = blocks.volumes[b], blocks.densities[b]
            row["added_masses"] = blocks.added_masses[b]
            # kN of t are N of kg, so that 9.81 m/s2 stands for both, whatever the length
            row["weights"] = (blocks.densities[b] * blocks.volumes[b] + blocks.added_masses[b]) * GRAVITY
            row["fixed"] = bool(model.fixed[b])
            row["guided"] = b in model.guides.blocks.tolist()
            row["settles"] = b in load.question.giving_way.tolist()
            row["solid_of_block"] = None if solids is None else solids[b]
            for name, loads in (("dead", load.dead_load), ("live", load.live_load)):
                put(row, f"{name}_load", loads[b], SIX)
            row["figures"] = figures(case)
            put(row, "mechanism", mechanics.mechanism[b] if mechanics else NAN3 * 2, SIX)
            certificate = case.solution.certificate if case.status is Status.NO_EQUILIBRIUM else None
            put(row, "certificate", NAN3 * 2 if certificate is None else certificate[b], SIX)
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
            row: dict[str, Any] = {"case": case.load_case.name, "interface": i, "bodies_a": a, "bodies_b": b}
            row |= {
                "body_names_a": names[a],
                "body_names_b": names[b],
                "joints": contacts.joint_names[contacts.joints[i]],
            }
            points = range(contacts.point_start[i], contacts.point_start[i + 1])
            row |= {"point_count": len(points), "areas": contacts.areas[i], "gaps": contacts.gaps[i]}
            put(row, "centroids", contacts.centroids[i])
            put(row, "normals", contacts.normals[i])
            row["figures"] = figures(case)
            row |= interface_forces(results, forces_of(case), i, points)
            v, w = (NAN3, NAN3) if mechanics is None else relative(results, mechanics.mechanism, i)
            put(row, "translations", v)
            put(row, "rotations", w)
            row["work"] = np.nan
            if mechanics:
                row["work"] = -sum(mechanics.contact_forces[p] @ mechanics.contact_velocities[p] for p in points)
            certificate = case.solution.certificate if case.status is Status.NO_EQUILIBRIUM else None
            v, w = (NAN3, NAN3) if certificate is None else relative(results, certificate, i)
            put(row, "certificate_translations", v)
            put(row, "certificate_rotations", w)
            rows.append(row)
        pressed = rows[-len(contacts.areas) :]
        largest = max(abs(row["normal_forces"]) for row in pressed)
        for row in pressed:
            if not row["normal_forces"] > 1e-7 * largest:  # a residual acts nowhere
                put(row, "thrust_points", NAN3)
            if row["normal_forces"] + row["shear_forces"] < 1e-9 * largest:  # and uses nothing
                row["friction_use"] = np.nan
    return rows


def interface_forces(results: Results, forces: Any, i: int, points: Any) -> dict[str, Any]:
    contacts = results.contacts
    row: dict[str, Any] = {}
    force, moment = np.zeros(3), np.zeros(3)
    normal_at, allowed = contacts.normals[i], 0.0
    law = results.model.joints[contacts.joint_names[contacts.joints[i]]]
    there = forces is not None
    for p in points if there else ():
        own = sum(forces[p, k] * contacts.frames[p, k] for k in range(3))
        force, moment = force + own, moment + np.cross(contacts.points[p] - contacts.centroids[i], own)
        allowed += max(law.friction * forces[p, 0] + law.cohesion * contacts.point_areas[p], 0.0)
    normal = force @ normal_at or 1e-300  # nothing acts nowhere and uses nothing, as told below
    allowed = allowed or 1e-300
    shear = np.linalg.norm(force - normal * normal_at)
    put(row, "resultant_forces", force if there else NAN3)
    put(row, "resultant_moments", moment if there else NAN3)
    pressed = there and normal > 0  # others act at no point
    put(row, "thrust_points", contacts.centroids[i] + np.cross(normal_at, moment) / normal if pressed else NAN3)
    row["normal_forces"] = normal if there else np.nan
    row["shear_forces"] = shear if there else np.nan
    row["torsions"] = moment @ normal_at if there else np.nan
    row["friction_use"] = shear / allowed if there and allowed > 0 else np.nan
    return row


def point_rows(results: Results) -> list[dict[str, Any]]:
    contacts, rows = results.contacts, []
    for case in results.cases:
        mechanics = forces_and_motion(case)
        found = forces_of(case)
        for i in range(len(contacts.areas)):
            for p in range(contacts.point_start[i], contacts.point_start[i + 1]):
                row: dict[str, Any] = {"case": case.load_case.name, "point": p, "interface": i}
                put(row, "points", contacts.points[p])
                for k, name in enumerate(LOCAL):
                    put(row, f"frames_{name}", contacts.frames[p, k])
                row["point_areas"] = contacts.point_areas[p]
                row["figures"] = figures(case)
                forces = NAN3 if found is None else found[p]
                put(row, "contact_forces", forces, LOCAL)
                put(row, "global_forces", contacts.frames[p].T @ forces)
                row["modes"] = ("stick", "slide", "open")[mechanics.modes[p]] if mechanics else ""
                velocities = mechanics.contact_velocities[p] if mechanics else NAN3
                put(row, "contact_velocities", velocities, LOCAL)
                rows.append(row)
    return rows


EXPECTED = {"blocks": block_rows, "interfaces": interface_rows, "points": point_rows}
UNIT_STRESS = ("bending_tension", "splitting_tension", "joint_pressure", "strength_use")
ELSEWHERE = {
    "blocks": ("parts", *POSITIONS, *UNIT_STRESS),
    "interfaces": ("modes", "eccentricity", "torsion_use", "hinge_points", "hinge_directions"),
    "points": ("friction_use",),
}
"""what follows by more than arithmetic; tested with what computes it and in test_tables.py"""


@pytest.mark.parametrize("which", ["tower", "full", "pile", "spatial"])
@pytest.mark.parametrize("name", EXPECTED)
def test_columns_are_what_the_arrays_say(every: dict[str, Results], which: str, name: str) -> None:
    results = every[which]
    table, rows = tables_of(results)[name], EXPECTED[name](results)
    assert len(table) == len(rows)
    left = set(table.unit_of) - set(rows[0])
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
            load_case=replace(case.load_case, name=f"train_{p.place.number}", question=p),
            solution=replace(case.solution, mechanics=replace(tower_mechanics(), load_factor=1.0 / p.place.number)),
        )
        for p in positions
    )
    series = tables_of(replace(full, cases=travelling))["series"]
    assert series["distance"].tolist() == [2.5, 5.0]
    assert series["load_factor"].tolist() == [1.0, 0.5]
    assert series["worst"].tolist() == [False, True]
    settlement = settlement_of(case.load_case)
    for turns, filled, empty in ((False, "force", "moment"), (True, "moment", "force")):
        own = replace(case, load_case=replace(case.load_case, question=Reaction(replace(settlement, turns=turns))))
        table = tables_of(replace(full, cases=(own,)))["cases"]
        assert table[f"reaction_{filled}"].tolist() == [settlement.reaction(0.5)]
        assert np.isnan(table[f"reaction_{empty}"]).all()
