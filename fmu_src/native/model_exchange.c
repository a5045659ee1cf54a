/* The functions of FMI 2.0 for model exchange: some hosts refuse a library that does not have them. All return an error. */
#include "fmi2.h"

#include <stddef.h>

#define REFUSED(NAME, ...) FMI2_EXPORT fmi2Status FMI2_NAME(NAME)(fmi2Component component, __VA_ARGS__)

#define REFUSED_WITHOUT_ARGUMENTS(NAME)                                                                                \
    FMI2_EXPORT fmi2Status FMI2_NAME(NAME)(fmi2Component component)                                                    \
    {                                                                                                                  \
        (void)component;                                                                                               \
        return fmi2Error;                                                                                              \
    }

REFUSED_WITHOUT_ARGUMENTS(fmi2EnterEventMode)
REFUSED_WITHOUT_ARGUMENTS(fmi2EnterContinuousTimeMode)

REFUSED(fmi2NewDiscreteStates, fmi2EventInfo *info)
{
    (void)component, (void)info;
    return fmi2Error;
}

REFUSED(fmi2CompletedIntegratorStep, fmi2Boolean no_set_state_before, fmi2Boolean *event, fmi2Boolean *terminate)
{
    (void)component, (void)no_set_state_before, (void)event, (void)terminate;
    return fmi2Error;
}

REFUSED(fmi2SetTime, fmi2Real time)
{
    (void)component, (void)time;
    return fmi2Error;
}

REFUSED(fmi2SetContinuousStates, const fmi2Real values[], size_t count)
{
    (void)component, (void)values, (void)count;
    return fmi2Error;
}

REFUSED(fmi2GetDerivatives, fmi2Real values[], size_t count)
{
    (void)component, (void)values, (void)count;
    return fmi2Error;
}

REFUSED(fmi2GetEventIndicators, fmi2Real values[], size_t count)
{
    (void)component, (void)values, (void)count;
    return fmi2Error;
}

REFUSED(fmi2GetContinuousStates, fmi2Real values[], size_t count)
{
    (void)component, (void)values, (void)count;
    return fmi2Error;
}

REFUSED(fmi2GetNominalsOfContinuousStates, fmi2Real values[], size_t count)
{
    (void)component, (void)values, (void)count;
    return fmi2Error;
}
