"""Small random structures on a base that is shaken: piles of boxes in their plane and in space, at rest, rocking,
sliding or falling."""

from __future__ import annotations

import numpy as np

from tests.solution.time_history.followed import deck_text


def random_scene(seed: int, duration: float = 0.5) -> str:
    """A deck; those with an even seed are in their plane, the others in space."""
    random = np.random.default_rng(seed)
    plane = seed % 2 == 0
    boxes, height = list[str](), 0.0
    for _ in range(int(random.integers(1, 4))):
        width, depth, tall = random.uniform(0.2, 0.5, 3)
        x, y = random.uniform(-0.03, 0.03, 2)
        low = [x - width / 2, -0.2 if plane else y - depth / 2, height]
        height += float(tall)
        high = [x + width / 2, 0.2 if plane else y + depth / 2, height]
        boxes.append(f"{{box: {{material: stone, min: {_list(low)}, max: {_list(high)}}}}}")
    turn = 0.0 if plane else float(random.uniform(0.0, 2.0 * np.pi))
    direction = _list([float(np.cos(turn)), float(np.sin(turn)), 0.0])
    amplitude, length = float(random.uniform(0.2, 1.2)), float(random.uniform(0.1, 0.4))
    motion = f'{{pulse: sine, amplitude: "{amplitude:.4f} g", duration: {length:.4f}, direction: {direction}}}'
    damping = float(random.choice([0.0, 0.05]))
    history = f"motion: {motion}, step: 0.002, duration: {duration}, damping: {damping}"
    joint = f"friction: {float(random.uniform(0.2, 0.9)):.4f}"
    if random.random() < 0.3:
        joint += ", cohesion: 2000, tensile_strength: 1000"
    return deck_text(f"[{', '.join(boxes)}]", history, joint)


def _list(values: list[float]) -> str:
    return "[" + ", ".join(f"{value:.6f}" for value in values) + "]"
