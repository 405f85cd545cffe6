"""Whether energies balance in small random structures in time: results/energy_of_random_scenes.csv.

``python -m tests.performance.energy_of_random_scenes [HOW MANY]`` follows 50 piles of one to three boxes, in their
plane and in space in turn (tests/solution/time_history/random_scenes.py), and records for each how it ends, its peak,
and the greatest energy that is not accounted for, over the greatest that any of its parts reaches.
"""

from __future__ import annotations

import sys

from tests.performance.recording import record
from tests.solution.time_history.followed import followed, out_of_balance
from tests.solution.time_history.random_scenes import random_scene


def main() -> None:
    """Measure."""
    for seed in range(int(sys.argv[1]) if len(sys.argv) > 1 else 50):
        found, _, _ = followed(random_scene(seed))
        assert found.rows is not None
        assert found.peaks is not None
        row = {
            "scene": seed,
            "where": "space" if seed % 2 else "plane",
            "end": str(found.end),
            "peak": found.peaks.peak,
            "missed": int(found.rows.missed[-1]),
            "halved": int(found.rows.halved[-1]),
            "out_of_balance": f"{out_of_balance(found.rows):.1e}",
        }
        record("energy_of_random_scenes", row)


if __name__ == "__main__":
    main()
