/* Generated from axcomp/interface/declarations.py by `python -m axcomp.native`; do not edit. */
#ifndef AXCOMP_LAYOUT_H
#define AXCOMP_LAYOUT_H

#define AXCOMP_LAYOUT 0x105539dcu  /* of the records in images and states */
#define AXCOMP_AXIS_BYTES 676u  /* of the table of an axis in an image */
#define AXCOMP_VOLUMETRIC_BYTES 20002u
#define AXCOMP_ON_INSTANT 0.01  /* share of a cycle by which a communication point may miss an instant */
#define AXCOMP_CYCLE_TIME_MAX 1000.0  /* s; cycle times are shorter */

enum { AXCOMP_LARGEST_STEP = 10000000 }; /* cycles of a communication step, unless the host says more */

enum { MACHINE_BLOCK = 0, AXIS_BLOCK = 1, VOLUMETRIC_BLOCK = 33 };
/* Of FMI 3.0: the blocks of tables, and the independent variable. */
enum { TABLE_BLOCK = 38, TIME_REFERENCE = 63 };

#endif
