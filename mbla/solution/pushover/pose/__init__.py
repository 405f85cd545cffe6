"""A structure at any pose: its joints, ties and stiffness there, and the step that ends at one."""
