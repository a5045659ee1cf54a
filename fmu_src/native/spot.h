/* Where the variables of a block of value references are in memory. */
#ifndef AXCOMP_SPOT_H
#define AXCOMP_SPOT_H

#include "instance.h"
#include "places.h"

typedef struct {
    unsigned block;
    const Place *places;
    char *results;  /* what its outputs are in */
    char *given;    /* and the rest */
} Spot;

static inline Spot axcomp_spot_of(Memory *memory, const Tables *tables, unsigned block)
{
    static const Place NONE[PLACES] = {{0, 0, 0}};
    Spot spot = {block, NONE, (char *)memory, (char *)memory};
    unsigned axis = block - AXIS_BLOCK;
    unsigned volumetric = block - VOLUMETRIC_BLOCK;
    if (block == MACHINE_BLOCK) {
        spot.places = axcomp_machine_places;
    } else if (axis < (unsigned)tables->axis_count) {
        spot.places = axcomp_axis_places;
        spot.results = (char *)&memory->outputs.axis[axis];
        spot.given = (char *)&memory->inputs.axis[axis];
    } else if (volumetric < (unsigned)tables->volumetrics) {
        spot.places = axcomp_volumetric_places;
        spot.results = (char *)&memory->outputs.volumetric[volumetric];
        spot.given = (char *)&memory->inputs.volumetric[volumetric];
    }
    return spot;
}

/* Where a variable is whose place is one of a spot's. */
static inline char *axcomp_at(const Spot *spot, const Place *place)
{
    return (place->causality == 'o' ? spot->results : spot->given) + place->offset;
}

#endif
