/* The functions of FMI 2.0 that get and set values: a value reference says where in memory a value is. */
#include <math.h>
#include <string.h>

#include "fmi2.h"
#include "spot.h"

enum {
    WITH_INPUTS = INSTANTIATED | INITIALIZATION | STEPPING | EVENT,
    WITH_VALUES = INITIALIZATION | STEPPING | EVENT | TERMINATED
};

static fmi2Status say_unknown(const Instance *instance, fmi2ValueReference reference)
{
    return axcomp_say(instance, fmi2Error, "there is no variable of this type with the value reference %u", reference);
}

/* Whether a variable that is no input may be set now; if not, the host is told. */
static bool may_set(const Instance *instance, const Place *place, fmi2ValueReference reference)
{
    bool fixed = place->causality == 'p' && (instance->memory.phase & (STEPPING | EVENT)) != 0;
    if (place->causality == 'o' || fixed) {
        axcomp_say(instance, fmi2Error, "the variable with the value reference %u cannot be set now", reference);
        return false;
    }
    return true;
}

/* Whether a variable can be taken for one of another type: in some FMUs Booleans and Integers are Real. */
static bool is_real(const Instance *instance, const Place *place)
{
    return instance->first->real_only && (place->type == 'b' || place->type == 'i');
}

/* Do something with each variable of a type, which is `at` where `place` says; hosts name the variables of a block one
 * after the other. */
#define FOR_EACH(LETTER, DO)                                                                                         \
    for (size_t i = 0; i < count;) {                                                                                 \
        const Spot spot = axcomp_spot_of(&instance->memory, &instance->lists->tables, references[i] / PLACES);       \
        do {                                                                                                         \
            const Place *place = &spot.places[references[i] % PLACES];                                               \
            if (place->type != (LETTER) && !((LETTER) == 'r' && is_real(instance, place))) {                         \
                return say_unknown(instance, references[i]);                                                         \
            }                                                                                                        \
            void *at = axcomp_at(&spot, place);                                                                      \
            DO                                                                                                       \
            i++;                                                                                                     \
        } while (i < count && references[i] / PLACES == spot.block);                                                 \
    }

#define GETTER(NAME, FmiType, LETTER, VALUE)                                                                         \
    FMI2_EXPORT fmi2Status FMI2_NAME(NAME)(fmi2Component component, const fmi2ValueReference references[],           \
                                           size_t count, FmiType values[])                                           \
    {                                                                                                                \
        Instance *instance = readable(component, references, values, count);                                         \
        if (instance == NULL) {                                                                                      \
            return fmi2Error;                                                                                        \
        }                                                                                                            \
        FOR_EACH(LETTER, values[i] = VALUE;)                                                                         \
        return fmi2OK;                                                                                               \
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
    } else if (instance != NULL && instance->memory.phase == EVENT) {
        axcomp_refresh_outputs(instance);
    }
    return instance;
}

static Instance *writable(fmi2Component component, const void *references, const void *values, size_t count)
{
    Instance *instance = axcomp_allowed(component, WITH_INPUTS, "fmi2Set...");
    if (count > 0) {
        instance = axcomp_given(axcomp_given(instance, references, "fmi2Set..."), values, "fmi2Set...");
    }
    if (instance != NULL) {
        instance->stale = true;
    }
    return instance;
}

/* A variable of another type as a Real. */
static double number_of(const Place *place, const void *at)
{
    return place->type == 'b' ? (double)*(const bool *)at : (double)*(const int32_t *)at;
}

GETTER(fmi2GetReal, fmi2Real, 'r', place->type == 'r' ? *(const double *)at : number_of(place, at))
GETTER(fmi2GetInteger, fmi2Integer, 'i', *(const int32_t *)at)
GETTER(fmi2GetBoolean, fmi2Boolean, 'b', *(const bool *)at ? fmi2True : fmi2False)
GETTER(fmi2GetString, fmi2String, 's', (const char *)at)

/* The nearest integer; of what has none the largest, which is no value of a switch. */
static int32_t whole(double value)
{
    return value > -(double)INT32_MAX && value < (double)INT32_MAX ? (int32_t)floor(value + 0.5) : INT32_MAX;
}

static void set_number(const Place *place, void *at, double value)
{
    if (place->type == 'b') {
        *(bool *)at = whole(value) != 0 && value == value;
    } else {
        *(int32_t *)at = whole(value);
    }
}

static fmi2Status set_reals(Instance *instance, const fmi2ValueReference references[], size_t count,
                            const fmi2Real values[])
{
    FOR_EACH('r', {
        if (place->causality != 'i' && !may_set(instance, place, references[i])) {
            return fmi2Error;
        }
        if (place->type != 'r') {
            set_number(place, at, values[i]);
        } else if (place->causality == 'p' && !axcomp_cycle_time_fits(values[i])) {
            return axcomp_say(instance, fmi2Error, "cycle_time must be above 0 s and below 1000 s, not %g", values[i]);
        } else {
            *(double *)at = values[i];
        }
    })
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetReal)(fmi2Component component, const fmi2ValueReference references[],
                                              size_t count, const fmi2Real values[])
{
    Instance *instance = writable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    fmi2Status status = set_reals(instance, references, count, values);
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
    FOR_EACH('r', {
        if (!may_set(instance, place, references[i])) {
            return fmi2Error;
        }
        if (place->causality != 'i' || place->type != 'r' || orders[i] < 1) {
            return axcomp_say(instance, fmi2Error, "the variable with the value reference %u has no derivative of order %d",
                              references[i], orders[i]);
        }
        if (orders[i] > 1) {
            status = axcomp_say(instance, fmi2Warning, "derivatives of order %d are not used, only the first", orders[i]);
        } else {
            *slope_of(memory, (const char *)at) = values[i];
            memory->sloped = true;
        }
    })
    return status;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetInteger)(fmi2Component component, const fmi2ValueReference references[],
                                                 size_t count, const fmi2Integer values[])
{
    Instance *instance = writable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    FOR_EACH('i', {
        if (place->causality != 'i' && !may_set(instance, place, references[i])) {
            return fmi2Error;
        }
        *(int32_t *)at = values[i];
    })
    return fmi2OK;
}

static fmi2Status set_booleans(Instance *instance, const fmi2ValueReference references[], size_t count,
                               const fmi2Boolean values[])
{
    FOR_EACH('b', {
        if (place->causality != 'i' && !may_set(instance, place, references[i])) {
            return fmi2Error;
        }
        *(bool *)at = values[i] != fmi2False;
    })
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetBoolean)(fmi2Component component, const fmi2ValueReference references[],
                                                 size_t count, const fmi2Boolean values[])
{
    Instance *instance = writable(component, references, values, count);
    if (instance == NULL) {
        return fmi2Error;
    }
    fmi2Status status = set_booleans(instance, references, count, values);
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
    FOR_EACH('s', {
        if (place->causality != 'i' && !may_set(instance, place, references[i])) {
            return fmi2Error;
        }
        if (values[i] == NULL || strlen(values[i]) + 1 > PATH_LENGTH) {
            return axcomp_say(instance, fmi2Error, "a string is missing, or has more than %d bytes", PATH_LENGTH - 1);
        }
        memmove(at, values[i], strlen(values[i]) + 1);
    })
    axcomp_watch_reload(instance, true);
    return fmi2OK;
}
