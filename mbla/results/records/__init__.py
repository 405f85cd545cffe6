"""Results as JSON: the object that ``--json`` prints and ``STEM.json`` holds."""
