"""The mark of tests that draw in space."""

from __future__ import annotations

import pytest

from mbla.results.pictures.renderer import can_draw

needs_opengl = pytest.mark.skipif(not can_draw(), reason="this machine has no OpenGL")
