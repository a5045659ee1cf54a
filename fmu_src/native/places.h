/* Where the variable of a value reference is: reference = PLACES * block + identifier. The tables are generated. */
#ifndef AXCOMP_PLACES_H
#define AXCOMP_PLACES_H

#include <stddef.h>

#include "layout.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { PLACES = 64 };

/* C++ has no designated initializers: there the rows simply follow each other. */
#ifdef __cplusplus
#define AT(identifier)
#else
#define AT(identifier) [identifier] =
#endif

typedef struct {
    char type;       /* 'r' Real, 'i' Integer, 'b' Boolean, 's' String; 0: no variable */
    char causality;  /* 'i' input, 'o' output, 'p' fixed parameter, 't' tunable parameter */
    unsigned offset; /* in Memory; of an axis or a volumetric compensation: in its inputs or outputs */
} Place;

/* Numbers of a table that a host can read and change; reference = PLACES * (TABLE_BLOCK + axis) + identifier. Offsets
 * are in AxisTable. */
typedef struct {
    unsigned identifier;
    char role;       /* 'x' abscissae, which ascend, 'v' not negative either, 'y' values */
    size_t at;       /* of the index in the pool */
    size_t points;   /* of how many there are, in a row */
    size_t rows;     /* of how many rows; 0: one */
    size_t argument; /* of what they are looked up with, if it may count modulo; else 0 */
    const char *name;
} TableArray;

extern const TableArray axcomp_table_arrays[]; /* the last one has no name */

/* What the user should know when a compensation is used beyond its table; NULL where that is no matter. */
extern const char *const axcomp_notices[];
extern const char axcomp_no_command[]; /* of a switch that is none */

extern const Place axcomp_machine_places[PLACES];
extern const Place axcomp_axis_places[PLACES];
extern const Place axcomp_volumetric_places[PLACES];

#ifdef __cplusplus
}
#endif

#endif
