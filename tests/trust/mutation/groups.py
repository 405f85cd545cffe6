"""Which modules are made wrong, and the tests next to them, quick ones first."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[3]


@dataclass(frozen=True)
class Group:
    """Modules and tests, as patterns below the repository.

    longest : CPU seconds of a test, beyond which it is left out
    """

    modules: tuple[str, ...]
    tests: tuple[str, ...]
    longest: float = 2.0

    def files(self) -> list[Path]:
        """Modules in the order of their names."""
        return sorted({path for pattern in self.modules for path in ROOT.glob(pattern)})

    def test_files(self) -> list[Path]:
        """Tests in the order of the patterns."""
        return list(dict.fromkeys(path for pattern in self.tests for path in sorted(ROOT.glob(pattern))))


GROUPS = {
    "verify": Group(
        modules=(
            "mbla/solution/verification/verify*.py",
            "mbla/solution/verification/residuals.py",
            "mbla/solution/associative/bounds.py",
            "mbla/solution/associative/proofs.py",
            "mbla/solution/verification/case.py",
            "mbla/solution/verification/statics.py",
            "mbla/solution/associative/certificate.py",
        ),
        tests=(
            "tests/solution/*/test_*_by_hand.py",
            "tests/solution/verification/test_residuals.py",
            "tests/solution/associative/test_bounds.py",
            "tests/solution/verification/test_verify*.py",
            "tests/solution/associative/test_certificate.py",
            "tests/solution/test_rough_residuals.py",
            "tests/solution/test_accuracy.py",
            "tests/solution/test_tilt.py",
            "tests/solution/nonassociative/test_locking.py",
            "tests/solution/nonassociative/test_first_fall.py",
            "tests/test_verify_file.py",
        ),
        longest=6.0,
    ),
    "geometry": Group(
        modules=(
            "mbla/model/geometry/*.py",
            "mbla/model/solids/measures.py",
            "mbla/model/solids/polyhedra.py",
            "mbla/model/solids/defects.py",
            "mbla/model/solids/facets.py",
            "mbla/model/solids/self_intersection.py",
            "mbla/model/transform.py",
        ),
        tests=("tests/model/solids/test_measures.py", "tests/model/test_*.py", "tests/model/geometry/test_*.py"),
    ),
    "contacts": Group(modules=("mbla/contacts/*.py",), tests=("tests/contacts/test_*.py", "tests/model/test_*.py")),
    "program": Group(
        modules=("mbla/program/**/*.py",),
        tests=(
            "tests/program/**/test_*.py",
            "tests/analytic/test_planar_programs.py",
            "tests/solution/associative/test_bounds.py",
            "tests/solution/verification/test_guides.py",
            "tests/solution/test_glued.py",
            "tests/solution/associative/test_solve_associative.py",
            "tests/solution/resultants/test_solve_convex.py",
            "tests/solution/associative/test_force_ranges.py",
            "tests/analytic/test_closed_forms.py",
        ),
        longest=3.0,
    ),
}
