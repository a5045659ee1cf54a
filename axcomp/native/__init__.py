"""The compiled kernel, called through ctypes."""
