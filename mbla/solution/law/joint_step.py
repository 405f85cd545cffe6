"""One primal–dual step on the equations of elastic joints: residuals, elimination joint by joint, length.

Each joint is eliminated from the linearised equations of :mod:`mbla.solution.law.elastic_joints`, so that one
factorisation of A C Aᵀ, bordered by the live load, remains. With cone = l I − t tᵀ/l::

    H = cone/(k_T h) + s I − t wᵀ/l,   h_v = H⁻¹ μ (w − s t/l),   b = (δ/l)(t/(k_T h) + w)
    a = 1/(k_N h) + y/N + z/room + δ s μ/l − b·h_v
    g_t' = H⁻¹(r_q − t r_p/l − cone m_t),   g_n = [r_n/N − m_n − r_z/room + (δ/l)(r_p − t·m_t) − b·g_t']/a
    dn = g_n + [−dv_n − (δ/l) t·dv_t + b·H⁻¹cone dv_t]/a,    dt = g_t' − H⁻¹cone dv_t − h_v dn

m are the residuals of compatibility, r the changes wanted of the products. Without dilatancy the normal force does not
see the sliding while the sliding sees the normal force: the matrix is not symmetric. The direction goes towards
products σ; where it is blocked early, second-order terms are taken in (Mehrotra 1992, doi:10.1137/0802028), then
corrections of products that lie far off (Gondzio 1996, doi:10.1007/BF00249643).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.cone_vectors import cones_to_boundary, lines_to_boundary
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState, lengths
from mbla.solution.law.interface_law import EliminatedInterface, InterfaceState
from mbla.solution.linear_algebra.stiffness import BorderedFactors

LONG = 0.9
"""Share of a direction from which it is gone without corrections."""

CORRECTIONS, BEYOND, GAIN, FAR_OFF = 2, 0.3, 0.03, 10.0
"""Corrections of outlying products at most; how far beyond the end of the step they look; by how much one must make the
step longer to be kept; factor from σ from which a product is outlying."""

SHARE = 0.95
"""Share of the way to the boundary that a step goes."""

SHIFT = 1e-14
"""Share of the stiffness of all joints that is added on the diagonal: a block whose joints all open has none."""


@dataclass(frozen=True)
class JointStep:
    """An implicit step.

    memory : of the joints before it
    length : h
    driven : whether the live work f_L·u is 1; else the load factor stays and the structure finds its rest
    held   : (n_rows,) stiffness of springs that hold the blocks where they are; none unless given
    """

    joints: ElasticJoints
    memory: Memory
    length: float
    driven: bool = True
    held: FloatArray | float = 0.0

    @property
    def normal_compliance(self) -> FloatArray:
        """1/(k_N h), (n_points,)."""
        return 1.0 / (self.joints.normal * self.length)

    @property
    def shear_compliance(self) -> FloatArray:
        """1/(k_T h), (n_points,)."""
        return 1.0 / (self.joints.shear * self.length)

    def motions(self, u: FloatArray) -> list[FloatArray]:
        """v_r + Ψ̄/h of each law of interfaces, (components, m)."""
        return [
            v + before / self.length for v, before in zip(self.joints.motions(u), self.memory.interfaces, strict=True)
        ]


@dataclass(frozen=True)
class Products:
    """Products of the law, or changes wanted of them.

    normal   : (n_points,) N y                crushing : (n_crushable,) (f_c − n) z
    sliding  : (n_points,) l s + t·w          turning  : (components − 1, n_points) l w + s t
    interfaces : g z of each law of interfaces, (k, m)
    """

    normal: FloatArray
    sliding: FloatArray
    turning: FloatArray
    crushing: FloatArray
    interfaces: tuple[FloatArray, ...] = ()

    def plus(self, other: Products) -> Products:
        """The sum of both."""
        sums = {key: mine + getattr(other, key) for key, mine in vars(self).items() if key != "interfaces"}
        of_laws = tuple(a + b for a, b in zip(self.interfaces, other.interfaces, strict=True))
        return Products(**sums, interfaces=of_laws)

    def towards(self, sigma: float, joints: ElasticJoints) -> Products:
        """Changes that bring them all to σ."""
        return Products(
            normal=sigma - self.normal,
            sliding=sigma - self.sliding,
            turning=-self.turning,
            crushing=sigma - self.crushing,
            interfaces=tuple(
                law.conditions.weight * sigma - one for law, one in zip(joints.laws, self.interfaces, strict=True)
            ),
        )


@dataclass(frozen=True)
class Residual:
    """What a state leaves of the equations.

    balance       : (n_rows + 1,) unbalanced forces, and f_L·u − 1
    normal, shear : (n_points,), (components − 1, n_points) incompatible velocities m_n, m_t
    products      : of the law
    interfaces    : of the flow of each law of interfaces, (components, m)
    """

    balance: FloatArray
    normal: FloatArray
    shear: FloatArray
    products: Products
    interfaces: tuple[FloatArray, ...] = ()

    @property
    def unbalanced(self) -> float:
        """Largest entry of the balance, in mean loads of a block."""
        return float(np.abs(self.balance).max(initial=0.0))

    def incompatible(self, joints: ElasticJoints, state: StepState) -> float:
        """Largest incompatible velocity over the largest velocity of a contact."""
        most = max(float(np.abs(self.normal).max(initial=0.0)), float(np.abs(self.shear).max(initial=0.0)))
        return most / max(float(np.abs(joints.velocities(state.u)).max(initial=0.0)), 1e-300)


def residual_of(step: JointStep, state: StepState) -> Residual:
    """What a state leaves of the equations of a step."""
    joints, program = step.joints, step.joints.program
    v, memory = joints.velocities(state.u), step.memory
    work = float(program.live_load @ state.u) - 1.0 if step.driven else 0.0
    normal = v[0] + step.normal_compliance * (state.normal - memory.normal) - state.opening
    if joints.dilates:
        normal = normal - joints.dilatancy * state.speed
    normal[joints.crushable] += state.crushing
    shear = v[1:] + step.shear_compliance * (state.shear - memory.shear) - state.slip
    balance = joints.unbalanced(state) - step.held * state.u
    flows = zip(joints.laws, state.interfaces, step.motions(state.u), strict=True)
    interfaces = tuple(law.residual(one, state.normal, motion) for law, one, motion in flows)
    return Residual(np.append(balance, work), normal, shear, products_of(joints, state), interfaces)


def products_of(joints: ElasticJoints, state: StepState) -> Products:
    """Products of the law in a state."""
    limit = joints.limit(state.normal)
    return Products(
        normal=(state.normal + joints.program.limits.tension) * state.opening,
        sliding=limit * state.speed + (state.shear * state.slip).sum(axis=0),
        turning=limit * state.slip + state.speed * state.shear,
        crushing=joints.room(state.normal) * state.crushing,
        interfaces=tuple(
            law.products(one, state.normal) for law, one in zip(joints.laws, state.interfaces, strict=True)
        ),
    )


def direction_of(step: JointStep, state: StepState, residual: Residual, sigma: float) -> tuple[StepState, float] | None:
    """Direction towards products σ and how much of it stays within the law, at most 1; None where it is singular."""
    linear = Eliminated.at(step, state)
    if linear is None:
        return None
    joints = step.joints
    wanted = residual.products.towards(sigma, joints)
    direction = linear.direction(residual, wanted)
    if not np.isfinite(direction.u).all():
        return None
    reach = min(1.0, reach_of(joints, state, direction))
    if reach > LONG:
        return direction, reach
    wanted = wanted.plus(_second_order(linear, direction, reach * reach))
    trial = linear.direction(residual, wanted)
    longer = min(1.0, reach_of(joints, state, trial))
    if longer > reach:
        direction, reach = trial, longer
    for _ in range(CORRECTIONS):
        if reach > LONG:
            break
        ahead = state.plus(direction, min(1.0, reach + BEYOND))
        wanted = wanted.plus(_outlying(joints, products_of(joints, ahead), sigma))
        trial = linear.direction(residual, wanted)
        longer = min(1.0, reach_of(joints, state, trial))
        if longer < reach + GAIN:
            break
        direction, reach = trial, longer
    return direction, reach


def length_of(reach: float) -> float:
    """How far a step goes whose direction stays within the law up to ``reach``."""
    return reach if reach >= 1.0 else SHARE * reach


def reach_of(joints: ElasticJoints, state: StepState, direction: StepState) -> float:
    """How much of a direction leaves every joint within its law; infinite where none binds."""
    lines = (
        (state.normal + joints.program.limits.tension, direction.normal),
        (state.opening, direction.opening),
        (joints.room(state.normal), -direction.normal[joints.crushable]),
        (state.crushing, direction.crushing),
    )
    cones = (
        (joints.limit(state.normal), state.shear, joints.friction * direction.normal, direction.shear),
        (state.speed, state.slip, direction.speed, direction.slip),
    )
    reach = [float(lines_to_boundary(value, change).min(initial=np.inf)) for value, change in lines]
    for radius, vector, growth, turn in cones:
        inside = np.maximum(radius * radius - (vector * vector).sum(axis=0), 0.0)
        mixed, ahead = radius * growth - (vector * turn).sum(axis=0), growth * growth - (turn * turn).sum(axis=0)
        reach.append(float(cones_to_boundary(inside, mixed, ahead).min(initial=np.inf)))
    most = min(reach)
    for law, own, change in zip(joints.laws, state.interfaces, direction.interfaces, strict=True):
        most = law.reach(own, change, state.normal, direction.normal, min(1.0, most))
    return most


def _second_order(linear: Eliminated, direction: StepState, share: float) -> Products:
    """What a direction changes of the products in the second order, with a share taken back."""
    joints = linear.step.joints
    growth = joints.friction * direction.normal
    return Products(
        normal=-share * direction.normal * direction.opening,
        sliding=-share * (growth * direction.speed + (direction.shear * direction.slip).sum(axis=0)),
        turning=-share * (growth * direction.slip + direction.speed * direction.shear),
        crushing=share * direction.normal[joints.crushable] * direction.crushing,
        interfaces=tuple(
            -share * one.second_order(turn, direction.normal)
            for one, turn in zip(linear.interfaces, direction.interfaces, strict=True)
        ),
    )


def _outlying(joints: ElasticJoints, ahead: Products, sigma: float) -> Products:
    """Changes that bring products back within a factor of σ; of a pair those are p ± ‖q‖."""
    least, most = sigma / FAR_OFF, sigma * FAR_OFF
    size = lengths(ahead.turning)
    larger = np.clip(ahead.sliding + size, least, most)
    smaller = np.clip(ahead.sliding - size, least, most)
    turned = (0.5 * (larger - smaller) - size) / np.maximum(size, 1e-300)
    return Products(
        normal=np.clip(ahead.normal, least, most) - ahead.normal,
        sliding=0.5 * (larger + smaller) - ahead.sliding,
        turning=turned * ahead.turning,
        crushing=np.clip(ahead.crushing, least, most) - ahead.crushing,
        interfaces=tuple(
            np.clip(one, law.conditions.weight * least, law.conditions.weight * most) - one
            for law, one in zip(joints.laws, ahead.interfaces, strict=True)
        ),
    )


@dataclass(frozen=True)
class Eliminated:
    """The equations linearised at a state, joints eliminated and the rest factorised.

    tangents : (n_points, components, components) C, with dx = −C dv + …
    inverse  : (components − 1, components − 1, n_points) H⁻¹
    across   : the same of H⁻¹ cone
    follows  : (components − 1, n_points) h_v
    lifts    : (components − 1, n_points) b, None without dilatancy
    interfaces : each law of interfaces by itself
    """

    step: JointStep
    state: StepState
    solve: BorderedFactors
    tangents: FloatArray
    cone: FloatArray
    inverse: FloatArray
    across: FloatArray
    follows: FloatArray
    lifts: FloatArray | None
    over: FloatArray
    interfaces: tuple[EliminatedInterface, ...] = ()

    @staticmethod
    def at(step: JointStep, state: StepState) -> Eliminated | None:
        """At a state; None where the matrix is singular."""
        joints = step.joints
        over = 1.0 / joints.limit(state.normal)
        size, n = joints.program.components, joints.program.n_points
        every = np.eye(size - 1)[:, :, None]
        cone = every / over - over * state.shear[:, None] * state.shear[None, :]
        h = step.shear_compliance * cone + every * state.speed - over * state.shear[:, None] * state.slip[None, :]
        inverse = small_inverses(h)
        across = _products(inverse, cone)
        follows = _applied(inverse, joints.friction * (state.slip - state.speed * over * state.shear))
        stiff = step.normal_compliance + state.opening / (state.normal + joints.program.limits.tension)
        stiff[joints.crushable] += state.crushing / joints.room(state.normal)
        lifts, tangents = None, np.zeros((n, size, size))
        if joints.dilates:
            slope = joints.dilatancy * over
            lifts = slope * (step.shear_compliance * state.shear + state.slip)
            stiff = stiff + slope * state.speed * joints.friction - (lifts * follows).sum(axis=0)
            tangents[:, 0, 1:] = ((slope * state.shear - np.einsum("in,ijn->jn", lifts, across)) / stiff).T
        tangents[:, 0, 0] = 1.0 / stiff
        tangents[:, 1:, 1:] = across.transpose(2, 0, 1)
        tangents[:, 1:, :] -= follows.T[:, :, None] * tangents[:, 0, None, :]
        own = [
            EliminatedInterface.at(law, one, state.normal)
            for law, one in zip(joints.laws, state.interfaces, strict=True)
        ]
        interfaces = tuple(one for one in own if one is not None)
        every_tangent = np.concatenate([tangents, *(one.tangents for one in interfaces)])
        if len(interfaces) < len(own) or not np.isfinite(every_tangent).all():
            return None
        shift = SHIFT * float(np.mean(tangents[:, 0, 0])) * joints.matrix.size + step.held
        solve = joints.matrix.factorized(every_tangent, shift, fixed_load=not step.driven)
        if solve is None:
            return None
        return Eliminated(step, state, solve, tangents, cone, inverse, across, follows, lifts, over, interfaces)

    def direction(self, residual: Residual, wanted: Products) -> StepState:
        """Direction that changes the products as told and makes up for what else is missing."""
        step, state, joints = self.step, self.state, self.step.joints
        margin, room = state.normal + joints.program.limits.tension, joints.room(state.normal)
        alone = wanted.normal / margin - residual.normal
        alone[joints.crushable] -= wanted.crushing / room
        turned = wanted.turning - state.shear * (wanted.sliding * self.over) - _applied(self.cone, residual.shear)
        free_shear = _applied(self.inverse, turned)
        if self.lifts is not None:
            slope = joints.dilatancy * self.over
            alone = alone + slope * (wanted.sliding - (state.shear * residual.shear).sum(axis=0))
            alone = alone - (self.lifts * free_shear).sum(axis=0)
        free = self.tangents[:, 0, 0] * alone
        free_shear = free_shear - self.follows * free
        rhs, driving = -residual.balance, self._driving(residual, wanted)
        alone_too = [one.resultants(drive, 0.0, free) for one, drive in zip(self.interfaces, driving, strict=True)]
        rhs[:-1] -= joints.carried(free, free_shear, alone_too)
        answer = self.solve.unrefined(rhs)
        dv = joints.velocities(answer[:-1])
        change = np.einsum("nij,jn->in", self.tangents, dv)
        normal, shear = free - change[0], free_shear - change[1:]
        slip = dv[1:] + step.shear_compliance * shear + residual.shear
        friction = joints.friction
        speed = wanted.sliding - state.speed * friction * normal
        speed = self.over * (speed - (state.shear * slip).sum(axis=0) - (state.slip * shear).sum(axis=0))
        return StepState(
            u=answer[:-1],
            factor=float(answer[-1]),
            normal=normal,
            opening=(wanted.normal - state.opening * normal) / margin,
            shear=shear,
            slip=slip,
            speed=speed,
            crushing=(wanted.crushing + state.crushing * normal[joints.crushable]) / room,
            interfaces=self._interfaces(wanted, driving, answer[:-1], normal),
        )

    def _driving(self, residual: Residual, wanted: Products) -> list[FloatArray]:
        """What drives the resultants of each law of interfaces besides motion and normal forces."""
        each = zip(self.interfaces, residual.interfaces, wanted.interfaces, strict=True)
        return [one.driving(flow, products) for one, flow, products in each]

    def _interfaces(
        self, wanted: Products, driving: list[FloatArray], u: FloatArray, normal: FloatArray
    ) -> tuple[InterfaceState, ...]:
        """Changes of the laws of interfaces, with those of velocities and normal forces."""
        each = zip(self.interfaces, driving, self.step.joints.motions(u), wanted.interfaces, strict=True)
        return tuple(
            one.change(one.resultants(drive, motion, normal), normal, products) for one, drive, motion, products in each
        )


def small_inverses(matrices: FloatArray) -> FloatArray:
    """Inverses of 1 × 1 or 2 × 2 matrices that stand last, (k, k, n)."""
    if len(matrices) == 1:
        return 1.0 / matrices
    (a, b), (c, d) = matrices
    return np.asarray(np.stack([np.stack([d, -b]), np.stack([-c, a])]) / (a * d - b * c))


def _applied(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """(k, k, n) times (k, n)."""
    return np.asarray((matrices * vectors[None]).sum(axis=1))


def _products(first: FloatArray, second: FloatArray) -> FloatArray:
    """(k, k, n) times (k, k, n)."""
    return np.asarray((first[:, :, None] * second[None]).sum(axis=1))
