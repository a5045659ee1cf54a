"""A machine to try compensations on: drives with friction and elastic, geometric errors, in the standard library only.

Independent of the compensation itself, which it must not import: its errors are smooth functions, not tables.
Positions are in mm or °, velocities and accelerations in these per s and s², currents in mA.
"""
