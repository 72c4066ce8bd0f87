"""Readers of mesh files, behind the `load_mesh` hook."""
