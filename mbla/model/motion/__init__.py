"""Motion of the base and forces over time: what a time history is made of."""
