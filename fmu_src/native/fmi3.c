/* The functions of FMI 3.0 that create instances and take them through their modes. Most are those of FMI 2.0 under
 * another name; values are in values3.c, what this FMU does not have in refused3.c. */
#include "fmi3.h"

#include "instance.h"

FMI3_EXPORT const char *FMI3_NAME(fmi3GetVersion)(void)
{
    return "3.0";
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3SetDebugLogging)(fmi3Instance instance, fmi3Boolean on, size_t count,
                                                      const fmi3String categories[])
{
    return (fmi3Status)FMI2_NAME(fmi2SetDebugLogging)(instance, on ? fmi2True : fmi2False, count, categories);
}

FMI3_EXPORT fmi3Instance FMI3_NAME(fmi3InstantiateCoSimulation)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean event_mode, fmi3Boolean early_return, const fmi3ValueReference intermediate[], size_t intermediate_count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    (void)visible, (void)early_return, (void)intermediate, (void)intermediate_count, (void)update;
    Instance *instance = axcomp_new_instance(name != NULL ? name : "");
    if (instance == NULL) {
        return NULL;
    }
    instance->event_mode = event_mode;
    instance->callbacks.componentEnvironment = environment;
    instance->log = (void (*)(void))log;
    axcomp_log_as_wanted(instance, logging, ~0u);
    return axcomp_begin_instance(instance, name, token, resources);
}

FMI3_EXPORT void FMI3_NAME(fmi3FreeInstance)(fmi3Instance instance)
{
    FMI2_NAME(fmi2FreeInstance)(instance);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3EnterInitializationMode)(fmi3Instance instance, fmi3Boolean tolerance_defined,
                                                              fmi3Float64 tolerance, fmi3Float64 start,
                                                              fmi3Boolean stop_defined, fmi3Float64 stop)
{
    fmi2Status status = FMI2_NAME(fmi2SetupExperiment)(instance, tolerance_defined ? fmi2True : fmi2False, tolerance,
                                                       start, stop_defined ? fmi2True : fmi2False, stop);
    return (fmi3Status)(status == fmi2OK ? FMI2_NAME(fmi2EnterInitializationMode)(instance) : status);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3ExitInitializationMode)(fmi3Instance component)
{
    fmi2Status status = FMI2_NAME(fmi2ExitInitializationMode)(component);
    Instance *instance = (Instance *)component;
    if (status == fmi2OK && instance->event_mode) {
        instance->memory.phase = EVENT;
    }
    return (fmi3Status)status;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3EnterEventMode)(fmi3Instance component)
{
    Instance *instance = axcomp_allowed(component, STEPPING, "fmi3EnterEventMode");
    if (instance == NULL) {
        return fmi3Error;
    }
    if (!instance->event_mode) {
        return (fmi3Status)axcomp_say(instance, fmi2Error, "fmi3EnterEventMode: eventModeUsed was false");
    }
    instance->memory.phase = EVENT;
    instance->stale = true;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3EnterStepMode)(fmi3Instance component)
{
    Instance *instance = axcomp_allowed(component, EVENT, "fmi3EnterStepMode");
    if (instance == NULL) {
        return fmi3Error;
    }
    instance->memory.phase = STEPPING;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3EvaluateDiscreteStates)(fmi3Instance component)
{
    Instance *instance = axcomp_allowed(component, EVENT | INITIALIZATION, "fmi3EvaluateDiscreteStates");
    return instance != NULL ? fmi3OK : fmi3Error;
}

/* The outputs now belong to the inputs of this instant: the step that follows runs the same cycle with them. */
FMI3_EXPORT fmi3Status FMI3_NAME(fmi3UpdateDiscreteStates)(fmi3Instance component, fmi3Boolean *again,
                                                           fmi3Boolean *terminate, fmi3Boolean *nominals_changed,
                                                           fmi3Boolean *values_changed, fmi3Boolean *next_known,
                                                           fmi3Float64 *next)
{
    Instance *instance = axcomp_allowed(component, EVENT, "fmi3UpdateDiscreteStates");
    if (instance == NULL) {
        return fmi3Error;
    }
    axcomp_take_update(instance);
    instance->stale = true;
    axcomp_refresh_outputs(instance);
    fmi3Boolean *const flags[] = {again, terminate, nominals_changed, values_changed, next_known};
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) {
        if (flags[i] != NULL) {
            *flags[i] = false;
        }
    }
    (void)next; /* cycles within a step are no events: their inputs are held */
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3Terminate)(fmi3Instance component)
{
    Instance *instance = axcomp_allowed(component, STEPPING | EVENT, "fmi3Terminate");
    if (instance == NULL) {
        return fmi3Error;
    }
    instance->memory.phase = TERMINATED;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3Reset)(fmi3Instance instance)
{
    return (fmi3Status)FMI2_NAME(fmi2Reset)(instance);
}

/* An event is at the end of a step if a cycle begins there, which samples the inputs. */
FMI3_EXPORT fmi3Status FMI3_NAME(fmi3DoStep)(fmi3Instance component, fmi3Float64 time, fmi3Float64 step,
                                             fmi3Boolean no_set_state_before, fmi3Boolean *event, fmi3Boolean *terminate,
                                             fmi3Boolean *early_return, fmi3Float64 *last_time)
{
    fmi2Status status = FMI2_NAME(fmi2DoStep)(component, time, step, no_set_state_before ? fmi2True : fmi2False);
    Instance *instance = (Instance *)component;
    if (instance != NULL && event != NULL) {
        *event = status == fmi2OK && instance->event_mode && axcomp_cycle_begins(instance);
    }
    if (terminate != NULL) {
        *terminate = false;
    }
    if (early_return != NULL) {
        *early_return = false;
    }
    if (instance != NULL && last_time != NULL) {
        *last_time = instance->memory.time;
    }
    return (fmi3Status)status;
}

/* ---- States ---- */

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3GetFMUState)(fmi3Instance instance, fmi3FMUState *state)
{
    return (fmi3Status)FMI2_NAME(fmi2GetFMUstate)(instance, state);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3SetFMUState)(fmi3Instance instance, fmi3FMUState state)
{
    return (fmi3Status)FMI2_NAME(fmi2SetFMUstate)(instance, state);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3FreeFMUState)(fmi3Instance instance, fmi3FMUState *state)
{
    return (fmi3Status)FMI2_NAME(fmi2FreeFMUstate)(instance, state);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3SerializedFMUStateSize)(fmi3Instance instance, fmi3FMUState state, size_t *size)
{
    return (fmi3Status)FMI2_NAME(fmi2SerializedFMUstateSize)(instance, state, size);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3SerializeFMUState)(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                                        size_t size)
{
    return (fmi3Status)FMI2_NAME(fmi2SerializeFMUstate)(instance, state, (fmi2Byte *)bytes, size);
}

FMI3_EXPORT fmi3Status FMI3_NAME(fmi3DeserializeFMUState)(fmi3Instance instance, const fmi3Byte bytes[], size_t size,
                                                          fmi3FMUState *state)
{
    return (fmi3Status)FMI2_NAME(fmi2DeSerializeFMUstate)(instance, (const fmi2Byte *)bytes, size, state);
}
