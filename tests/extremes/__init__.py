"""Numbers at their extremes: scenes with a known answer, and what the program says of each."""
