"""Decks and settings of every kind that a sweep may vary, and a run put as text, to compare runs bit for bit."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from mbla.deck import read_deck
from mbla.process.run_options import RunOptions
from mbla.results.results import Results
from mbla.results.status_file import StatusFile
from mbla.run import solve_deck
from mbla.solution.standing.standing import StressFreeStates
from mbla.sweeps.plan import Plain, override_texts

DECKS = Path(__file__).parents[3] / "decks"
Settings = Mapping[str, Plain]

ARCH = "benchmarks/closed_forms/arch_20_voussoirs.yaml"
SMALL_ARCH: dict[str, Plain] = {"blocks.0.arch.voussoirs": 7}
VARIED: dict[str, tuple[Settings, ...]] = {
    ARCH: (
        SMALL_ARCH,
        {**SMALL_ARCH, "parameters.mu": 0.5},
        {**SMALL_ARCH, "load_cases.push_x.live.0.acceleration": [0.6, 0.8, 0]},
        {**SMALL_ARCH, "parameters.mu": 0.5, "load_cases.push_x.live.0.acceleration": [0.6, 0.8, 0]},
        {**SMALL_ARCH, "load_cases.push_x.live.0.acceleration": [-1, 0, 0]},
        {**SMALL_ARCH, "parameters.t": 0.2},
        {**SMALL_ARCH, "parameters.t": 0.02},  # too thin to stand
        {**SMALL_ARCH, "materials.stone.density": 2400},
        {**SMALL_ARCH, "joints.dry.cohesion": 1e4},
        {**SMALL_ARCH, "joints.dry.dilatancy": 10, "analysis.flow_rule": "dilatancy"},
        {**SMALL_ARCH, "contacts.tolerance": 1e-4},
        {**SMALL_ARCH, "contacts.points": {"spacing": 0.1}},
        {**SMALL_ARCH, "contacts.points": {"spacing": -1}},  # refused
        {**SMALL_ARCH, "units.force": "kN"},
        {**SMALL_ARCH, "analysis.flow_rule": "associative"},
        {**SMALL_ARCH, "analysis.reductions": False},
        {**SMALL_ARCH, "analysis.accuracy": "draft"},
    ),
    "benchmarks/closed_forms/beam_under_travelling_load.yaml": (
        {},
        {"parameters.F": 20000},
        {"joints.dry.friction": 0.5},
    ),
    "benchmarks/closed_forms/glued_lintel.yaml": (
        {},
        {"parameters.t": 0.5},
        {"contacts.overrides.0.joint": "open"},
        {"contacts.overrides.0.joint": "dry"},
        {"contacts.overrides.0.joint": "frictionless"},
    ),
    "benchmarks/closed_forms/torque_convex.yaml": ({}, {"parameters.mu": 0.5}, {"parameters.ecc": 0.2}),
    "benchmarks/closed_forms/open_and_frictionless_joints.yaml": ({}, {"parameters.mu": 0.5}, {"parameters.h": 0.4}),
    "benchmarks/closed_forms/tilting_block.yaml": ({}, {"parameters.mu": 0.7}, {"parameters.h": 1.0}),
    "benchmarks/closed_forms/guided_blocks.yaml": ({}, {"supports.1.fixed": ["rx", "ry"]}, {"parameters.mu": 0.4}),
    "benchmarks/closed_forms/moment_and_pressure.yaml": ({}, {"parameters.h": 1.0}),
    "benchmarks/formats/arch_from_obj.yaml": ({}, {"parameters.mu": 0.6}, {"blocks.0.mesh.units": "mm"}),
    "benchmarks/closed_forms/bar_between_walls.yaml": ({}, {"parameters.mu": 0.3}),
    "tutorials/settling_wall.yaml": (
        {"parameters.n": 4, "blocks.0.wall.courses": 3},
        {"parameters.n": 4, "blocks.0.wall.courses": 3, "parameters.mu": 0.5},
        {"parameters.n": 4, "blocks.0.wall.courses": 3, "load_cases.sinks.settlement.direction": [0.6, 0, -0.8]},
    ),
    "tutorials/half_of_a_front.yaml": ({}, {"parameters.mu": 0.5}),
    "tutorials/random_wall.yaml": (
        {"parameters.n": 3, "parameters.seed": 1},
        {"parameters.n": 3, "parameters.seed": 2},
        {"parameters.n": 3, "parameters.seed": 1, "joints.dry.friction": 0.5},
    ),
}
"""settings by deck"""

NOT_COMPARED = ("seconds", "created", "sources", "time", "provenance")
"""fields of records: times, and what is the same in every run"""


def solved(deck: str, settings: Settings, states: StressFreeStates | None = None) -> str:
    """The whole run in words, or the error that it ends with."""
    try:
        read = read_deck(DECKS / deck, override_texts(settings))
        return "\n".join(stated(solve_deck(read, RunOptions(), StatusFile(io.StringIO(), ""), None, 0.0, states)))
    except Exception as error:
        return f"{type(error).__name__}: {error}"


def stated(value: Results | Any, place: str = "") -> Iterator[str]:
    """One line for every number, text and array, with its bits."""
    if isinstance(value, np.ndarray):
        yield f"{place} {value.dtype} {value.shape} {value.tobytes().hex()}"
    elif isinstance(value, sp.csr_array):
        yield from stated([value.shape, value.data, value.indices, value.indptr], place)
    elif is_dataclass(value):
        for field in fields(value):
            if field.name not in NOT_COMPARED:
                yield from stated(getattr(value, field.name), f"{place}.{field.name}")
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from stated(item, f"{place}.{key}")
    elif isinstance(value, (list, tuple)):
        for number, item in enumerate(value):
            yield from stated(item, f"{place}.{number}")
    elif isinstance(value, float):
        yield f"{place} {value.hex()}"
    else:
        assert value is None or isinstance(value, (str, int, bool, np.generic, Enum)), f"{place} {value!r}"
        yield f"{place} {value!r}"
