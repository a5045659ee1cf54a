/* The functions of FMI 2.0 that get and set values: a value reference says where in memory a value is. */
#include <math.h>
#include <string.h>

#include "fmi2.h"
#include "instance.h"
#include "places.h"

enum {
    WITH_INPUTS = INSTANTIATED | INITIALIZATION | STEPPING,
    WITH_VALUES = INITIALIZATION | STEPPING | TERMINATED
};

/* Where the value of a reference is, and of what kind; NULL after telling the host that there is none. */
static void *place_of(Instance *instance, fmi2ValueReference reference, char type, const Place **place)
{
    Memory *memory = &instance->memory;
    unsigned block = reference / PLACES;
    void *record = NULL;
    *place = NULL;
    if (block == MACHINE_BLOCK) {
        *place = &axcomp_machine_places[reference % PLACES];
        record = memory;
    } else if (block >= AXIS_BLOCK && block < AXIS_BLOCK + (unsigned)instance->lists->tables.axis_count) {
        *place = &axcomp_axis_places[reference % PLACES];
        record = (*place)->causality == 'o' ? (void *)&memory->outputs.axis[block - AXIS_BLOCK]
                                            : (void *)&memory->inputs.axis[block - AXIS_BLOCK];
    } else if (block >= VOLUMETRIC_BLOCK && block < VOLUMETRIC_BLOCK + (unsigned)instance->lists->tables.volumetrics) {
        *place = &axcomp_volumetric_places[reference % PLACES];
        record = (*place)->causality == 'o' ? (void *)&memory->outputs.volumetric[block - VOLUMETRIC_BLOCK]
                                            : (void *)&memory->inputs.volumetric[block - VOLUMETRIC_BLOCK];
    }
    char own = record != NULL ? (*place)->type : 0;
    bool as_real = type == 'r' && instance->first->real_only && (own == 'b' || own == 'i');
    if (own != type && !as_real) {
        axcomp_say(instance, fmi2Error, "there is no variable of this type with the value reference %u", reference);
        return NULL;
    }
    return (char *)record + (*place)->offset;
}

/* The instance, if values may be read now; during initialization the outputs are computed first. */
static Instance *readable(fmi2Component component, const void *references, const void *values, size_t count)
{
    Instance *instance = axcomp_allowed(component, WITH_VALUES, "fmi2Get...");
    if (count > 0) {
        instance = axcomp_given(axcomp_given(instance, references, "fmi2Get..."), values, "fmi2Get...");
    }
    if (instance != NULL && instance->memory.phase == INITIALIZATION) {
        axcomp_preview_outputs(instance);
    }
    return instance;
}

/* Where a value is to be set; NULL after telling the host that it must not be. */
static void *settable(Instance *instance, fmi2ValueReference reference, char type, const Place **place)
{
    void *value = place_of(instance, reference, type, place);
    if (value == NULL) {
        return NULL;
    }
    bool fixed = (*place)->causality == 'p' && instance->memory.phase == STEPPING;
    if ((*place)->causality == 'o' || fixed) {
        axcomp_say(instance, fmi2Error, "the variable with the value reference %u cannot be set now", reference);
        return NULL;
    }
    return value;
}

static Instance *writable(fmi2Component component, const void *references, const void *values, size_t count)
{
    Instance *instance = axcomp_allowed(component, WITH_INPUTS, "fmi2Set...");
    return count == 0 ? instance : axcomp_given(axcomp_given(instance, references, "fmi2Set..."), values, "fmi2Set...");
}

