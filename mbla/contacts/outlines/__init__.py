"""Outlines of surfaces in a plane: what two have in common, the corners that they need, their contact points."""
