"""What studies say alike on the terminal."""

from __future__ import annotations

INTERRUPTION = "interrupted: here is what was found until then"
LEFT = "the files of the earlier study are left as they are"
"""of a study that was interrupted"""
