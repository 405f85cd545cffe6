"""The closed forms of the benchmark decks, which follow the decks' parameters, over ranges of those parameters."""

from __future__ import annotations

import itertools
import math

import pytest

from mbla.solution.solution import Status
from tests.analytic.cases import ASSOCIATIVE, answer, answers
from tests.reached import reaches

EXACT = 1e-7

VARIATIONS: list[tuple[str, tuple[str, ...]]] = [
    *(("block_sliding", (f"mu={mu}",)) for mu in (0.05, 0.2, 0.577, 0.9)),
    *(
        ("block_rocking", (f"b={b}", f"d={d}", f"h={h}"))
        for b, d, h in ((0.6, 0.6, 3), (2, 1, 6), (0.1, 0.9, 2), (30, 20, 90))
    ),
    *(("incline", (f"mu={mu}", f"alpha={alpha}")) for mu, alpha in ((0.7, 30), (0.7, 1), (0.3, 16), (0.5, 20))),
    *(("incline_tilted_gravity", (f"mu={mu}", f"alpha={alpha}")) for mu, alpha in ((0.7, 30), (0.3, 16), (1.2, 45))),
    *(("stack", (f"b={b}", f"h={h}")) for b, h in ((1, 0.4), (0.8, 0.8), (2.0, 1.5))),
    *(("stack_bond_wall", (f"n={n}", f"t={t}", f"mu={mu}")) for n, t, mu in ((4, 0.1, 0.3), (9, 0.25, 0.9))),
    *(("leaves", (f"t1={t1}", f"t2={t2}")) for t1, t2 in ((0.1, 0.4), (0.2, 0.25))),
    *(("overhang", (f"s={s}",)) for s in (0.9, 0.6, 0.3)),
    *(("leaning_block", (f"mu={mu}", f"a={a}")) for mu, a in ((0.2, 0.3), (0.35, 0.25), (0.25, 0.5))),
    *(("leaning_block_rough_wall", (f"mu={mu}", f"muw={muw}")) for mu, muw in ((0.2, 0.5), (0.3, 0.1))),
    *(("groove", (f"mu={mu}", f"beta={beta}")) for mu, beta in itertools.product((0.3, 0.6), (10, 30, 55))),
    *(("torque", (f"mu={mu}", f"a={a}")) for mu, a in ((0.2, 0.1), (0.9, 5))),
    *(
        ("mortar_joint", (f"mu={mu}", f"c={c}", f"ft={ft}"))
        for mu, c, ft in ((0.5, 5e3, 0), (0.8, 2e6, 1e6), (0.0, 1e4, 2e3))
    ),
    *(
        ("guided_blocks", (f"mu={mu}", f"b={b}", f"h={h}", f"off={off}"))
        for mu, b, h, off in ((0.4, 0.3, 1.5, 0.0), (0.9, 0.7, 3.0, 1.0))
    ),
    *(
        ("rigid_walls", (f"mu={mu}", f"muw={muw}", f"press={press}"))
        for mu, muw, press in ((0.2, 0.3, 1.0), (0.6, 0.1, 0.2))
    ),
]


def overrides(values: tuple[str, ...]) -> list[str]:
    return [f"parameters.{value}" for value in values]


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("deck", "values"), VARIATIONS, ids=lambda value: value if isinstance(value, str) else ",".join(value)
)
def test_the_associative_figure_follows_the_closed_form(deck: str, values: tuple[str, ...]) -> None:
    for case in answers(deck, ASSOCIATIVE, *overrides(values)):
        exact = case.expected.associative_load_factor
        if exact is None:
            exact = case.expected.load_factor
        assert exact is not None
        assert case.load_factor == pytest.approx(exact, rel=max(EXACT, case.checks.gap)), case.name
        # the bounds are proved by other code than found the figure: they must enclose the exact one up to rounding
        assert case.checks.static_bound <= exact * (1 + 1e-9) + 1e-12
        assert case.checks.kinematic_bound >= exact * (1 - 1e-9) - 1e-12


@pytest.mark.parametrize(("mu", "beta"), list(itertools.product((0.3, 0.84), (15, 30, 45))))
def test_the_groove_without_dilatancy_slides_straight_along_it(mu: float, beta: float) -> None:
    case = answer("groove", *overrides((f"mu={mu}", f"beta={beta}")))
    assert reaches(case.load_factor, mu / math.cos(math.radians(beta)))
    assert case.associative > case.load_factor * (1 + 1e-4)


def test_the_groove_locks_for_associative_flow_from_the_friction_on_at_which_it_wedges() -> None:
    wedging = 1 / math.tan(math.radians(55))
    closed_form = "expected.along.associative_load_factor=1"  # the deck's own has no value where it locks
    below, above = (
        answer("groove", ASSOCIATIVE, closed_form, *overrides((f"mu={share * wedging}", "beta=55")))
        for share in (0.99, 1.01)
    )
    assert below.status is Status.SOLVED
    assert above.status is Status.UNBOUNDED


@pytest.mark.parametrize("mu", [0.1, 0.5, 1.3])
@pytest.mark.parametrize(("share", "status"), [(1 - 1e-5, Status.SOLVED), (1 + 1e-5, Status.NO_EQUILIBRIUM)])
def test_a_block_on_an_incline_stands_while_tan_alpha_is_at_most_mu(mu: float, share: float, status: Status) -> None:
    cases = {
        case.name: case
        for case in answers("incline_too_steep", ASSOCIATIVE, *overrides((f"mu={mu}", f'flat="=atan({share}*mu)"')))
    }
    case = cases["flat_enough"]
    if status is Status.SOLVED:
        # so close to the limit the relative gap of a factor of 1e-5 is no measure
        assert case.solution.status is Status.SOLVED
        assert case.associative == pytest.approx(mu * math.cos(math.atan(share * mu)) * (1 - share), rel=1e-3)
    else:
        assert case.status is status


@pytest.mark.parametrize(("s", "stands"), [(1 - 1e-5, True), (1 + 1e-5, False)])
def test_the_harmonic_overhang_stands_up_to_its_limit(s: float, stands: bool) -> None:
    case = answer("overhang", ASSOCIATIVE, *overrides((f"s={s!r}",)))
    assert (case.solution.status is Status.SOLVED) == stands
    assert (case.status is Status.NO_EQUILIBRIUM) != stands


def test_corner_points_overstate_torsion_by_85_percent() -> None:
    corners = answer("torque", ASSOCIATIVE, "parameters.mu=1.0").load_factor
    uniform = (math.sqrt(2) + math.log(1 + math.sqrt(2))) / 6
    assert corners == pytest.approx(0.7071068, rel=1e-6)
    assert uniform == pytest.approx(0.3826, abs=1e-4)
    assert corners / uniform == pytest.approx(1.85, abs=0.005)
