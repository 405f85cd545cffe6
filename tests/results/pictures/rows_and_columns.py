"""Rows of blocks that turn about their own edges and columns that carry forces: as many blocks as a test wants."""

from dataclasses import replace

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.model.applied_load import without_forces
from mbla.results.results import Results
from tests.results.synthetic import cuboids, horizontal_contacts, tower_mechanics, tower_results


def row_of_blocks(count: int) -> Results:
    """Blocks 1 x 1 x 2 in a row on the ground, each turning about its right edge, in groups of their own."""
    results = tower_results()
    lower = np.array([[2.0 * i, 0, 0] for i in range(count)])
    blocks = cuboids(lower, lower + np.array([1, 1, 2]), [f"group {i + 1}" for i in range(count)])
    rectangles = [(x, x + 1, 0, 1, 0) for x in lower[:, 0]]
    contacts = horizontal_contacts([[count, i] for i in range(count)], rectangles)
    loads = np.zeros((count, 6))
    loads[:, 0] = 1.0
    mechanics = replace(
        tower_mechanics(),
        contact_forces=np.tile([1.0, 0, 0], (4 * count, 1)),
        contact_velocities=np.tile([[1.0, 0, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0]], (count, 1)),
        mechanism=np.tile([1.0, 0, 0.5, 0, 1, 0], (count, 1)),
        modes=np.tile([2, 0, 0, 2], count),
    )
    load_case = replace(results.model.load_cases[0], dead_load=0 * loads, live_load=loads)
    solution = replace(results.cases[0].solution, mechanics=mechanics)
    model = replace(
        results.model,
        blocks=blocks,
        fixed=np.zeros(count, dtype=bool),
        grounds=results.model.grounds[:1],
        load_cases=(load_case,),
    )
    case = replace(results.cases[0], load_case=load_case, solution=solution)
    return replace(results, assembly=Assembly(model, contacts), cases=(case,))


def column_of_blocks(*right: float) -> Results:
    """Cubes of 1 m on a fixed one, one for each joint, whose right edge carries that share of 4 N, 8 N and so on."""
    results, count = tower_results(), len(right)
    lower = np.array([[0.0, 0, i] for i in range(count + 1)])
    blocks = cuboids(lower, lower + 1, ["column"] * (count + 1))
    contacts = horizontal_contacts([[i, i + 1] for i in range(count)], [(0, 1, 0, 1, i + 1) for i in range(count)])
    forces = np.zeros((4 * count, 3))
    forces[:, 0] = np.ravel([2 * (i + 1) * np.array([1 - x, x, x, 1 - x]) for i, x in enumerate(right)])
    mechanics = replace(
        tower_mechanics(),
        contact_forces=forces,
        contact_velocities=0 * forces,
        mechanism=np.zeros((count + 1, 6)),
        modes=np.zeros(4 * count, dtype=np.int64),
    )
    loads = np.zeros((count + 1, 6))
    loads[-1, 0] = 1.0
    load_case = replace(
        results.model.load_cases[0],
        dead_load=0 * loads,
        live_load=loads,
        live=(without_forces("push"),),
    )
    model = replace(results.model, blocks=blocks, fixed=np.arange(count + 1) == 0, grounds=(), load_cases=(load_case,))
    solution = replace(results.cases[0].solution, mechanics=mechanics)
    case = replace(results.cases[0], load_case=load_case, solution=solution)
    return replace(results, assembly=Assembly(model, contacts), cases=(case,))


def two_on_one() -> Results:
    """Two cubes side by side on a fixed block, which turn as one about its upper edge at x = 2."""
    results = tower_results()
    blocks = cuboids([[0, 0, 0], [0, 0, 1], [1, 0, 1]], [[2, 1, 1], [1, 1, 2], [2, 1, 2]], ["base", "left", "right"])
    contacts = horizontal_contacts([[0, 1], [0, 2]], [(0, 1, 0, 1, 1), (1, 2, 0, 1, 1)])
    opening = 2.0 - contacts.points[:, 0]
    mechanism = np.zeros((3, 6))
    mechanism[1:, :3] = np.cross([0.0, 1.0, 0.0], blocks.centroids[1:] - [2.0, 0.5, 1.0])
    mechanism[1:, 4] = 1.0
    mechanics = replace(
        tower_mechanics(),
        contact_forces=np.tile([1.0, 0, 0], (8, 1)),
        contact_velocities=opening[:, None] * [1.0, 0.0, 0.0],
        mechanism=mechanism,
        modes=np.where(opening > 0, 2, 0),
    )
    load_case = replace(results.model.load_cases[0], dead_load=np.zeros((3, 6)), live_load=np.ones((3, 6)))
    model = replace(results.model, blocks=blocks, fixed=np.arange(3) == 0, grounds=(), load_cases=(load_case,))
    solution = replace(results.cases[0].solution, mechanics=mechanics)
    case = replace(results.cases[0], load_case=load_case, solution=solution)
    return replace(results, assembly=Assembly(model, contacts), cases=(case,))
