"""Results from the content of a result file: the way back from ``content``.

The content has been checked against the layout already; what is checked here is what no table can say.
That is also what arrays of a model must have in common whatever its deck: volumes are those of the faces, frames are
square.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import ContactReport, Contacts
from mbla.deck.sections.assessment import AssessmentSection
from mbla.deck.sections.selectors import POSITIONS
from mbla.deck.units import KILOGRAMS, METRES, NEWTONS, Units
from mbla.errors import Notice
from mbla.model.applied_load import AppliedLoad, without_forces
from mbla.model.fill import Fill
from mbla.model.guides import NO_GUIDES, Guides
from mbla.model.model import Ground, Joint, LoadCase, Model, Pushing
from mbla.model.solids.blocks import BlockLabels, Blocks
from mbla.model.solids.measures import volumes_and_centroids
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import row_sums
from mbla.model.ties.ties import NO_TIES, OUTSIDE, Ties
from mbla.questions.force import Objective
from mbla.questions.reaction import Settlement
from mbla.questions.tilt import Tilt
from mbla.questions.travel import TravelPosition
from mbla.results.hdf5.case_restore import case_from, held
from mbla.results.hdf5.content import RECORD_NAMES
from mbla.results.hdf5.layout import Content
from mbla.results.record.quantity import stored
from mbla.results.results import CaseResult, DeckRecord, Results

LEAST, MOST = 1e-120, 1e120
"""of loads, which are squared; those of a deck lie within 1e-112 and 1e100. Also the least density"""


def results_from(content: Content, attributes: dict[str, str | int]) -> Results:
    """Results from content and root attributes; raises ValueError where they contradict themselves."""
    get = cast("dict[str, Any]", content)
    names = get["model/load_cases"]
    load_cases = {name: _load_case(name, _part(get, f"cases/{name}/")) for name in names}
    if len(load_cases) != len(names):
        raise ValueError("two load cases of one name")
    complete = bool(attributes["complete"])
    if complete is ("provenance/not_done" in get):
        raise ValueError("whether the run came to its end")
    solved = [name for name in names if f"cases/{name}/status" in get]
    model, contacts = _model(_part(get, "model/"), tuple(load_cases.values())), _contacts(_part(get, "contacts/"))
    if not set(contacts.joint_names) <= set(model.joints):
        raise ValueError("joint law of an interface")
    contradictions = incoherences(model, contacts)
    if contradictions:
        raise ValueError("; ".join(contradictions))
    if solved and model.fixed.all():
        raise ValueError("results of a model in which no block can move")
    for name in solved:
        moving = ~model.of_case(load_cases[name]).fixed
        none = np.abs(load_cases[name].live_load[moving]).max(initial=0.0) < LEAST
        if none and load_cases[name].question.collapses:
            raise ValueError(f"{name}: no live load on blocks that can move")
    cases = tuple(case_from(load_cases[name], _part(get, f"cases/{name}/")) for name in solved)
    assembly = Assembly(model, contacts)
    for case in cases:
        check_carriers(assembly, case)
    return Results(
        deck=DeckRecord(
            name=get["deck/name"],
            sources=tuple(zip(get["deck/source_names"], get["deck/source_texts"], strict=True)),
            overrides=tuple(get["deck/overrides"]),
            sha256=str(attributes["deck_sha256"]),
            files=_side_files(_part(get, "deck/")),
        ),
        assembly=assembly,
        cases=cases,
        notices=_notices(_part(get, "notices/")),
        provenance=dict(zip(get["provenance/names"], get["provenance/values"], strict=True)),
        settings=dict(zip(get["provenance/setting_names"], get["provenance/setting_values"], strict=True)),
        time=dict(zip(get["provenance/stage_names"], get["provenance/stage_seconds"].tolist(), strict=True)),
        exit_code=get["provenance/exit_code"],
        created=str(attributes["created"]),
        files=tuple(get["provenance/files"]),
        complete=complete,
        not_done=() if complete else tuple(get["provenance/not_done"]),
    )


def check_carriers(assembly: Assembly, case: CaseResult) -> None:
    """Raises ValueError where forces are not those of all contact points and of the ties behind them."""
    solution = case.solution
    standing = None if solution.standing is None else solution.standing.forces
    found = [forces for forces in (standing, solution.lock, solution.level_lock) if forces is not None]
    if found:
        carriers = assembly.of(replace(case.load_case, objective=None)).contacts.points
        if any(len(forces) != len(carriers) for forces in found):
            raise ValueError(f"{case.load_case.name}: forces of another number of contact points and ties")


def _side_files(get: dict[str, Any]) -> tuple[tuple[str, bytes], ...]:
    names, start, content = get["file_names"], get["file_start"], get["file_bytes"].tobytes()
    return tuple((name, content[start[row] : start[row + 1]]) for row, name in enumerate(names))


def _part(content: dict[str, Any], prefix: str) -> dict[str, Any]:
    return {path[len(prefix) :]: value for path, value in content.items() if path.startswith(prefix)}


def _notices(get: dict[str, Any]) -> tuple[Notice, ...]:
    if not set(get["severity"]) <= {"notice", "warning"}:
        raise ValueError("severity of a notice")
    return tuple(Notice(*row) for row in zip(get["severity"], get["identifier"], get["message"], strict=True))


def _model(get: dict[str, Any], load_cases: tuple[LoadCase, ...]) -> Model:
    length, force, mass = get["units"]
    if length not in METRES or force not in NEWTONS or mass not in KILOGRAMS:
        raise ValueError("units of the model")
    if get["densities"].min(initial=1.0) < LEAST:
        raise ValueError("density of a block")
    names = get["group_names"]
    groups = tuple(names[group] for group in get["groups"].tolist())
    return Model(
        title=get["title"],
        units=Units(length, force, mass),
        blocks=Blocks(**{**held(Blocks, "model", get), "groups": groups, "labels": _labels(get)}),
        fixed=get["fixed"],
        grounds=_grounds(get),
        joints=_joints(get),
        load_cases=load_cases,
        notices=_notices(_part(get, "notices/")),
        guides=_guides(get),
        fill=_fill(get),
        ties=_ties(get),
    )


def _fill(get: dict[str, Any]) -> Fill | None:
    if "fill_masses" not in get:
        return None
    if np.any(get["fill_masses"] > get["added_masses"] * (1.0 + ROUNDING)):
        raise ValueError("mass of the fill on a block")
    return Fill(get["fill_masses"], get["fill_points"], tuple(get["fill_words"]))


def _ties(get: dict[str, Any]) -> Ties:
    if "tie_names" not in get:
        return NO_TIES
    arrays = {name: get[f"tie_{name}"] for name in Ties.__dataclass_fields__}
    ties = Ties(**{**arrays, "names": tuple(arrays["names"]), "forms": tuple(arrays["forms"])})
    if np.any(np.diff(ties.start) < 2) or np.any((ties.bodies < OUTSIDE) | (ties.bodies >= len(get["fixed"]))):
        raise ValueError("points of a tie")
    if np.any(ties.least > ties.greatest) or np.any((ties.prestress < 0) | (ties.breaks_at < 0)):
        raise ValueError("forces of a tie")
    return ties


def _guides(get: dict[str, Any]) -> Guides:
    if "guided_blocks" not in get:
        return NO_GUIDES
    blocks, bodies = get["guided_blocks"], get["guided_bodies"]
    numbers = np.unique(bodies)
    if len(np.unique(blocks)) < len(blocks) or not np.array_equal(numbers, np.arange(len(numbers))):
        raise ValueError("guided blocks and bodies")
    return Guides(blocks, bodies, get["guide_motions"], tuple(get["guide_words"]))


def _labels(get: dict[str, Any]) -> BlockLabels:
    if tuple(get["position_names"]) != POSITIONS:
        raise ValueError("names of the positions of blocks")
    names = get["member_names"]
    return BlockLabels(tuple(names[member] for member in get["members"].tolist()), get["positions"])


def _joints(get: dict[str, Any]) -> dict[str, Joint]:
    columns = [get[name].tolist() for name in stored(Joint, "model")]
    return {row[0]: Joint(*row) for row in zip(get["joint_names"], *columns, strict=True)}


def _grounds(get: dict[str, Any]) -> tuple[Ground, ...]:
    selective = get["ground_selective"].tolist()
    blocks = np.split(get["ground_blocks"], get["ground_start"][1:-1]) if selective else []
    if not set(get["ground_joints"]) <= set(get["joint_names"]):
        raise ValueError("joint law of a ground plane")
    outlines = _outlines(get, len(selective))
    return tuple(
        Ground(point, normal, joint, carried if chosen else None, label, outline)
        for point, normal, joint, carried, chosen, label, outline in zip(
            get["ground_points"],
            get["ground_normals"],
            get["ground_joints"],
            blocks,
            selective,
            get["ground_labels"],
            outlines,
            strict=True,
        )
    )


def _outlines(get: dict[str, Any], count: int) -> list[FloatArray | None]:
    """Corners of the grounds that end somewhere, None for the others."""
    if "ground_outlines" not in get:
        return [None] * count
    loops = np.split(get["ground_outlines"], get["ground_outline_start"][1:-1])
    if any(0 < len(loop) < 3 for loop in loops):
        raise ValueError("outline of a ground surface")
    return [loop if len(loop) else None for loop in loops]


def _contacts(get: dict[str, Any]) -> Contacts:
    parts = len(get["report/unsupported_start"]) - 1
    unsupported = np.split(get["report/unsupported_blocks"], get["report/unsupported_start"][1:-1]) if parts else []
    report = ContactReport(
        **held(ContactReport, "contacts/report", _part(get, "report/")),
        unsupported=tuple(unsupported),
        notices=_notices(_part(get, "notices/")),
    )
    if np.any((get["outline"] < 0) | (get["outline"] > np.diff(get["point_start"]))):
        raise ValueError("outline of an interface")
    arrays = held(Contacts, "contacts", get)
    label = get.get("solid_of_block")
    if label is not None and not np.array_equal(np.unique(label), np.arange(label.max(initial=-1) + 1)):
        raise ValueError("numbers of rigid bodies")
    return Contacts(**{**arrays, "joint_names": tuple(get["joint_names"]), "report": report})


def _load_case(name: str, get: dict[str, Any]) -> LoadCase:
    names = {path: name for name, path in RECORD_NAMES.items()}
    get = {names.get(path, path): value for path, value in get.items()}
    travel, tilt = _part(get, "travel/"), _part(get, "tilt/")
    if max(np.abs(get[load]).max(initial=0.0) for load in ("dead_load", "live_load")) > MOST:
        raise ValueError(f"{name}: a load beyond {MOST:.0e}")
    if travel and not ((travel["blocks"] >= -1) & (travel["blocks"] < len(get["live_load"]))).all():
        raise ValueError(f"{name}: blocks under a travelling load")
    if travel and not len(travel["blocks"]):
        raise ValueError(f"{name}: a travelling load without forces")
    settlement = None
    if "settlement/blocks" in get:
        settlement = Settlement(**held(Settlement, "cases/*/settlement", _part(get, "settlement/")))
        if len(np.unique(settlement.blocks)) < len(settlement.blocks) or not settlement.unit > 0:
            raise ValueError("settlement of a support")
    objective = _part(get, "objective/")
    if objective and not (np.isin(objective["sides"], [-1, 0, 1]).all() and settlement is not None):
        raise ValueError("objective of a load case")
    return LoadCase(
        name,
        get["dead_load"],
        get["live_load"],
        tuple(map(_applied, get["dead_words"])),
        tuple(map(_applied, get["live_words"])),
        settlement=settlement,
        objective=Objective(**objective) if objective else None,
        travel=TravelPosition(**travel) if travel else None,
        tilt=Tilt(**tilt) if tilt else None,
        pushover=Pushing(**pushed) if (pushed := _part(get, "pushover/")) else None,
        assessment=AssessmentSection.model_validate_json(asked) if (asked := get.get("assessment/asked")) else None,
    )


def _applied(words: str) -> AppliedLoad:
    """A load without its forces, of which the file has the sums alone."""
    on_masses = any(kind in words for kind in ("gravity", "acceleration", "tilt"))
    in_g = words.startswith("acceleration") and ", by height" not in words
    return without_forces(words, on_masses=on_masses, in_g=in_g)


ROUNDING = 1e-6
"""Difference over the size of a block, or of an area over the largest, that is no contradiction."""


@np.errstate(over="ignore", invalid="ignore")  # what is no number is no agreement either
def incoherences(model: Model, contacts: Contacts) -> tuple[str, ...]:
    """Where arrays of a model contradict each other, in words."""
    blocks = model.blocks
    corners = np.diff(blocks.loop_start)
    if np.any(corners < 3) or np.any(np.diff(blocks.face_start) < 1) or np.any(blocks.volumes <= 0.0):
        return ("blocks are no solids",)
    solids = Polyhedra(blocks.vertices, blocks.vertex_start, blocks.loops, blocks.loop_start, blocks.face_start)
    volumes, centroids = volumes_and_centroids(solids)
    found = []
    if not np.allclose(volumes, blocks.volumes, rtol=ROUNDING, atol=0.0):
        found.append("volumes of blocks are not those within their faces")
    extent = float(np.abs(blocks.vertices).max(initial=0.0))
    away = np.abs(centroids - blocks.centroids).max(axis=1)
    if not np.all(away <= ROUNDING * blocks.sizes + 1e-9 * extent):
        found.append("centroids of blocks are not those within their faces")
    if not _off(np.einsum("pix,pjx->pij", contacts.frames, contacts.frames), np.eye(3)) <= ROUNDING:
        found.append("frames of contact points are not orthonormal")
    if not _off(contacts.frames[:, 0], contacts.normals[contacts.interface_of_point]) <= ROUNDING:
        found.append("frames of contact points do not follow the normals of interfaces")
    shares = row_sums(contacts.point_areas, contacts.point_start)
    if not _off(shares, contacts.areas) <= ROUNDING * float(np.abs(contacts.areas).max(initial=0.0)):
        found.append("areas of interfaces are not those of their contact points")
    return tuple(found)


def _off(one: FloatArray, other: FloatArray) -> float:
    return float(np.abs(one - other).max(initial=0.0))
