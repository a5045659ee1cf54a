/* Tables as arrays: which numbers of the pool they are, what makes a table, and how a change comes into force. */
#include "tuning.h"

#include <string.h>

#include "layout.h"
#include "places.h"

/* The array of a reference, and the place of its axis; NULL: there is none. */
static const TableArray *array_of(const Instance *instance, uint32_t reference, int32_t *axis)
{
    *axis = (int32_t)(reference / PLACES) - (int32_t)TABLE_BLOCK;
    if (*axis < 0 || *axis >= instance->first->tables.axis_count) {
        return NULL;
    }
    for (const TableArray *array = axcomp_table_arrays; array->name != NULL; array++) {
        if (array->identifier == reference % PLACES) {
            return array;
        }
    }
    return NULL;
}

static int32_t number_at(const AxisTable *table, size_t offset)
{
    return *(const int32_t *)(const void *)((const char *)table + offset);
}

static size_t size_in(const AxisTable *table, const TableArray *array)
{
    size_t rows = array->rows != 0 ? (size_t)number_at(table, array->rows) : 1u;
    return rows * (size_t)number_at(table, array->points);
}

size_t axcomp_array_size(const Instance *instance, uint32_t reference)
{
    int32_t axis;
    const TableArray *array = array_of(instance, reference, &axis);
    return array != NULL ? size_in(&instance->first->tables.axis[axis], array) : 0;
}

const double *axcomp_array(const Instance *instance, const Lists *lists, uint32_t reference)
{
    int32_t axis;
    const TableArray *array = array_of(instance, reference, &axis);
    size_t size = axcomp_array_size(instance, reference);
    if (size == 0) {
        axcomp_say(instance, fmi2Error, "there is no array with the value reference %u", reference);
        return NULL;
    }
    const AxisTable *table = &lists->tables.axis[axis];
    if (size_in(table, array) != size) {
        axcomp_say(instance, fmi2Error, "axis %d: %s has another number of values since an update", table->number,
                   array->name);
        return NULL;
    }
    return lists->pool + number_at(table, array->at);
}

/* Why numbers make no table, NULL: they do; `n`: which of them. */
static const char *complaint(const TableArray *array, const double *values, size_t size, size_t *n)
{
    for (*n = 0; *n < size; ++*n) {
        double value = values[*n];
        if (!(value - value == 0.0)) {
            return "is not finite";
        }
        if (!(value < LARGEST && value > -LARGEST)) {
            return "is too large";
        }
        if (array->role == 'v' && value < 0.0) {
            return "is negative";
        }
        if (array->role != 'y' && *n > 0 && !(values[*n - 1u] < value)) {
            return "is not above the one before it";
        }
    }
    return NULL;
}

/* Positions of an axis that counts modulo are folded into a turn that lies where the table does. */
static const char *follow(AxisTable *table, const TableArray *array, const double *before, const double *after,
                          size_t size)
{
    if (array->argument == 0 || array->role == 'y') {
        return NULL;
    }
    Argument *argument = (Argument *)(void *)((char *)table + array->argument);
    if (argument->period > 0.0) {
        if (argument->start == before[0]) {
            if (after[size - 1u] != after[0] + argument->period) {
                return "must lie one turn behind the first: the table repeats";
            }
            argument->start = after[0];
        } else {
            argument->start = 0.5 * (after[0] + after[size - 1u] - argument->period);
        }
    }
    return NULL;
}

fmi2Status axcomp_put_array(const Instance *instance, Lists *copy, uint32_t reference, const double *values)
{
    if (copy == NULL) {
        return axcomp_say(instance, fmi2Error, "fmi3SetFloat64: there is no memory for changed tables");
    }
    double *numbers = (double *)axcomp_array(instance, copy, reference);
    if (numbers == NULL) {
        return fmi2Error;
    }
    int32_t axis;
    const TableArray *array = array_of(instance, reference, &axis);
    AxisTable *table = &copy->tables.axis[axis];
    size_t size = size_in(table, array), n;
    const char *why = complaint(array, values, size, &n);
    if (why == NULL) {
        why = follow(table, array, numbers, values, size);
        n = size - 1u;
    }
    if (why != NULL) {
        return axcomp_say(instance, fmi2Discard, "axis %d: %s keeps its old values: value %u, %g, %s", table->number,
                          array->name, (unsigned)n, values[n], why);
    }
    memcpy(numbers, values, size * sizeof *numbers);
    copy->identity = axcomp_crc32(copy->identity ^ reference, values, size * sizeof *values);
    return fmi2OK;
}

void axcomp_tune(Instance *instance, Lists *copy)
{
    Memory *memory = &instance->memory;
    const Lists *before = instance->lists;
    int rounding = axcomp_round_to_nearest();
    for (int32_t i = 0; i < instance->tables.axis_count; i++) {
        const AxisTable *old = &instance->tables.axis[i];
        AxisTable *table = &copy->tables.axis[i];
        if (memcmp(before->pool + old->first, copy->pool + table->first, (size_t)old->numbers * sizeof(double)) != 0) {
            axcomp_adopt_axis(old, before->pool, table, copy->pool, &memory->state, &memory->inputs.axis[i], i);
        }
    }
    axcomp_restore_rounding(rounding);
    axcomp_use_lists(instance, copy);
    instance->stale = true;
}
