/* The functions of FMI 3.0 that this FMU has no use for: other types, clocks, derivatives, other kinds of simulation. */
#include "fmi3.h"

#include "instance.h"

static fmi3Status refused(fmi3Instance component, const char *function)
{
    const Instance *instance = (const Instance *)component;
    return instance == NULL ? fmi3Error
                            : (fmi3Status)axcomp_say(instance, fmi2Error, "%s: this FMU has nothing of the kind", function);
}

#define REFUSED(NAME, ...) FMI3_EXPORT fmi3Status FMI3_NAME(NAME)(fmi3Instance instance, __VA_ARGS__)

#define NO_ARGUMENTS(NAME)                                                                                             \
    FMI3_EXPORT fmi3Status FMI3_NAME(NAME)(fmi3Instance instance)                                                      \
    {                                                                                                                  \
        return refused(instance, #NAME);                                                                               \
    }

/* No variable has the type: only nothing can be read or set. */
#define NO_TYPE(TYPE)                                                                                                  \
    REFUSED(fmi3Get##TYPE, const fmi3ValueReference references[], size_t count, fmi3##TYPE values[], size_t value_count) \
    {                                                                                                                  \
        (void)references, (void)values, (void)value_count;                                                             \
        return count == 0 && instance != NULL ? fmi3OK : refused(instance, "fmi3Get" #TYPE);                           \
    }                                                                                                                  \
    REFUSED(fmi3Set##TYPE, const fmi3ValueReference references[], size_t count, const fmi3##TYPE values[],             \
            size_t value_count)                                                                                        \
    {                                                                                                                  \
        (void)references, (void)values, (void)value_count;                                                             \
        return count == 0 && instance != NULL ? fmi3OK : refused(instance, "fmi3Set" #TYPE);                           \
    }

NO_TYPE(Float32)
NO_TYPE(Int8)
NO_TYPE(UInt8)
NO_TYPE(Int16)
NO_TYPE(UInt16)
NO_TYPE(UInt32)
NO_TYPE(Int64)
NO_TYPE(UInt64)

REFUSED(fmi3GetBinary, const fmi3ValueReference references[], size_t count, size_t sizes[], fmi3Binary values[],
        size_t value_count)
{
    (void)references, (void)sizes, (void)values, (void)value_count;
    return count == 0 && instance != NULL ? fmi3OK : refused(instance, "fmi3GetBinary");
}

REFUSED(fmi3SetBinary, const fmi3ValueReference references[], size_t count, const size_t sizes[],
        const fmi3Binary values[], size_t value_count)
{
    (void)references, (void)sizes, (void)values, (void)value_count;
    return count == 0 && instance != NULL ? fmi3OK : refused(instance, "fmi3SetBinary");
}

REFUSED(fmi3GetClock, const fmi3ValueReference references[], size_t count, fmi3Clock values[])
{
    (void)references, (void)values;
    return count == 0 && instance != NULL ? fmi3OK : refused(instance, "fmi3GetClock");
}

REFUSED(fmi3SetClock, const fmi3ValueReference references[], size_t count, const fmi3Clock values[])
{
    (void)references, (void)values;
    return count == 0 && instance != NULL ? fmi3OK : refused(instance, "fmi3SetClock");
}

REFUSED(fmi3GetNumberOfVariableDependencies, fmi3ValueReference reference, size_t *count)
{
    (void)reference, (void)count;
    return refused(instance, "fmi3GetNumberOfVariableDependencies");
}

REFUSED(fmi3GetVariableDependencies, fmi3ValueReference dependent, size_t dependent_elements[],
        fmi3ValueReference independents[], size_t independent_elements[], fmi3DependencyKind kinds[], size_t count)
{
    (void)dependent, (void)dependent_elements, (void)independents, (void)independent_elements, (void)kinds, (void)count;
    return refused(instance, "fmi3GetVariableDependencies");
}

#define NO_DERIVATIVE(NAME)                                                                                            \
    REFUSED(NAME, const fmi3ValueReference unknowns[], size_t unknown_count, const fmi3ValueReference knowns[],        \
            size_t known_count, const fmi3Float64 seed[], size_t seed_count, fmi3Float64 sensitivity[],                \
            size_t sensitivity_count)                                                                                  \
    {                                                                                                                  \
        (void)unknowns, (void)unknown_count, (void)knowns, (void)known_count;                                          \
        (void)seed, (void)seed_count, (void)sensitivity, (void)sensitivity_count;                                      \
        return refused(instance, #NAME);                                                                               \
    }

NO_DERIVATIVE(fmi3GetDirectionalDerivative)
NO_DERIVATIVE(fmi3GetAdjointDerivative)

REFUSED(fmi3GetOutputDerivatives, const fmi3ValueReference references[], size_t count, const fmi3Int32 orders[],
        fmi3Float64 values[], size_t value_count)
{
    (void)references, (void)orders, (void)values, (void)value_count;
    return count == 0 && instance != NULL ? fmi3OK : refused(instance, "fmi3GetOutputDerivatives");
}

NO_ARGUMENTS(fmi3EnterConfigurationMode)
NO_ARGUMENTS(fmi3ExitConfigurationMode)

/* ---- Clocks ---- */

REFUSED(fmi3GetIntervalDecimal, const fmi3ValueReference references[], size_t count, fmi3Float64 intervals[],
        fmi3IntervalQualifier qualifiers[])
{
    (void)references, (void)count, (void)intervals, (void)qualifiers;
    return refused(instance, "fmi3GetIntervalDecimal");
}

REFUSED(fmi3GetIntervalFraction, const fmi3ValueReference references[], size_t count, fmi3UInt64 counters[],
        fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
{
    (void)references, (void)count, (void)counters, (void)resolutions, (void)qualifiers;
    return refused(instance, "fmi3GetIntervalFraction");
}

REFUSED(fmi3GetShiftDecimal, const fmi3ValueReference references[], size_t count, fmi3Float64 shifts[])
{
    (void)references, (void)count, (void)shifts;
    return refused(instance, "fmi3GetShiftDecimal");
}

REFUSED(fmi3GetShiftFraction, const fmi3ValueReference references[], size_t count, fmi3UInt64 counters[],
        fmi3UInt64 resolutions[])
{
    (void)references, (void)count, (void)counters, (void)resolutions;
    return refused(instance, "fmi3GetShiftFraction");
}

#define NO_CLOCK(NAME)                                                                                                 \
    REFUSED(NAME##Decimal, const fmi3ValueReference references[], size_t count, const fmi3Float64 times[])             \
    {                                                                                                                  \
        (void)references, (void)count, (void)times;                                                                    \
        return refused(instance, #NAME "Decimal");                                                                     \
    }                                                                                                                  \
    REFUSED(NAME##Fraction, const fmi3ValueReference references[], size_t count, const fmi3UInt64 counters[],          \
            const fmi3UInt64 resolutions[])                                                                            \
    {                                                                                                                  \
        (void)references, (void)count, (void)counters, (void)resolutions;                                              \
        return refused(instance, #NAME "Fraction");                                                                    \
    }

NO_CLOCK(fmi3SetInterval)
NO_CLOCK(fmi3SetShift)

REFUSED(fmi3ActivateModelPartition, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)clock, (void)time;
    return refused(instance, "fmi3ActivateModelPartition");
}

FMI3_EXPORT fmi3Instance FMI3_NAME(fmi3InstantiateScheduledExecution)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging;
    (void)environment, (void)log, (void)update, (void)lock, (void)unlock;
    return NULL;
}

/* ---- Model exchange ---- */

FMI3_EXPORT fmi3Instance FMI3_NAME(fmi3InstantiateModelExchange)(fmi3String name, fmi3String token,
                                                                 fmi3String resources, fmi3Boolean visible,
                                                                 fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                                                 fmi3LogMessageCallback log)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)environment, (void)log;
    return NULL;
}

NO_ARGUMENTS(fmi3EnterContinuousTimeMode)

REFUSED(fmi3CompletedIntegratorStep, fmi3Boolean no_set_state_before, fmi3Boolean *event, fmi3Boolean *terminate)
{
    (void)no_set_state_before, (void)event, (void)terminate;
    return refused(instance, "fmi3CompletedIntegratorStep");
}

REFUSED(fmi3SetTime, fmi3Float64 time)
{
    (void)time;
    return refused(instance, "fmi3SetTime");
}

REFUSED(fmi3SetContinuousStates, const fmi3Float64 values[], size_t count)
{
    (void)values, (void)count;
    return refused(instance, "fmi3SetContinuousStates");
}

#define NO_STATES(NAME)                                                                                                \
    REFUSED(NAME, fmi3Float64 values[], size_t count)                                                                  \
    {                                                                                                                  \
        (void)values, (void)count;                                                                                     \
        return refused(instance, #NAME);                                                                               \
    }

NO_STATES(fmi3GetContinuousStateDerivatives)
NO_STATES(fmi3GetEventIndicators)
NO_STATES(fmi3GetContinuousStates)
NO_STATES(fmi3GetNominalsOfContinuousStates)

#define NO_NUMBER(NAME)                                                                                                \
    REFUSED(NAME, size_t *count)                                                                                       \
    {                                                                                                                  \
        (void)count;                                                                                                   \
        return refused(instance, #NAME);                                                                               \
    }

NO_NUMBER(fmi3GetNumberOfEventIndicators)
NO_NUMBER(fmi3GetNumberOfContinuousStates)
