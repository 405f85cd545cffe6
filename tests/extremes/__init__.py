"""Numbers at their extremes: scenes with a known answer, and the table of what the program says of each.

``python -m tests.extremes.table`` solves every scene and prints it.
"""
