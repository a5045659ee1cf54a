"""Lists that tests of several rooms begin with."""

LEADSCREW = """\
kopf.achs_nr 1
kw.ssfk.unit 1
kw.ssfk.interval 100000
kw.ssfk.kw_nr_max 3
kw.ssfk.table[0].pos 1
kw.ssfk.table[1].pos 2
kw.ssfk.table[2].pos 3
"""
