"""Decks whose results are odd: nothing to load, nothing to touch, no answer, an answer that is none; each as text."""

from __future__ import annotations

HEAD = """\
mbla: 1
title: Odd
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
"""
BLOCK = (
    HEAD
    + """\
blocks: [{box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 2]}}]
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
"""One block on the ground: rocks at 1/2."""

STACK = (
    HEAD
    + """\
parameters: {x: 0, s: 1}
blocks:
  - box: {group: base, material: stone, min: ["=x", 0, 0], max: ["=x+s", "=s", "=s"]}
  - box: {group: middle, material: stone, min: ["=x", 0, "=s"], max: ["=x+s", "=s", "=2*s"]}
  - box: {group: top, material: stone, min: ["=x", 0, "=2*s"], max: ["=x+s", "=s", "=3*s"]}
supports: [{blocks: base}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
"""Two blocks on a fixed one: both rock at 1/2."""

TWIST = BLOCK.replace(
    "{live: [{acceleration: [1, 0, 0]}]}",
    "{live: [{force: [0, 1000, 0], on: block, at: [1, 0.5, 1]}, {force: [0, -1000, 0], on: block, at: [0, 0.5, 1]}]}",
)
WEDGE = (
    HEAD.replace("0.6", "1.8")
    + """\
parameters: {b: 30, t: "=0.5*tan(b)"}
blocks:
  - polyhedron:
      group: wedge
      material: stone
      vertices: [[0, 0, 0], [0.5, 0, "=t"], [-0.5, 0, "=t"], [0, 4, 0], [0.5, 4, "=t"], [-0.5, 4, "=t"]]
      faces: [[0, 1, 2], [5, 4, 3], [3, 4, 1, 0], [4, 5, 2, 1], [5, 3, 0, 2]]
supports:
  - {ground: {point: [0, 0, 0], normal: ["=-sin(b)", 0, "=cos(b)"]}}
  - {ground: {point: [0, 0, 0], normal: ["=sin(b)", 0, "=cos(b)"]}}
load_cases: {along: {live: [{acceleration: [0, 1, 0]}]}}
"""
)
BEAM = (
    HEAD
    + """\
blocks:
  - box: {group: pier, material: stone, min: [2, 0, 0], max: [2.5, 0.5, 2]}
  - box: {group: pier, material: stone, min: [5.5, 0, 0], max: [6, 0.5, 2]}
  - box: {group: beam, material: stone, min: [0, 0, 2], max: [8, 0.5, 2.4]}
supports: [{blocks: pier}]
load_cases:
  crane: {live: [{travel: {force: [0, 0, -10000], path: [[0, 0.25, 3], [8, 0.25, 3]], positions: 5}}]}
analysis: {flow_rule: associative}
"""
)
PIER_WITH_HALF = BEAM.split("load_cases")[0]

HUGE = "ÄÖÜß <script>alert(1)</script> & 'quoted' \\\"words\\\" \U0001f9f1 " + "a very long title " * 8

DECKS: dict[str, tuple[str, tuple[str, ...]]] = {
    "one_block": (BLOCK, ()),
    "isolated": (
        STACK.replace(
            "supports:", "  - box: {group: far, material: stone, min: [9, 0, 0], max: [10, 1, 1]}\nsupports:"
        ),
        (),
    ),
    "no_interfaces": (
        STACK.replace('min: ["=x", 0, "=s"]', 'min: ["=x", 0, "=1.5*s"]').replace(
            '  - box: {group: top, material: stone, min: ["=x", 0, "=2*s"], max: ["=x+s", "=s", "=3*s"]}\n', ""
        ),
        (),
    ),
    "one_free": (STACK.replace("{blocks: base}", "{blocks: [base, middle]}"), ()),
    "guides_only": (
        BLOCK.replace("{ground: {z: 0}}", "{blocks: block, slide: [0.8, 0, 0.6]}"),
        (),
    ),
    "guided_dead_falls": (BLOCK.replace("{ground: {z: 0}}", "{blocks: block, fixed: [rx, ry, rz]}"), ()),
    "hinge": (
        BLOCK.replace("{ground: {z: 0}}", "{blocks: block, turn: {axis: [0, 1, 0], about: [0.5, 0, 3]}}"),
        (),
    ),
    "settlement": (
        PIER_WITH_HALF + "load_cases: {sinks: {settlement: {on: {group: pier, index: 1}, direction: [0, 0, -1]}}}\n",
        (),
    ),
    "settlement_turns": (
        PIER_WITH_HALF
        + "load_cases:\n"
        + "  turns: {settlement: {on: {group: pier, index: 1}, turn: {axis: [0, 1, 0], about: [5.5, 0, 0]}}}\n",
        (),
    ),
    "not_all_cases": (
        BLOCK.replace("load_cases: {", "load_cases: {other: {live: [{acceleration: [0, 1, 0]}]}, "),
        ("case=push",),
    ),
    "frictionless": (BLOCK.replace("0.6", "0"), ()),
    "hangs": (
        HEAD.replace("0.6", "0.6, cohesion: 1.e+5, tensile_strength: 8.e+4")
        + """\
blocks:
  - box: {group: ceiling, material: stone, min: [0, 0, 1], max: [1, 1, 2]}
  - box: {group: hanging, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
supports: [{blocks: ceiling}]
load_cases: {pull: {live: [{force: [0, 0, -1000], on: hanging, at: [0.5, 0.5, 0]}]}}
""",
        (),
    ),
    "all_glued": (
        STACK.replace("contacts: {joint: dry}", "contacts: {joint: glued}").replace(
            "{blocks: base}", "{ground: {z: 0}, joint: dry}"
        ),
        (),
    ),
    "glued_to_support": (
        STACK.replace(
            "contacts: {joint: dry}", "contacts: {joint: dry, overrides: [{between: [base, middle], joint: glued}]}"
        ),
        (),
    ),
    "convex_twist": (TWIST, ("analysis.contact_model=convex",)),
    "far": (STACK, ("parameters.x=1000000",)),
    "mm": (
        STACK.replace("materials", "units: {length: mm}\nmaterials").replace("2000", "2.e-6"),
        ("parameters.s=1000",),
    ),
    "km": (
        STACK.replace("materials", "units: {length: m, force: MN, mass: t}\nmaterials").replace("2000", "2"),
        ("parameters.s=1000",),
    ),
    "title": (BLOCK.replace("title: Odd", f'title: "{HUGE}"'), ()),
    "tiny": (STACK, ("parameters.s=0.000001",)),
    "no_equilibrium": (
        BLOCK.replace("[{acceleration", "[{acceleration").replace(
            "push: {", "push: {dead: [{gravity: [9.81, 0, -9.81]}], "
        ),
        (),
    ),
    "unbounded": (WEDGE, ("analysis.flow_rule=associative",)),
    "locked": (WEDGE, ()),
    "time_limit": (STACK, ("analysis.time_limit=0.001",)),
    "iteration_limit": (STACK, ("analysis.max_iterations=2",)),
    "iteration_limit_associative": (STACK, ("analysis.max_iterations=2", "analysis.flow_rule=associative")),
    "iteration_limit_7": (STACK, ("analysis.max_iterations=7", "analysis.solver=clarabel")),
    "draft": (STACK, ("analysis.accuracy=draft", "analysis.tolerance=0.001")),
    "published_approximate": (TWIST, ("analysis.scheme=published", "analysis.published.max_programs=2")),
    "proximal_1": (TWIST, ("analysis.scheme=proximal", "analysis.proximal.max_programs=1")),
    "travel_unbounded": (BEAM, ()),
    "travel_not_verified": (BEAM, ("analysis.max_iterations=3",)),
    "tilt": (BLOCK.replace("{acceleration: [1, 0, 0]}", "{tilt: {axis: [0, 1, 0]}}"), ()),
    "weightless": (
        STACK.replace(
            "{live: [{acceleration: [1, 0, 0]}]}",
            "{dead: [{gravity: none}, {force: [0, 0, -1000], on: top, at: [0.5, 0.5, 3]}],"
            " live: [{force: [1000, 0, 0], on: top, at: [0.5, 0.5, 3]}]}",
        ),
        (),
    ),
    "weightless_unloaded": (
        BLOCK.replace(
            "{live: [{acceleration: [1, 0, 0]}]}",
            "{dead: [{gravity: none}], live: [{force: [1000, 0, 0], on: block, at: [0.5, 0.5, 2]}]}",
        ),
        (),
    ),
    "plates": (
        BLOCK.replace("max: [1, 1, 2]", "max: [1, 1, 0.0001]"),
        (),
    ),
    "livesley": (STACK, ("analysis.flow_rule=livesley",)),
    "force_ranges": (STACK, ("analysis.force_ranges=true",)),
    "polyhedral": (STACK, ("analysis.friction_cone=polyhedral", "analysis.flow_rule=associative")),
    "crushing": (STACK.replace("0.6}", "0.6, compressive_strength: 2.e+6}"), ("analysis.contact_model=convex",)),
    "cohesive": (STACK.replace("0.6}", "0.6, cohesion: 1.e+4, tensile_strength: 1.e+4}"), ()),
}
