"""Traces of a controller against the engine: how far they differ, and what would explain it."""
