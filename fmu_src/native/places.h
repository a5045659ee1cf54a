/* Where the variable of a value reference is: reference = PLACES * block + identifier. The tables are generated. */
#ifndef AXCOMP_PLACES_H
#define AXCOMP_PLACES_H

#ifdef __cplusplus
extern "C" {
#endif

#include "layout.h"

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
