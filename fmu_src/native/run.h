/* Many cycles in one call: columns in, columns out, NC commands between rows. */
#ifndef AXCOMP_RUN_H
#define AXCOMP_RUN_H

#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* AXCOMP_LAYOUT of the records this was compiled with. */
AXCOMP_API uint32_t axcomp_layout(void);

/* A field of Inputs or Outputs and its column, whose elements are so many bytes apart. */
typedef struct {
    char *column;
    int64_t stride;
    int64_t offset;
} Field;

/* Fields by their type: in columns real ones are double, Integer int64_t, Boolean one byte. */
typedef struct {
    const Field *fields;
    int64_t reals, integers, booleans;
} Columns;

/* A Boolean that a command sets in Inputs or State; held: only for the cycle of the command, unless it is set again. */
typedef struct {
    int32_t offset;
    uint8_t in_state, value, held, unused;
} Poke;

/* A command: what it sets before the cycle of a row. */
typedef struct {
    int64_t row;
    int32_t first, count;
} Event;

enum { POKES = 256 };  /* of a command at most */

typedef struct {
    const Tables *tables;
    const double *pool;
    State *state;
    Inputs *inputs;
    Outputs *outputs;
    Columns given, results;
    const Event *events;  /* in the order of their rows */
    int64_t event_count;
    const Poke *pokes;
    int64_t rows;
} Run;

/* Run one cycle for each row. */
AXCOMP_API void axcomp_run(const Run *run);

#ifdef __cplusplus
}
#endif

#endif
