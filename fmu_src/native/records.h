/* What an image holds of a record. The parts are generated. */
#ifndef AXCOMP_RECORDS_H
#define AXCOMP_RECORDS_H

#include <stddef.h>

#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A field of a record: `count` elements of `size` bytes at `offset`. */
typedef struct Part {
    char type; /* 'd' double, 'i' int32_t, 'b' bool, 'r' record; 0: no more parts */
    int32_t count;
    size_t offset;
    size_t size;
    const struct Part *parts; /* of such a record */
} Part;

extern const Part axcomp_axis_parts[];
extern const Part axcomp_volumetric_parts[];

#ifdef __cplusplus
}
#endif

#endif
