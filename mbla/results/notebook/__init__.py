"""Results as Python users meet them: figures by name, arrays, and what a notebook shows."""
