"""Second opinions: linear programs assembled here beside the program's cones, and the convex contact model."""
