/* An FMU that only copies: what a host pays in any case for setting inputs, a step and reading outputs. */
#include <stdlib.h>

#include "fmi2.h"

enum { BLOCK = 64, REFERENCES = BLOCK * 64, AXES = 32, INPUTS = 4, FIRST_OUTPUT = 8, OUTPUTS = 10 };

/* By value reference: what was set, and what is read after the next step. */
typedef struct {
    double given[REFERENCES];
    double result[REFERENCES];
    size_t blocks; /* the highest one that was set, at most that of the last axis */
} Copy;

FMI2_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String location,
                                          const fmi2CallbackFunctions *callbacks, fmi2Boolean visible,
                                          fmi2Boolean logging)
{
    (void)name, (void)type, (void)guid, (void)location, (void)callbacks, (void)visible, (void)logging;
    return calloc(1, sizeof(Copy));
}

FMI2_EXPORT void fmi2FreeInstance(fmi2Component component)
{
    free(component);
}

#define WITHOUT_EFFECT(NAME, PARAMETERS)                                                                               \
    FMI2_EXPORT fmi2Status NAME PARAMETERS                                                                             \
    {                                                                                                                  \
        return component != NULL ? fmi2OK : fmi2Error;                                                                 \
    }

WITHOUT_EFFECT(fmi2EnterInitializationMode, (fmi2Component component))
WITHOUT_EFFECT(fmi2ExitInitializationMode, (fmi2Component component))

#define SET(NAME, TYPE)                                                                                                \
    FMI2_EXPORT fmi2Status NAME(fmi2Component component, const fmi2ValueReference references[], size_t count,          \
                                const TYPE values[])                                                                   \
    {                                                                                                                  \
        Copy *copy = (Copy *)component;                                                                                \
        for (size_t i = 0; i < count; i++) {                                                                           \
            if (references[i] >= REFERENCES) {                                                                         \
                return fmi2Error;                                                                                      \
            }                                                                                                          \
            copy->given[references[i]] = values[i];                                                                    \
            if (references[i] / BLOCK > copy->blocks && references[i] / BLOCK <= AXES) {                               \
                copy->blocks = references[i] / BLOCK;                                                                  \
            }                                                                                                          \
        }                                                                                                              \
        return fmi2OK;                                                                                                 \
    }

#define GET(NAME, TYPE)                                                                                                \
    FMI2_EXPORT fmi2Status NAME(fmi2Component component, const fmi2ValueReference references[], size_t count,          \
                                TYPE values[])                                                                         \
    {                                                                                                                  \
        const Copy *copy = (const Copy *)component;                                                                    \
        for (size_t i = 0; i < count; i++) {                                                                           \
            if (references[i] >= REFERENCES) {                                                                         \
                return fmi2Error;                                                                                      \
            }                                                                                                          \
            values[i] = (TYPE)copy->result[references[i]];                                                             \
        }                                                                                                              \
        return fmi2OK;                                                                                                 \
    }

SET(fmi2SetReal, fmi2Real)
SET(fmi2SetInteger, fmi2Integer)
SET(fmi2SetBoolean, fmi2Boolean)
GET(fmi2GetReal, fmi2Real)
GET(fmi2GetInteger, fmi2Integer)
GET(fmi2GetBoolean, fmi2Boolean)

/* The real inputs of each axis go to its real outputs, over and over. */
FMI2_EXPORT fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_set_state_before)
{
    Copy *copy = (Copy *)component;
    (void)time, (void)step, (void)no_set_state_before;
    for (size_t block = 1; block <= copy->blocks; block++) {
        for (size_t k = 0; k < OUTPUTS; k++) {
            copy->result[BLOCK * block + FIRST_OUTPUT + k] = copy->given[BLOCK * block + k % INPUTS];
        }
    }
    return fmi2OK;
}