/* The nearest integer; of what has none the largest, which is no value of a switch. */
static int32_t whole(double value)
{
    return value > -(double)INT32_MAX && value < (double)INT32_MAX ? (int32_t)floor(value + 0.5) : INT32_MAX;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetReal)(fmi2Component component, const fmi2ValueReference references[],
                                              size_t count, fmi2Real values[])
{
    Instance *instance = readable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    const Place *place;
    for (size_t i = 0; i < count; i++) {
        const void *value = place_of(instance, references[i], 'r', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        values[i] = place->type == 'b' ? (double)*(const bool *)value
            : place->type == 'i'       ? (double)*(const int32_t *)value
                                       : *(const double *)value;
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetInteger)(fmi2Component component, const fmi2ValueReference references[],
                                                 size_t count, fmi2Integer values[])
{
    Instance *instance = readable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    const Place *place;
    for (size_t i = 0; i < count; i++) {
        const int32_t *value = (const int32_t *)place_of(instance, references[i], 'i', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        values[i] = *value;
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetBoolean)(fmi2Component component, const fmi2ValueReference references[],
                                                 size_t count, fmi2Boolean values[])
{
    Instance *instance = readable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    const Place *place;
    for (size_t i = 0; i < count; i++) {
        const bool *value = (const bool *)place_of(instance, references[i], 'b', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        values[i] = *value ? fmi2True : fmi2False;
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetString)(fmi2Component component, const fmi2ValueReference references[],
                                                size_t count, fmi2String values[])
{
    Instance *instance = readable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    const Place *place;
    for (size_t i = 0; i < count; i++) {
        const char *value = (const char *)place_of(instance, references[i], 's', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        values[i] = value;
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetReal)(fmi2Component component, const fmi2ValueReference references[],
                                              size_t count, const fmi2Real values[])
{
    Instance *instance = writable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    fmi2Status status = fmi2OK;
    const Place *place;
    for (size_t i = 0; i < count && status == fmi2OK; i++) {
        void *value = settable(instance, references[i], 'r', &place);
        if (value == NULL) {
            status = fmi2Error;
        } else if (place->type == 'b') {
            *(bool *)value = whole(values[i]) != 0 && values[i] == values[i];
        } else if (place->type == 'i') {
            *(int32_t *)value = whole(values[i]);
        } else if (place->causality == 'p' && !axcomp_cycle_time_fits(values[i])) {
            status = axcomp_say(instance, fmi2Error, "cycle_time must be above 0 s and below 1000 s, not %g", values[i]);
        } else {
            *(double *)value = values[i];
        }
    }
    if (instance->first->real_only) {
        axcomp_watch_reload(instance, false);
    }
    return status;
}

/* The slope of a Real input; the arrays of both records are alike. */
static double *slope_of(Memory *memory, const char *input)
{
    if (input == (const char *)&memory->inputs.tool_length) {
        return &memory->slopes.tool_length;
    }
    return (double *)(void *)((char *)memory->slopes.axis + (input - (const char *)memory->inputs.axis));
}

/* First derivatives: the inputs go on along them during the next step. Those of higher order are passed over. */
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetRealInputDerivatives)(fmi2Component component,
                                                              const fmi2ValueReference references[], size_t count,
                                                              const fmi2Integer orders[], const fmi2Real values[])
{
    Instance *instance = writable(component, references, values, count);
    if (count > 0) {
        instance = axcomp_given(instance, orders, "fmi2SetRealInputDerivatives");
    }
    if (instance == NULL) {
        return fmi2Error;
    }
    fmi2Status status = fmi2OK;
    Memory *memory = &instance->memory;
    const Place *place;
    for (size_t i = 0; i < count; i++) {
        const char *value = (const char *)settable(instance, references[i], 'r', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        if (place->causality != 'i' || place->type != 'r' || orders[i] < 1) {
            return axcomp_say(instance, fmi2Error, "the variable with the value reference %u has no derivative of order %d",
                              references[i], orders[i]);
        }
        if (orders[i] > 1) {
            status = axcomp_say(instance, fmi2Warning, "derivatives of order %d are not used, only the first", orders[i]);
        } else {
            *slope_of(memory, value) = values[i];
            memory->sloped = true;
        }
    }
    return status;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetInteger)(fmi2Component component, const fmi2ValueReference references[],
                                                 size_t count, const fmi2Integer values[])
{
    Instance *instance = writable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    const Place *place;
    for (size_t i = 0; i < count; i++) {
        int32_t *value = (int32_t *)settable(instance, references[i], 'i', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        *value = values[i];
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetBoolean)(fmi2Component component, const fmi2ValueReference references[],
                                                 size_t count, const fmi2Boolean values[])
{
    Instance *instance = writable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    fmi2Status status = fmi2OK;
    const Place *place;
    for (size_t i = 0; i < count && status == fmi2OK; i++) {
        bool *value = (bool *)settable(instance, references[i], 'b', &place);
        if (value != NULL) {
            *value = values[i] != fmi2False;
        } else {
            status = fmi2Error;
        }
    }
    axcomp_watch_reload(instance, false);
    return status;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetString)(fmi2Component component, const fmi2ValueReference references[],
                                                size_t count, const fmi2String values[])
{
    Instance *instance = writable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    const Place *place;
    for (size_t i = 0; i < count; i++) {
        char *value = (char *)settable(instance, references[i], 's', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        if (values[i] == NULL || strlen(values[i]) + 1 > PATH_LENGTH) {
            return axcomp_say(instance, fmi2Error, "a string is missing, or has more than %d bytes", PATH_LENGTH - 1);
        }
        memmove(value, values[i], strlen(values[i]) + 1);
    }
    axcomp_watch_reload(instance, true);
    return fmi2OK;
}
