"""The demonstration: both FMUs coupled, the error of a machine without and with each compensation."""
