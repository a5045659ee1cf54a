/* Generated from axcomp/fmu/variables.py by `python -m axcomp.native`; do not edit. */
#ifndef AXCOMP_LAYOUT_H
#define AXCOMP_LAYOUT_H

#define AXCOMP_LAYOUT 0xfe14cc75u  /* of the records in images and states */
#define AXCOMP_POINTER 8u  /* bytes of a pointer in them */

enum { MACHINE_BLOCK = 0, AXIS_BLOCK = 1, VOLUMETRIC_BLOCK = 33 };

#endif
