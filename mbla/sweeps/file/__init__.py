"""The sweep file: its types, how it is read and checked, its schema."""
