"""Tables of recorded figures, from rows made by hand."""

from __future__ import annotations

from tests.performance.bench_rivals import RIVALS
from tests.performance.tables import exponents_table, rivals_table


def row(rival: str, **figures: str) -> dict[str, str]:
    empty = {"structure": "wall", "rival": rival, "status": "", "processor": "", "ratio": "", "error": ""}
    return empty | figures


def test_ratios_errors_and_answers() -> None:
    rows = [
        row("mbla", status="solved", processor="9", ratio="1", error="1e-10"),
        row("mbla", status="solved", processor="0.25", ratio="1", error="1e-10"),
        row("cvxpy", status="optimal", processor="0.5", ratio="2", error="-0.0009"),
        row("cvxpy, kinematic", status="optimal_inaccurate", processor="1", ratio="4", error="-0.03"),
        row("linprog", status="stopped after 300 s"),
        row("compas_cra, rbe_solve", status="stands", processor="3", ratio="12"),
        row("compas_cra, cra_solve", status="solve failed: infeasible", processor="3", ratio="13.2"),
    ]
    header, _, line = rivals_table(rows)
    cells = dict(zip(header.split(" | "), line.split(" | "), strict=True))
    assert cells["mbla, s"] == "0.25"
    assert cells["standing, s"] == "–"
    assert cells["cvxpy"] == "2 (-9e-04)"
    assert cells["cvxpy, kinematic"] == "4 (-3e-02, optimal_inaccurate)"
    assert cells["linprog"] == "stopped after 300 s"
    assert cells["compas_cra, rbe_solve"] == "12 (stands)"
    assert cells["compas_cra, cra_solve"] == "13 (solve failed: infeasible)"
    assert cells["cvxpy, scaled"] == "–"
    assert all(name in header for name in RIVALS if name not in ("mbla", "mbla, standing"))


def test_exponents() -> None:
    common = {"family": "wall, planar", "flow_rule": "associative", "fewest_blocks": "105", "most_blocks": "10050"}
    rows = [
        {**common, "time": "solver", "exponent": "1.5"},
        {**common, "time": "total", "exponent": "9"},
        {**common, "time": "total", "exponent": "1.25"},
    ]
    assert list(exponents_table(rows))[2:] == ["| wall, planar | associative | 105 to 10050 | 1.50 | 1.25 |"]
