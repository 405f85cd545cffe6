"""Which lines and branches of ``mbla/`` the tests run.

``python -m tests.trust.coverage`` measures the tests that run every time, with the commands and children they start;
arguments go to pytest and measure less. ``[tool.coverage.run]`` of ``pyproject.toml`` says what is measured.
"""
