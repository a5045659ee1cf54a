/* Whole trajectories for the Engine: many cycles in one call. */
#ifndef AXCOMP_RUN_H
#define AXCOMP_RUN_H

#include "fmi2.h"
#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* AXCOMP_LAYOUT of the records this was compiled with. */
FMI2_EXPORT uint32_t axcomp_layout(void);

/* A field of the inputs or outputs: where it is, and 'r' double, 'i' int32_t or 'b' bool. */
typedef struct {
    void *at;
    char type;
} Field;

/* Run one cycle for each row of `given` (rows × given_fields) and put the outputs into `results` (rows × result_fields). */
FMI2_EXPORT void axcomp_run(const Tables *tables, const double *pool, State *state, Inputs *inputs, Outputs *outputs,
                            int64_t rows, const Field *given_fields, int32_t given_count, const double *given,
                            const Field *result_fields, int32_t result_count, double *results);

#ifdef __cplusplus
}
#endif

#endif
