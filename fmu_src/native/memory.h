/* What changes from cycle to cycle, as large as the machine: three records, and a block with the arrays they point to. */
#ifndef AXCOMP_MEMORY_H
#define AXCOMP_MEMORY_H

#include <stddef.h>
#include <stdint.h>

#include "config.h"
#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How many elements the arrays have. */
typedef struct {
    int32_t axes;
    int32_t volumetrics;
    int32_t lines[AXES]; /* numbers in the delay line of an axis */
} Shape;

/* CRC-32 (IEEE 802.3) of some bytes, going on from `check` (0 to begin with). */
uint32_t axcomp_crc32(uint32_t check, const void *data, size_t size);

/* The shape that tables need. */
void axcomp_shape_of(const Tables *tables, Shape *shape);

/* Bytes of the arrays. */
size_t axcomp_state_size(const Shape *shape);
size_t axcomp_inputs_size(const Shape *shape);
size_t axcomp_outputs_size(const Shape *shape);

/* Let a record point to its arrays, which lie at `at`, as a double would. */
void axcomp_place_state(State *state, void *at, const Shape *shape);
void axcomp_place_inputs(Inputs *inputs, void *at, const Shape *shape);
void axcomp_place_outputs(Outputs *outputs, void *at, const Shape *shape);

/* Copy a record with the arrays, each into its own; `shape`: that of the smaller one. */
void axcomp_copy_state(State *to, const State *from, const Shape *shape);
void axcomp_copy_inputs(Inputs *to, const Inputs *from, const Shape *shape);
void axcomp_copy_outputs(Outputs *to, const Outputs *from, const Shape *shape);

#ifdef __cplusplus
}
#endif

#endif
