"""Thrust: where the resultant of each interface acts, how much of the joint it uses, and lines of thrust along chains.

The contact forces of an interface amount to a force F through one point of its plane and a moment about its normal.
With the moment M about the centroid c and the normal force N = F·n, that point (the centre of pressure) is
p = c + n × M / N. Its eccentricity is measured by the hull of the contact points: the factor by which the hull must be
scaled about c to have p on its edge, so 0 is central, 1 is at the edge; no tension means at most 1. Where the hull is
symmetric about c that is the distance over the half-width in the same direction (Heyman 1966,
doi:10.1016/0020-7683(66)90018-7, measures the safety of an arch in this way).

Where every block of a row has one interface before it and one behind it, as in an arch, a column or a pier, the centres
of pressure in their order are the line of thrust.

Contact forces need not be unique, and what follows from them is not either; resultants of a statically determinate
chain are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.assemble import yield_limits
from mbla.results.collapse.interface_modes import sum_by_interface
from mbla.results.collapse.mechanics import interface_resultants

NO_FORCE = 1e-7
"""share of the largest normal force up to which an interface has no point of application: the residual of forces that
count as solved is of that size, and the point would be anywhere"""
ROUNDING = 1e-9
"""relative to the size of an interface: extents below it count as zero"""


@dataclass(frozen=True)
class Thrust:
    """What the forces of each interface amount to; on body b, in the deck's axes.

    forces        : (n_interfaces, 3) N
    points        : (n_interfaces, 3) m, where they act in the plane of the interface; nan where it is not pressed
    normal_forces : (n_interfaces,) N, compression positive
    shear_forces  : (n_interfaces,) N, the size of the resultant along the interface
    torsions      : (n_interfaces,) N m, moment about the normal through the centroid
    eccentricity  : (n_interfaces,) 0 central, 1 at the edge, more only with tensile strength; nan where it is not
                    pressed
    friction_use  : (n_interfaces,) shear over what friction and cohesion allow under the normal force, torsion left
                    out (:mod:`mbla.results.collapse.torsion_use` has both); nan where they allow none and none acts
    """

    forces: FloatArray
    points: FloatArray
    normal_forces: FloatArray
    shear_forces: FloatArray
    torsions: FloatArray
    eccentricity: FloatArray
    friction_use: FloatArray

    @property
    def carried(self) -> BoolArray:
        """Interfaces that are pressed in total, (n_interfaces,)."""
        return np.asarray(np.isfinite(self.points[:, 0]))

    @property
    def unpressed(self) -> BoolArray:
        """Interfaces with a force but no compression in total, (n_interfaces,).

        That is tension, or shear that cohesion takes.
        """
        sizes = np.linalg.norm(self.forces, axis=1)
        return np.asarray(~self.carried & (sizes > NO_FORCE * sizes.max(initial=0.0)))


def thrust_of(model: Model, contacts: Contacts, contact_forces: FloatArray) -> Thrust:
    """Resultants, their points of application and how much of the joint they use.

    contact_forces : (n_points, 3)  N, T1, T2 [N], compression positive
    """
    resultants = interface_resultants(contacts, contact_forces)
    forces, moments, normals = resultants[:, :3], resultants[:, 3:], contacts.normals
    normal = np.einsum("ij,ij->i", forces, normals)
    shear = np.linalg.norm(forces - normal[:, None] * normals, axis=1)
    carried = normal > NO_FORCE * np.abs(normal).max(initial=0.0)
    arms = np.full_like(forces, np.nan)
    arms[carried] = np.cross(normals[carried], moments[carried]) / normal[carried, None]
    return Thrust(
        forces=forces,
        points=contacts.centroids + arms,
        normal_forces=normal,
        shear_forces=shear,
        torsions=np.einsum("ij,ij->i", moments, normals),
        eccentricity=_eccentricity(contacts, arms),
        friction_use=shear_use(shear, sum_by_interface(contacts, allowed_at_points(model, contacts, contact_forces))),
    )


OUTSIDE = 1.01
"""eccentricity beyond which a resultant acts outside its joint, and not at the edge but for rounding"""


def points_to_draw(contacts: Contacts, thrust: Thrust) -> FloatArray:
    """Where resultants are drawn, (n_interfaces, 3) m: outside their joint at its edge; nan where it is not pressed.

    Tension lets a force act metres beyond its joint, where its mark would shrink the structure and show nothing.
    """
    arms = thrust.points - contacts.centroids
    return np.asarray(contacts.centroids + arms / np.maximum(thrust.eccentricity, 1.0)[:, None])


def point_friction_use(model: Model, contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
    """Shear over what friction and cohesion allow at each contact point, (n_points,); nan where none is allowed."""
    allowed = allowed_at_points(model, contacts, contact_forces)
    return shear_use(np.hypot(contact_forces[:, 1], contact_forces[:, 2]), allowed)


def allowed_at_points(model: Model, contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
    """Shear that friction under the normal forces and cohesion allow each contact point, (n_points,) N; c A + μ N.

    Tension takes from cohesion what pressure adds to it.
    """
    limits, normal = yield_limits(model, contacts), contact_forces[:, 0]
    # unlimited friction allows none where nothing presses
    by_friction = np.where((normal > 0) | np.isfinite(limits.friction), limits.friction, 0.0) * normal
    return np.asarray(np.maximum(by_friction + limits.cohesion, 0.0))


def shear_use(shear: FloatArray, allowed: FloatArray) -> FloatArray:
    """Ratio, (n,) of forces (n,) N each; nan where both vanish, measured by the largest force."""
    finite = allowed[np.isfinite(allowed)]
    nothing = ROUNDING * max(finite.max(initial=0.0), shear.max(initial=0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where((allowed <= nothing) & (shear <= nothing), np.nan, shear / allowed)


def _eccentricity(contacts: Contacts, arms: FloatArray) -> FloatArray:
    """Gauge of the hull of each interface at the point of application: the largest over directions d of d·r / h(d).

    h(d) is the extent of the hull from the centroid along d; the largest is found among the normals of its edges.
    """
    gauge = np.full(len(contacts), np.nan)
    sizes = np.diff(contacts.point_start)
    shapes, shape = np.unique(np.column_stack([contacts.outline, sizes]), axis=0, return_inverse=True)
    for row, (outline, count) in enumerate(shapes.tolist()):
        chosen = np.flatnonzero((shape.ravel() == row) & np.isfinite(arms[:, 0]))
        if len(chosen):
            points = contacts.points[contacts.point_start[chosen][:, None] + np.arange(count)]
            points = points - contacts.centroids[chosen][:, None, :]
            directions = _edge_normals(points[:, :outline], contacts.normals[chosen])
            gauge[chosen] = _gauge(points, directions, arms[chosen])
    return gauge


def _edge_normals(outline: FloatArray, normals: FloatArray) -> FloatArray:
    """Candidates for the normals of the hull's edges, in the plane of the interface, (n, candidates, 3).

    The sides of a convex outline are its edges; of any other the hull has edges between corners that are not
    neighbours. Along the sides too, for points that lie on one line.
    """
    following = np.roll(outline, -1, axis=1)
    sides = following - outline
    if _any_reentrant(sides, normals):
        first, second = np.triu_indices(outline.shape[1], 1)
        sides = outline[:, second] - outline[:, first]
    across = np.cross(sides, normals[:, None, :])
    return np.asarray(np.concatenate([across, -across, sides, -sides], axis=1))


def _any_reentrant(sides: FloatArray, normals: FloatArray) -> bool:
    turns = np.einsum("nsi,ni->ns", np.cross(sides, np.roll(sides, -1, axis=1)), normals)
    size = np.square(sides).sum(axis=2).max(axis=1, initial=0.0)
    return bool((turns < -ROUNDING * size[:, None]).any())


def _gauge(points: FloatArray, directions: FloatArray, arms: FloatArray) -> FloatArray:
    """Largest of d·r / h(d) over the directions, 0 or more, (n,); h the largest of d·p over the points p."""
    extent = np.einsum("nsi,npi->nsp", directions, points).max(axis=2)
    along = np.einsum("nsi,ni->ns", directions, arms)
    size = np.linalg.norm(directions, axis=2) * np.linalg.norm(points, axis=2).max(axis=1)[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(extent > ROUNDING * size, along / extent, 0.0)
    return np.asarray(ratio.max(axis=1, initial=0.0))


# --- chains -------------------------------------------------------------------------------------------------------


def interface_chains(bodies: RigidBodies) -> tuple[IntArray, ...]:
    """Interfaces in their order along each row of blocks that has one interface before each block and one behind it.

    Rows have at least two such blocks, and so three interfaces: one block alone with two interfaces is every corner of
    a wall. A closed ring starts and ends with the same interface. Blocks that are glued to each other count as one;
    supports and blocks with another number of interfaces end a row.
    """
    model, pairs = bodies.model, bodies.contacts.bodies
    n_bodies = len(model.blocks)
    degree = np.bincount(pairs.ravel(), minlength=n_bodies + len(model.grounds))[:n_bodies]
    inner = ~model.fixed & (degree == 2)
    neighbours: list[list[int]] = [[] for _ in range(len(pairs))]
    ends, side = np.nonzero(np.append(inner, np.zeros(len(model.grounds), dtype=bool))[pairs])
    if not len(ends):
        return ()
    owner = pairs[ends, side]
    order = np.argsort(owner, kind="stable")
    for first, second in ends[order].reshape(-1, 2).tolist():
        neighbours[first].append(second)
        neighbours[second].append(first)
    return tuple(_walks(neighbours))


def _walks(neighbours: list[list[int]]) -> list[IntArray]:
    """Paths and rings of three nodes and more of a graph whose nodes have at most two neighbours."""
    seen = [not near for near in neighbours]
    walks = []
    starts = [i for i, near in enumerate(neighbours) if len(near) == 1]
    for start in (*starts, *range(len(neighbours))):  # paths from their ends first, then the rest: rings
        if seen[start]:
            continue
        walk, here = [start], start
        seen[start] = True
        while (ahead := next((i for i in neighbours[here] if not seen[i]), None)) is not None:
            seen[ahead] = True
            walk.append(ahead)
            here = ahead
        if len(neighbours[start]) == 2:
            walk.append(start)
        walks.append(np.array(walk, dtype=np.int64))
    return [walk for walk in walks if len(walk) > 2]


def thrust_lines(bodies: RigidBodies, thrust: Thrust) -> tuple[IntArray, ...]:
    """Lines of thrust as interfaces in their order, (n,) each; a chain is cut where an interface carries nothing."""
    lines = []
    for chain in interface_chains(bodies):
        cuts = np.flatnonzero(~thrust.carried[chain])
        lines += [piece[thrust.carried[piece]] for piece in np.split(chain, cuts)]
    return tuple(line for line in lines if len(line) > 1)


PARALLEL = 0.01
"""sine of the angle between two joints next but one to each other up to which they are parallel: half a degree"""


def curvature_sides(bodies: RigidBodies) -> FloatArray:
    """Direction out of the curve where blocks form a chain, as in an arch, (n_interfaces, 3); zero elsewhere.

    Of three joints that follow each other the middle one lies outside the line between the other two by the rise of the
    curve there. (The centroids of thick voussoirs, which are wedges, lie outside the curve of the joints themselves.)
    A pile that leans over has parallel joints and is no curve.
    A joint at the end of a chain takes the direction of the next one. Blocks that are glued count as one.
    """
    centroids, normals = bodies.contacts.centroids, bodies.contacts.normals
    outward = np.zeros_like(centroids)
    for chain in interface_chains(bodies):
        ring = chain[0] == chain[-1]
        first, middle, last = chain[:-2], chain[1:-1], chain[2:]
        if ring:
            middle = chain[1:]
            first, last = np.roll(middle, 1), np.roll(middle, -1)
        chord, rise = centroids[last] - centroids[first], centroids[middle] - (centroids[first] + centroids[last]) / 2
        length = np.linalg.norm(chord, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            rise -= (np.einsum("ij,ij->i", rise, chord) / length**2)[:, None] * chord
        turned = np.linalg.norm(np.cross(normals[first], normals[last]), axis=1)
        curved = np.linalg.norm(rise, axis=1) > 1e-3 * length  # none where two blocks meet in two joints: no chord
        curved &= turned > PARALLEL
        outward[middle[curved]] = rise[curved]
        if not ring:
            outward[chain[[0, -1]]] = outward[chain[[1, -2]]]
    return outward
