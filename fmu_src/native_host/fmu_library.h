/* The library of an FMU in a host: loaded while the host runs, or linked to it (FMU_LINKED).
 *
 * The functions are listed once; structure, prototypes and look-up follow from the list. */
#ifndef FMU_LIBRARY_H
#define FMU_LIBRARY_H

#include "fmi2.h"

#ifdef __cplusplus
extern "C" {
#endif

/* FUNCTION(result, name without fmi2, parameters) */
#define FMU_FUNCTIONS(FUNCTION)                                                                                        \
    FUNCTION(const char *, GetTypesPlatform, (void))                                                                   \
    FUNCTION(const char *, GetVersion, (void))                                                                         \
    FUNCTION(fmi2Status, SetDebugLogging, (fmi2Component, fmi2Boolean, size_t, const fmi2String[]))                    \
    FUNCTION(fmi2Component, Instantiate, (fmi2String, fmi2Type, fmi2String, fmi2String,                                \
                                          const fmi2CallbackFunctions *, fmi2Boolean, fmi2Boolean))                    \
    FUNCTION(void, FreeInstance, (fmi2Component))                                                                      \
    FUNCTION(fmi2Status, SetupExperiment,                                                                              \
             (fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real))                                  \
    FUNCTION(fmi2Status, EnterInitializationMode, (fmi2Component))                                                     \
    FUNCTION(fmi2Status, ExitInitializationMode, (fmi2Component))                                                      \
    FUNCTION(fmi2Status, Terminate, (fmi2Component))                                                                   \
    FUNCTION(fmi2Status, Reset, (fmi2Component))                                                                       \
    FUNCTION(fmi2Status, GetReal, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]))                     \
    FUNCTION(fmi2Status, GetInteger, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Integer[]))               \
    FUNCTION(fmi2Status, GetBoolean, (fmi2Component, const fmi2ValueReference[], size_t, fmi2Boolean[]))               \
    FUNCTION(fmi2Status, GetString, (fmi2Component, const fmi2ValueReference[], size_t, fmi2String[]))                 \
    FUNCTION(fmi2Status, SetReal, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]))               \
    FUNCTION(fmi2Status, SetInteger, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[]))         \
    FUNCTION(fmi2Status, SetBoolean, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Boolean[]))         \
    FUNCTION(fmi2Status, SetString, (fmi2Component, const fmi2ValueReference[], size_t, const fmi2String[]))           \
    FUNCTION(fmi2Status, GetFMUstate, (fmi2Component, fmi2FMUstate *))                                                 \
    FUNCTION(fmi2Status, SetFMUstate, (fmi2Component, fmi2FMUstate))                                                   \
    FUNCTION(fmi2Status, FreeFMUstate, (fmi2Component, fmi2FMUstate *))                                                \
    FUNCTION(fmi2Status, SerializedFMUstateSize, (fmi2Component, fmi2FMUstate, size_t *))                              \
    FUNCTION(fmi2Status, SerializeFMUstate, (fmi2Component, fmi2FMUstate, fmi2Byte[], size_t))                         \
    FUNCTION(fmi2Status, DeSerializeFMUstate, (fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate *))               \
    FUNCTION(fmi2Status, GetDirectionalDerivative, (fmi2Component, const fmi2ValueReference[], size_t,                 \
                                                    const fmi2ValueReference[], size_t, const fmi2Real[], fmi2Real[])) \
    FUNCTION(fmi2Status, SetRealInputDerivatives,                                                                      \
             (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], const fmi2Real[]))               \
    FUNCTION(fmi2Status, GetRealOutputDerivatives,                                                                     \
             (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], fmi2Real[]))                     \
    FUNCTION(fmi2Status, DoStep, (fmi2Component, fmi2Real, fmi2Real, fmi2Boolean))                                     \
    FUNCTION(fmi2Status, CancelStep, (fmi2Component))                                                                  \
    FUNCTION(fmi2Status, GetStatus, (fmi2Component, const fmi2StatusKind, fmi2Status *))                               \
    FUNCTION(fmi2Status, GetRealStatus, (fmi2Component, const fmi2StatusKind, fmi2Real *))                             \
    FUNCTION(fmi2Status, GetIntegerStatus, (fmi2Component, const fmi2StatusKind, fmi2Integer *))                       \
    FUNCTION(fmi2Status, GetBooleanStatus, (fmi2Component, const fmi2StatusKind, fmi2Boolean *))                       \
    FUNCTION(fmi2Status, GetStringStatus, (fmi2Component, const fmi2StatusKind, fmi2String *))                         \
    FUNCTION(fmi2Status, EnterEventMode, (fmi2Component))                                                              \
    FUNCTION(fmi2Status, NewDiscreteStates, (fmi2Component, fmi2EventInfo *))                                          \
    FUNCTION(fmi2Status, EnterContinuousTimeMode, (fmi2Component))                                                     \
    FUNCTION(fmi2Status, CompletedIntegratorStep, (fmi2Component, fmi2Boolean, fmi2Boolean *, fmi2Boolean *))          \
    FUNCTION(fmi2Status, SetTime, (fmi2Component, fmi2Real))                                                           \
    FUNCTION(fmi2Status, SetContinuousStates, (fmi2Component, const fmi2Real[], size_t))                               \
    FUNCTION(fmi2Status, GetDerivatives, (fmi2Component, fmi2Real[], size_t))                                          \
    FUNCTION(fmi2Status, GetEventIndicators, (fmi2Component, fmi2Real[], size_t))                                      \
    FUNCTION(fmi2Status, GetContinuousStates, (fmi2Component, fmi2Real[], size_t))                                     \
    FUNCTION(fmi2Status, GetNominalsOfContinuousStates, (fmi2Component, fmi2Real[], size_t))

#define FMU_MEMBER(RESULT, NAME, PARAMETERS) RESULT(*NAME) PARAMETERS;

/* A function that the library does not have is NULL. */
typedef struct {
    FMU_FUNCTIONS(FMU_MEMBER)
} Fmu;

/* Load the library in `path` (linked functions: any). Returns the name of the first function it does not have, "" if
 * it cannot be loaded at all, NULL if everything is there. */
const char *load_fmu(const char *path, Fmu *fmu);

#ifdef __cplusplus
}
#endif

#endif
