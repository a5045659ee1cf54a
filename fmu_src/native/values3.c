/* The functions of FMI 3.0 that get and set values: single ones as in FMI 2.0, tables as arrays. */
#include <string.h>

#include "fmi3.h"
#include "instance.h"
#include "layout.h"
#include "places.h"
#include "tuning.h"

/* How many references from the first are of single values of the machine. */
static size_t singles(const fmi3ValueReference references[], size_t count)
{
    size_t n = 0;
    while (n < count && references[n] != TIME_REFERENCE && references[n] / PLACES < TABLE_BLOCK) {
        n++;
    }
    return n;
}

/* The instance, if so many values belong to the references; else NULL, after telling the host. */
static Instance *expected(fmi3Instance component, const fmi3ValueReference references[], size_t count,
                          const void *values, size_t value_count)
{
    Instance *instance = (Instance *)component;
    if (count > 0) {
        instance = axcomp_given(axcomp_given(instance, references, "fmi3Get or Set"), values, "fmi3Get or Set");
    }
    size_t needed = 0;
    for (size_t i = 0; instance != NULL && i < count; i++) {
        needed += references[i] / PLACES < TABLE_BLOCK ? 1u : axcomp_array_size(instance, references[i]);
    }
    if (instance != NULL && needed != value_count) {
        axcomp_say(instance, fmi2Error, "fmi3Get or Set: %u values for variables that have %u", (unsigned)value_count,
                   (unsigned)needed);
        return NULL;
    }
    return instance;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3GetFloat64)(fmi3Instance component, const fmi3ValueReference references[],
                                                 size_t count, fmi3Float64 values[], size_t value_count)
{
    Instance *instance = expected(component, references, count, values, value_count);
    if (instance == NULL) {
        return fmi3Error;
    }
    for (size_t i = 0; i < count;) {
        size_t n = singles(references + i, count - i);
        if (n > 0) {
            if (FMI2_NAME(fmi2GetReal)(instance, references + i, n, values) != fmi2OK) {
                return fmi3Error;
            }
            values += n;
            i += n;
        } else if (references[i] == TIME_REFERENCE) {
            *values++ = instance->memory.time;
            i++;
        } else {
            size_t size = axcomp_array_size(instance, references[i]);
            const double *array = axcomp_array(instance, instance->lists, references[i++]);
            if (array == NULL) {
                return fmi3Error;
            }
            memcpy(values, array, size * sizeof *values);
            values += size;
        }
    }
    return fmi3OK;
}

/* Set the tables among some variables: all of them, or none. */
static fmi3Status set_tables(Instance *instance, const fmi3ValueReference references[], size_t count,
                             const fmi3Float64 values[])
{
    Lists *changed = NULL;
    fmi2Status status = fmi2OK;
    for (size_t i = 0; i < count && status == fmi2OK; i++) {
        if (references[i] / PLACES < TABLE_BLOCK) {
            values++;
            continue;
        }
        if (changed == NULL) {
            changed = axcomp_copy_lists(instance);
        }
        status = axcomp_put_array(instance, changed, references[i], values);
        values += axcomp_array_size(instance, references[i]);
    }
    if (changed != NULL && status == fmi2OK) {
        axcomp_tune(instance, changed);
    } else if (changed != NULL) {
        axcomp_drop_lists(instance, changed);
    }
    return (fmi3Status)status;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3SetFloat64)(fmi3Instance component, const fmi3ValueReference references[],
                                                 size_t count, const fmi3Float64 values[], size_t value_count)
{
    Instance *instance = expected(component, references, count, values, value_count);
    if (instance == NULL || axcomp_allowed(instance, ~(unsigned)TERMINATED, "fmi3SetFloat64") == NULL) {
        return fmi3Error;
    }
    fmi3Status status = set_tables(instance, references, count, values);
    for (size_t i = 0; i < count && status == fmi3OK;) {
        size_t n = singles(references + i, count - i);
        if (n > 0) {
            status = (fmi3Status)FMI2_NAME(fmi2SetReal)(instance, references + i, n, values);
            values += n;
            i += n;
        } else if (references[i] == TIME_REFERENCE) {
            status = (fmi3Status)axcomp_say(instance, fmi2Error, "fmi3SetFloat64: the time cannot be set");
        } else {
            values += axcomp_array_size(instance, references[i++]);
        }
    }
    return status;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3GetInt32)(fmi3Instance component, const fmi3ValueReference references[],
                                               size_t count, fmi3Int32 values[], size_t value_count)
{
    Instance *instance = expected(component, references, count, values, value_count);
    return instance == NULL ? fmi3Error
                            : (fmi3Status)FMI2_NAME(fmi2GetInteger)(instance, references, count, (fmi2Integer *)values);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3SetInt32)(fmi3Instance component, const fmi3ValueReference references[],
                                               size_t count, const fmi3Int32 values[], size_t value_count)
{
    Instance *instance = expected(component, references, count, values, value_count);
    return instance == NULL
        ? fmi3Error
        : (fmi3Status)FMI2_NAME(fmi2SetInteger)(instance, references, count, (const fmi2Integer *)values);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3GetBoolean)(fmi3Instance component, const fmi3ValueReference references[],
                                                 size_t count, fmi3Boolean values[], size_t value_count)
{
    Instance *instance = expected(component, references, count, values, value_count);
    fmi2Status status = instance == NULL ? fmi2Error : fmi2OK;
    for (size_t i = 0; i < count && status == fmi2OK; i++) {
        fmi2Boolean value = fmi2False;
        status = FMI2_NAME(fmi2GetBoolean)(instance, references + i, 1, &value);
        values[i] = value != fmi2False;
    }
    return (fmi3Status)status;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3SetBoolean)(fmi3Instance component, const fmi3ValueReference references[],
                                                 size_t count, const fmi3Boolean values[], size_t value_count)
{
    Instance *instance = expected(component, references, count, values, value_count);
    fmi2Status status = instance == NULL ? fmi2Error : fmi2OK;
    for (size_t i = 0; i < count && status == fmi2OK; i++) {
        fmi2Boolean value = values[i] ? fmi2True : fmi2False;
        status = FMI2_NAME(fmi2SetBoolean)(instance, references + i, 1, &value);
    }
    return (fmi3Status)status;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3GetString)(fmi3Instance component, const fmi3ValueReference references[],
                                                size_t count, fmi3String values[], size_t value_count)
{
    Instance *instance = expected(component, references, count, values, value_count);
    return instance == NULL ? fmi3Error : (fmi3Status)FMI2_NAME(fmi2GetString)(instance, references, count, values);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3SetString)(fmi3Instance component, const fmi3ValueReference references[],
                                                size_t count, const fmi3String values[], size_t value_count)
{
    Instance *instance = expected(component, references, count, values, value_count);
    return instance == NULL ? fmi3Error : (fmi3Status)FMI2_NAME(fmi2SetString)(instance, references, count, values);
}
