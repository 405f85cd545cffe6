"""Load cases that one analysis does not answer: each is a sequence of analyses, and ``sequence`` goes through it."""
