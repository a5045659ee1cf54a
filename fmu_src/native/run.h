/* Many cycles in one call: columns in, columns out, NC commands between rows. */
#ifndef AXCOMP_RUN_H
#define AXCOMP_RUN_H

#include "fmi2.h"
#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* AXCOMP_LAYOUT of the records this was compiled with. */
FMI2_EXPORT uint32_t axcomp_layout(void);

/* A field of the inputs or outputs and its column, whose elements are so many bytes apart. */
typedef struct {
    char *column;
    int64_t stride;
    void *at;
} Field;

/* Fields by their type: in columns real ones are double, Integer int64_t, Boolean one byte. */
typedef struct {
    const Field *fields;
    int64_t reals, integers, booleans;
} Columns;

/* What a command sets in the inputs or the state: a switch, an int32_t, or what is held for the cycle of the command, a
 * bool that is put back behind it, unless it is set again. */
typedef struct {
    void *at;
    int32_t value;
    int32_t held;
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
FMI2_EXPORT void axcomp_run(const Run *run);

#ifdef __cplusplus
}
#endif

#endif
