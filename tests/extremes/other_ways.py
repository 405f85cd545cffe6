"""The convex contact model, and solvers that a deck asks for, on a sample of the other extremes.

None of these structures twists, so that the load factors of the convex model are those of the contact points.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from mbla.solution.thresholds import GAP_TOLERANCE
from tests.extremes import joint_laws, shapes, sizes, weights
from tests.extremes.decks import ruled
from tests.extremes.outcome import Scene

CHOICES = {
    "solver mbla": ("analysis.solver=mbla",),
    "solver clarabel": ("analysis.solver=clarabel",),
    "convex contact model": ("analysis.contact_model=convex",),
}
SAMPLE = {
    "lengths": ("1e-6", "1e6"),
    "densities": ("1e-6", "1e6"),
    "friction": ("friction 0.01", "friction 1.0e-6", "friction 10", "friction 1.0e6"),
    "slenderness": ("width 1e-4", "width 1e-2", "width 1e4"),
    "weights of neighbours": ("heavy on light, 1e4", "light on heavy, 1e8", "between heavy, 1e2", "lintel, 1e8"),
}
"""Of each family the scenes with one of these words in their names."""
SAID = ("magnitudes-far-apart", "approximate", "not_verified")
"""What may be said beside what the scene names: without the steps that ``auto`` takes less is proved."""


def scenes() -> Iterator[Scene]:
    """With associative flow: of blocks in every way, of walls and arches with the convex model.

    Of forces that are not repaired solved promises no more than the distance of the bounds.
    """
    for scene in (*sizes.SCENES, *joint_laws.SCENES, *shapes.SCENES, *weights.SCENES):
        if ruled("associative") not in scene.overrides or not any(
            w in scene.name for w in SAMPLE.get(scene.family, ())
        ):
            continue
        for way, overrides in CHOICES.items():
            if way == "convex contact model" or not scene.name.startswith(("wall", "arch")):
                yield replace(
                    scene,
                    name=f"{scene.family}: {scene.name}, {way}",
                    family="other models and solvers",
                    overrides=(*scene.overrides, *overrides),
                    diagnosis=(*scene.diagnosis, *SAID),
                    tolerance=max(scene.tolerance, GAP_TOLERANCE) if scene.expected else scene.tolerance,
                    long=scene.long or "arch" in scene.name or "wall" in scene.name,
                )


SCENES = tuple(scenes())
