"""Plane figures of structures that are prisms across a vertical plane: vectors in SVG and PDF, drawn by matplotlib."""
