"""Compensation tables of other controllers: read, written, and compared with what they came from."""
