"""Decks to begin with, which ``mbla new`` writes."""

KINDS = {
    "wall": "a dry-stone wall with a door, pushed in and out of its plane",
    "facade": "two storeys with a return wall, lintels, floor and roof, and what a code says of it",
    "arch": "a load at its quarter, an earthquake, the least and the greatest thrust",
    "bridge": "an arch with spandrels and fill under a travelling lorry",
    "vault": "a cross vault, shaken, and one of its springers spreading",
    "tower": "square, with openings, shaken along a side and the diagonal",
}
"""kinds of structures, the first unless another is asked for, and what their decks are; each is a file here"""
