"""The Lagrangian of the load-factor problem at the forces and the mechanism that solve it.

With the motion u of the blocks (lᵀu = 1), contact forces f, the plastic motion w of the contact points and loads d, l::

    L(p) = λ − (d + λ l)·u − f·(v − w) + Σ [c s + f_t o + f_c k] + interfaces + ties,     v = A(p)ᵀu

where w_N = μ s + o − k by sliding s = ‖w_T‖, opening o and crushing k. L has the value λ, and at a solution its
derivative for fixed f, u, w is that of λ (envelope theorem; Danskin 1967): no further problem is solved. A, d, l and
the strengths go by p, each of these the law's times an area. A tie with the force τ that gets
longer by e, and by e₀ as it yields, adds τ (e − e₀) + T e₀ with T its greatest force, its least one where e₀ < 0.

Where forces or mechanism are not unique the derivatives to both sides differ, and this one lies between them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import Joint
from mbla.model.ties.moved import elongations
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.further.sensitivity.structures import LoadedAssembly
from mbla.solution.solution import Mechanics, Solution
from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.interface_laws import crushing_power
from mbla.solution.verification.statics import power
from mbla.solution.verification.verify_convex import InterfaceCase


@dataclass(frozen=True)
class State:
    """What solves the problem, and what follows of plastic motions.

    mechanism : (n_blocks, 6) for unit live power, about ``centroids``, (n_blocks, 3)
    forces    : (n_points, 3) N, compression positive
    shear     : (n_points, 2) plastic sliding w_T
    sliding, opening, crushing : (n_points,) s, o, k
    tie_forces, elongation : (n_ties,) τ in N, tension positive, and e₀
    motions   : (n_interfaces, 2, 6) of interfaces that crush; None where conditions hold on points alone
    """

    load_factor: float
    mechanism: FloatArray
    centroids: FloatArray
    forces: FloatArray
    shear: FloatArray
    sliding: FloatArray
    opening: FloatArray
    crushing: FloatArray
    tie_forces: FloatArray
    elongation: FloatArray
    motions: FloatArray | None
    contact_model: str


def state_of(structure: LoadedAssembly, solution: Solution, associative: Mechanics) -> State:
    """The associative state of a solution."""
    motions = associative.interface_motions
    case = _case(structure, motions, solution.contact_model)
    w = case.velocities(associative.mechanism) - case.interface_velocities(motions)[0]
    sliding = np.hypot(w[:, 1], w[:, 2])
    surplus = w[:, 0] - case.limits.friction * sliding
    crushable, known = np.isfinite(case.limits.compression), associative.tie_forces
    return State(
        load_factor=associative.load_factor,
        mechanism=associative.mechanism,
        centroids=structure.model.blocks.centroids,
        forces=associative.contact_forces,
        shear=w[:, 1:],
        sliding=sliding,
        opening=np.where(crushable, np.maximum(surplus, 0.0), surplus),
        crushing=np.where(crushable, np.maximum(-surplus, 0.0), 0.0),
        tie_forces=np.zeros(len(structure.model.ties)) if known is None else np.nan_to_num(known),
        elongation=elongations(structure.model.blocks, structure.model.ties, associative.mechanism),
        motions=motions,
        contact_model=solution.contact_model,
    )


def _case(structure: LoadedAssembly, motions: FloatArray | None, contact_model: str) -> LoadedModel:
    parts = structure.model, structure.contacts, structure.load_case
    return LoadedModel(*parts) if motions is None else InterfaceCase(*parts, contact_model)


def lagrangian(structure: LoadedAssembly, state: State) -> float:
    """L for the forces and the motion of a state, in a structure that may be another than the one they solve."""
    case = _case(structure, state.motions, state.contact_model)
    motion = structure.moved_along(state.mechanism, state.centroids)
    dead, live = case.powers(motion)
    v = case.velocities(motion) - case.interface_velocities(state.motions)[0]
    longer = elongations(structure.model.blocks, structure.model.ties, motion)
    of_ties = float((state.tie_forces * (longer - state.elongation)).sum())
    given = state.load_factor * (1.0 - live) - dead
    return given - float((state.forces * v).sum()) + of_ties + resistance(structure, state)


def resistance(structure: LoadedAssembly, state: State) -> float:
    """f·w and what joints and ties dissipate: all in which their strengths are, and linear in each of them."""
    case = _case(structure, state.motions, state.contact_model)
    limits: YieldLimits = case.limits
    plastic_normal = limits.friction * state.sliding + state.opening - state.crushing
    compression = np.where(state.crushing > 0.0, limits.compression, 0.0)
    terms = (
        state.forces[:, 0] * plastic_normal,
        (state.forces[:, 1:] * state.shear).sum(axis=1),
        limits.cohesion * state.sliding,
        limits.tension * state.opening,
        compression * state.crushing,
    )
    ties = structure.model.ties
    capacity = np.where(state.elongation > 0.0, ties.greatest, ties.least)
    yields = np.isfinite(capacity)
    total = float(sum(term.sum() for term in terms)) + float(capacity[yields] @ state.elongation[yields])
    if isinstance(case, InterfaceCase) and state.motions is not None:
        total += float(crushing_power(case.laws, state.motions[:, 1]).sum())
    return total


def load_power(structure: LoadedAssembly, state: State) -> tuple[float, float]:
    """Power of dead and of live load."""
    case, mechanism = structure.load_case, state.mechanism
    return power(case.dead_load, mechanism), power(case.live_load, mechanism)


def pressure_on(structure: LoadedAssembly, state: State, law: Joint) -> float:
    """Mean pressure on the joints of a law: a step for a strength that is zero; 1 where nothing presses."""
    contacts = structure.contacts
    here = np.array(contacts.joint_names)[contacts.joints[contacts.interface_of_point]] == law.name
    pressed = float(np.abs(state.forces[here, 0]).sum() / contacts.point_areas[here].sum())
    return pressed if pressed > 0.0 else 1.0
