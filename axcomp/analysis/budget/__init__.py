"""What each compensation and each error contributes along a path: ``axcomp budget``."""
