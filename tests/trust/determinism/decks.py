"""50 decks of every kind: generated and from geometry files, every flow rule and contact model, loads that move."""

from __future__ import annotations

from collections.abc import Sequence

from tests.decks import folder

DECKS = (
    "arch_20_voussoirs",
    "arch_50_voussoirs",
    "arch_basket",
    "arch_catenary",
    "arch_elliptic",
    "arch_pointed",
    "arch_from_compas",
    "arch_from_dxf",
    "arch_from_generator",
    "arch_from_gltf",
    "arch_from_inp",
    "arch_from_msh",
    "arch_from_obj",
    "arch_from_ply",
    "arch_from_stl",
    "arch_from_tables",
    "arch_from_vtu",
    "beam_on_three_supports",
    "beam_under_travelling_load",
    "block_sliding_polyhedral",
    "cocchetti_rizzi_mu_350_falls",
    "cocchetti_rizzi_mu_350_stands",
    "combined_loads",
    "dam_under_water",
    "dome_of_slices_falls",
    "eccentric_compression",
    "eccentric_compression_convex",
    "eccentric_compression_spacing",
    "ferris_wall_1",
    "ferris_wall_1_associative",
    "ferris_wall_1_slope",
    "ferris_wall_3",
    "ferris_wall_3_dilatancy",
    "ferris_wall_3_livesley",
    "ferris_wall_3_path",
    "ferris_wall_5",
    "glued_lintel",
    "groove",
    "groove_dilatancy",
    "groove_locked",
    "incline",
    "incline_tilted_gravity",
    "incline_too_steep",
    "leaning_block",
    "leaves",
    "overhang_too_far",
    "stair_two_treads",
    "tilting_block",
    "torque",
    "wall_5x5",
)
"""names in decks/benchmarks; a settlement is in beam_on_three_supports, a tilting table in tilting_block"""
FEW = ("arch_from_obj",)
PICTURES = ("arch_from_obj", "ferris_wall_3")
TABLES = ("arch_from_dxf", "beam_on_three_supports")


def commands(decks: Sequence[str], *, beside: bool) -> list[list[str]]:
    """Arguments that run the decks; ``beside`` also asks for pictures, tables and a report of some of them."""
    asked = [
        ["run", folder.BENCHMARKS[deck].relative_to(folder.DECKS).as_posix(), "-o", f"out/{deck}", "-q"]
        for deck in decks
    ]
    if not beside:
        return asked
    for deck in PICTURES:
        result = f"out/{deck}/{deck}.h5"
        asked += [["plot", result, "--kind", "mechanism", "-o", f"out/{deck}.{kind}"] for kind in ("svg", "png")]
        asked.append(["report", result, "-o", f"out/{deck}.html"])
    return [*asked, *(["export", f"out/{deck}/{deck}.h5", "--csv", "-o", f"out/{deck}_csv"] for deck in TABLES)]
