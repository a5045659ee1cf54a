/* Whole trajectories: columns go into the inputs, the outputs into columns. */
#include "run.h"

#include <stdbool.h>

#include "layout.h"

uint32_t axcomp_layout(void)
{
    return AXCOMP_LAYOUT;
}

static void set_field(Field field, double value)
{
    if (field.type == 'r') {
        *(double *)field.at = value;
    } else if (field.type == 'b') {
        *(bool *)field.at = value != 0.0;
    } else {
        *(int32_t *)field.at = (int32_t)value;
    }
}

static double value_of(Field field)
{
    if (field.type == 'r') {
        return *(const double *)field.at;
    }
    return field.type == 'b' ? (double)*(const bool *)field.at : (double)*(const int32_t *)field.at;
}

void axcomp_run(const Tables *tables, const double *pool, State *state, Inputs *inputs, Outputs *outputs, int64_t rows,
                const Field *given_fields, int32_t given_count, const double *given, const Field *result_fields,
                int32_t result_count, double *results)
{
    for (int64_t row = 0; row < rows; row++) {
        for (int32_t k = 0; k < given_count; k++) {
            set_field(given_fields[k], *given++);
        }
        axcomp_cycle(tables, pool, state, inputs, outputs);
        for (int32_t k = 0; k < result_count; k++) {
            *results++ = value_of(result_fields[k]);
        }
    }
}
