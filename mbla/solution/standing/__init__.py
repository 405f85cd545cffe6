"""Whether a structure stands under its dead load, and along its load path."""
