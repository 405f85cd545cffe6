"""Supports: ground planes, fixed blocks, guides."""
