"""Axis compensations of CNC machines: from the controller's lists to an FMU."""
