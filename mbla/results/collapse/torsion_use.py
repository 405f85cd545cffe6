"""How much of an interface shear force and torsion take together, under the normal forces that it has.

A resultant (T, M), M about the normal, is compared with what the interface carries in the same ratio: the use is the
least s for which (T, M)/s can be carried. 1 is failure of the full interface by sliding, twisting or both; without a
moment about the centre of friction it is shear over what friction and cohesion allow, else more.

*Contact points* at x_i that allow the shear a_i = μ N_i + c A_i each. A motion of b against a by slip η and rotation ω
about the normal dissipates at most Σ a_i ‖η + ω × x_i‖, and by the kinematic theorem::

    s = max over (η, ω) of  (T·η + M ω) / Σ a_i ‖η + ω × x_i‖

Every motion gives a lower bound. The maximum lies at a rotation about a contact point, which are tried, or is found by
weighted least squares, each step with the weights a_i/‖v_i‖ of the motion before (Weiszfeld 1937; Andersen et al. 2000,
doi:10.1137/S1064827598343954). How forces are spread over the points of one face does not matter: one that twists its
points against each other without any resultant uses nothing.

*Interface resultants* (contact model convex): the same by the condition of that model
(:mod:`mbla.program.resultants.torsion`), the least s for which (T, M)/s fits it.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray, row_of_item, starts, summed
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.resultants.shapes import local_points
from mbla.results.collapse.interface_modes import interface_radii, sum_by_interface
from mbla.results.collapse.mechanics import interface_resultants
from mbla.results.collapse.thrust import NO_FORCE, ROUNDING, allowed_at_points, shear_use
from mbla.solution.verification.interface_laws import interface_laws, shear_strength, torsion_excess

STEPS = 40
"""of weighted least squares: the use is then at most 1e-3 below the maximum, most often it has all digits"""
NEAREST = 1e-9
"""least speed of a point over the largest of its interface, so that weights stay finite"""
CENTRED = 1e-7
"""moment about the centre of friction, over what the interface carries of it, that counts as none: a residual of forces
that count as solved, which would change the use by its square"""
HALVINGS = 50
"""of the range of the use of resultants"""
EDGE = 1e-6
"""share of the shear strength that is left to an interface whose force is at its edge: residuals of that size are no
torsion"""


def torsion_use(model: Model, contacts: Contacts, contact_forces: FloatArray, contact_model: str) -> FloatArray:
    """Shear force and torsion over what each interface carries of both in their ratio, (n_interfaces,).

    At least ``friction_use``; at most 1, but for residuals, in forces that the joint laws admit. nan where nothing acts
    and nothing is allowed; 0 where friction is unlimited.

    contact_forces : (n_points, 3) N, T1, T2 [N], compression positive
    contact_model  : concave or convex, as in the deck
    """
    allowed = allowed_at_points(model, contacts, contact_forces)
    at_points = np.hypot(contact_forces[:, 1], contact_forces[:, 2])
    shear = np.linalg.norm(sum_by_interface(contacts, contact_forces[:, 1:]), axis=1)
    total = sum_by_interface(contacts, allowed)
    use = shear_use(shear, total)
    acting, least = sum_by_interface(contacts, at_points), NO_FORCE * np.abs(contact_forces).max(initial=0.0)
    chosen = np.flatnonzero((total > least) & np.isfinite(total) & (acting > least))
    if contact_model == "convex":
        use[chosen] = np.fmax(use[chosen], _use_of_resultants(model, contacts, contact_forces)[chosen])
    elif len(chosen):
        use[chosen] = np.fmax(use[chosen], _use_of_points(contacts, chosen, contact_forces[:, 1:], allowed))
    return use


def _use_of_resultants(model: Model, contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
    """The least s of all interfaces by the condition of the convex contact model, by bisection, (n_interfaces,)."""
    frames = contacts.frames[contacts.point_start[:-1]]
    resultants = interface_resultants(contacts, contact_forces)
    resultants = np.hstack([np.einsum("nij,nj->ni", frames, part) for part in (resultants[:, :3], resultants[:, 3:])])
    laws = interface_laws(model, contacts, "convex")
    strength = np.maximum(shear_strength(laws, resultants)[0], 1e-300)
    acting = np.hypot(np.hypot(resultants[:, 1], resultants[:, 2]), resultants[:, 3] / laws.shapes.radii)
    low, high = np.zeros(len(contacts)), 2.0 * strength / np.maximum(acting, 1e-300)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        factors = np.ones((len(contacts), 6))
        factors[:, 1:4] = middle[:, None]
        fits = torsion_excess(laws, factors * resultants) <= EDGE * strength
        low, high = np.where(fits, middle, low), np.where(fits, high, middle)
    with np.errstate(divide="ignore"):
        return np.asarray(np.where(acting > 0, 1.0 / low, 0.0))


def _use_of_points(contacts: Contacts, chosen: IntArray, shears: FloatArray, allowed: FloatArray) -> FloatArray:
    """The least s of the chosen interfaces, (n,), by the points that allow any shear."""
    sizes = np.diff(contacts.point_start)[chosen]
    owner = row_of_item(starts(sizes))
    point = contacts.point_start[chosen][owner] + np.arange(len(owner)) - starts(sizes)[owner]
    arms, forces, weights = local_points(contacts)[point], shears[point], allowed[point]
    total = summed(owner, weights, len(chosen))
    centre = summed(owner, weights[:, None] * arms, len(chosen)) / total[:, None]
    arms = arms - centre[owner]  # about the centre of friction
    length = summed(owner, weights * np.linalg.norm(arms, axis=1), len(chosen)) / total
    spread = length > ROUNDING * interface_radii(contacts)[chosen]
    arms = arms / np.where(spread, length, 1.0)[owner, None]
    force = summed(owner, forces, len(chosen)) / total[:, None]
    moment = summed(owner, arms[:, 0] * forces[:, 1] - arms[:, 1] * forces[:, 0], len(chosen)) / total
    load = np.column_stack([force, moment])
    found = np.linalg.norm(force, axis=1)
    turned = np.flatnonzero((np.abs(moment) > CENTRED) & spread)
    if len(turned):
        row = np.full(len(chosen), -1)
        row[turned] = np.arange(len(turned))
        inside = row[owner] >= 0
        shares = weights[inside] / total[owner[inside]]
        points = _Points(row[owner[inside]], arms[inside], shares)
        found[turned] = np.maximum(found[turned], _largest_ratio(points, load[turned]))
    return np.asarray(found)


class _Points:
    """Contact points of n interfaces: whose they are, where, (p, 2), and their shares a_i of what is allowed."""

    def __init__(self, owner: IntArray, arms: FloatArray, shares: FloatArray) -> None:
        self.owner, self.arms, self.shares = owner, arms, shares
        self.count = int(owner.max()) + 1
        self.maps = np.zeros((len(owner), 2, 3))  # from (η, ω) to the velocity of the point
        self.maps[:, 0, 0] = self.maps[:, 1, 1] = 1.0
        self.maps[:, 0, 2], self.maps[:, 1, 2] = -arms[:, 1], arms[:, 0]

    def speeds(self, motions: FloatArray) -> FloatArray:
        """Of the points, (p,), in motions of their interfaces, (n, 3)."""
        return np.asarray(np.linalg.norm(np.einsum("pij,pj->pi", self.maps, motions[self.owner]), axis=1))

    def ratio(self, loads: FloatArray, motions: FloatArray) -> FloatArray:
        """Power of the loads over the most that the points dissipate, (n,)."""
        power = np.einsum("ni,ni->n", loads, motions)
        dissipated = summed(self.owner, self.shares * self.speeds(motions), self.count)
        return np.asarray(np.abs(power) / np.maximum(dissipated, 1e-300))

    def balanced(self, loads: FloatArray, weights: FloatArray) -> FloatArray:
        """Motions, (n, 3) of length 1, in which forces weights × velocity of the points balance the loads."""
        matrices = summed(self.owner, weights[:, None, None] * self.maps.transpose(0, 2, 1) @ self.maps, self.count)
        diagonal = np.einsum("nii->ni", matrices)
        ridge = (1e-13 * diagonal)[:, :, None] * np.eye(3)  # where all points but one rest there is little else
        matrices = matrices + ridge
        motions = np.linalg.solve(matrices, loads[:, :, None])[:, :, 0]
        return np.asarray(motions / np.linalg.norm(motions, axis=1)[:, None])


def _largest_ratio(points: _Points, loads: FloatArray) -> FloatArray:
    """Maximum over motions of interfaces, (n,)."""
    best = np.zeros(len(loads))
    last = np.searchsorted(points.owner, np.arange(points.count), side="right")
    first = np.searchsorted(points.owner, np.arange(points.count), side="left")
    for k in range(int((last - first).max())):  # rotations about the k-th point of each
        at = points.arms[np.minimum(first + k, last - 1)]
        best = np.maximum(best, points.ratio(loads, np.column_stack([at[:, 1], -at[:, 0], np.ones(len(at))])))
    weights = points.shares
    for _ in range(STEPS):
        motions = points.balanced(loads, weights)
        best = np.maximum(best, points.ratio(loads, motions))
        speeds = points.speeds(motions)
        largest = np.zeros(points.count)
        np.maximum.at(largest, points.owner, speeds)
        weights = points.shares / np.maximum(speeds, NEAREST * largest[points.owner])
    return best
