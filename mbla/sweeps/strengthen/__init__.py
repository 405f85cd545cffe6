"""The cheapest strengthening of a structure."""
