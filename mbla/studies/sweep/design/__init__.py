"""From a sweep file to the points of its design."""
