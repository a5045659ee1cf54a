/* The functions of FMI 2.0 for co-simulation that create instances and take them through their phases. Each first looks
 * whether it may be called now, and with what. Values are in values.c, states in states.c. */
#include <math.h>
#include <string.h>

#include "fmi2.h"
#include "instance.h"
#include "layout.h"

/* ---- What is the same for all FMUs ---- */

FMI2_EXPORT const char *FMI2_NAME(fmi2GetTypesPlatform)(void)
{
    return fmi2TypesPlatform;
}

FMI2_EXPORT const char *FMI2_NAME(fmi2GetVersion)(void)
{
    return fmi2Version;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetDebugLogging)(fmi2Component component, fmi2Boolean on, size_t count,
                                                      const fmi2String categories[])
{
    Instance *instance = (Instance *)component;
    if (count > 0) {
        instance = axcomp_given(instance, categories, "fmi2SetDebugLogging");
    }
    if (instance == NULL) {
        return fmi2Error;
    }
    unsigned wanted = count == 0 ? ~0u : 0u;
    for (size_t i = 0; i < count; i++) {
        int known = -1;
        for (int k = 0; k < CATEGORIES; k++) {
            if (categories[i] != NULL && strcmp(categories[i], axcomp_log_categories[k]) == 0) {
                known = k;
            }
        }
        if (known < 0) {
            return axcomp_say(instance, fmi2Error, "fmi2SetDebugLogging: there is no log category %s",
                              categories[i] != NULL ? categories[i] : "NULL");
        }
        wanted |= known == CATEGORY_ALL ? ~0u : 1u << known;
    }
    axcomp_log_as_wanted(instance, on != fmi2False, wanted);
    return fmi2OK;
}

/* ---- Creation and destruction ---- */

FMI2_EXPORT fmi2Component FMI2_NAME(fmi2Instantiate)(fmi2String name, fmi2Type type, fmi2String guid,
                                                     fmi2String location, const fmi2CallbackFunctions *callbacks,
                                                     fmi2Boolean visible, fmi2Boolean logging)
{
    (void)visible;
    Instance *instance = axcomp_new_instance(name != NULL ? name : "");
    if (instance == NULL) {
        return NULL;
    }
    if (callbacks != NULL) {
        instance->callbacks = *callbacks;
    }
    axcomp_log_as_wanted(instance, logging != fmi2False, ~0u);
    if (type != fmi2CoSimulation) {
        axcomp_say(instance, fmi2Error, "fmi2Instantiate: this is an FMU for co-simulation");
        axcomp_free_instance(instance);
        return NULL;
    }
    return axcomp_begin_instance(instance, name, guid, location);
}

Instance *axcomp_begin_instance(Instance *instance, const char *name, const char *guid, const char *location)
{
    int usable = 0;
    if (name == NULL || name[0] == 0) {
        axcomp_say(instance, fmi2Error, "fmi2Instantiate: the instance has no name");
    } else if (guid == NULL) {
        axcomp_say(instance, fmi2Error, "fmi2Instantiate: there is no guid");
    } else {
        instance->first = axcomp_own_lists(instance, location);
        usable = instance->first != NULL && strcmp(guid, instance->first->guid) == 0;
        if (!usable && instance->first != NULL) {
            axcomp_say(instance, fmi2Error, "fmi2Instantiate: the guid is %s, but the tables belong to %s", guid,
                       instance->first->guid);
        }
    }
    if (usable) {
        axcomp_shape_of(&instance->first->tables, &instance->shape);
        usable = axcomp_give_arrays(instance);
        if (!usable) {
            axcomp_say(instance, fmi2Error, "fmi2Instantiate: there is no memory for the instance");
        }
    }
    if (!usable) {
        axcomp_free_instance(instance);
        return NULL;
    }
    axcomp_begin_again(instance);
    return instance;
}

FMI2_EXPORT void FMI2_NAME(fmi2FreeInstance)(fmi2Component component)
{
    if (component != NULL) {
        axcomp_free_instance((Instance *)component);
    }
}

/* ---- Phases ---- */

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetupExperiment)(fmi2Component component, fmi2Boolean tolerance_defined,
                                                      fmi2Real tolerance, fmi2Real start, fmi2Boolean stop_defined,
                                                      fmi2Real stop)
{
    (void)tolerance_defined;
    (void)tolerance;
    Instance *instance = axcomp_allowed(component, INSTANTIATED, "fmi2SetupExperiment");
    if (instance == NULL) {
        return fmi2Error;
    }
    if (!isfinite(start) || (stop_defined && !(stop >= start))) {
        return axcomp_say(instance, fmi2Error, "fmi2SetupExperiment: start and stop time do not fit");
    }
    instance->memory.start_time = start;
    instance->memory.stop_time = stop_defined ? stop : HUGE_VAL;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2EnterInitializationMode)(fmi2Component component)
{
    Instance *instance = axcomp_allowed(component, INSTANTIATED, "fmi2EnterInitializationMode");
    if (instance == NULL) {
        return fmi2Error;
    }
    instance->memory.phase = INITIALIZATION;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2ExitInitializationMode)(fmi2Component component)
{
    Instance *instance = axcomp_allowed(component, INITIALIZATION, "fmi2ExitInitializationMode");
    if (instance == NULL) {
        return fmi2Error;
    }
    axcomp_preview_outputs(instance);
    instance->memory.phase = STEPPING;
    instance->memory.time = instance->memory.start_time;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2Terminate)(fmi2Component component)
{
    Instance *instance = axcomp_allowed(component, STEPPING, "fmi2Terminate");
    if (instance == NULL) {
        return fmi2Error;
    }
    instance->memory.phase = TERMINATED;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2Reset)(fmi2Component component)
{
    Instance *instance = (Instance *)component;
    if (instance == NULL) {
        return fmi2Error;
    }
    axcomp_begin_again(instance);
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2DoStep)(fmi2Component component, fmi2Real time, fmi2Real step,
                                             fmi2Boolean no_set_state_before)
{
    (void)no_set_state_before;
    Instance *instance = axcomp_allowed(component, STEPPING, "fmi2DoStep");
    if (instance == NULL) {
        return fmi2Error;
    }
    if (!isfinite(time) || !isfinite(step) || step < 0.0) {
        return axcomp_say(instance, fmi2Error,
                          "fmi2DoStep: time and step size must be finite, and the step not negative");
    }
    const Memory *memory = &instance->memory;
    double tolerance = AXCOMP_ON_INSTANT * instance->tables.cycle_time; /* hosts add up their steps */
    if (time < memory->time - tolerance) {
        return axcomp_say(instance, fmi2Error, "fmi2DoStep: a step from %g s would go back, the last one ended at %g s",
                          time, memory->time);
    }
    if (time + step > memory->stop_time + tolerance) {
        return axcomp_say(instance, fmi2Error, "fmi2DoStep: a step to %g s goes beyond the stop time, %g s",
                          time + step, memory->stop_time);
    }
    return axcomp_advance(instance, time, time + step);
}

/* ---- What this FMU does not have ---- */

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetDirectionalDerivative)(fmi2Component component,
                                                               const fmi2ValueReference unknowns[], size_t unknown_count,
                                                               const fmi2ValueReference knowns[], size_t known_count,
                                                               const fmi2Real seed[], fmi2Real sensitivity[])
{
    (void)unknowns, (void)unknown_count, (void)knowns, (void)known_count, (void)seed, (void)sensitivity;
    Instance *instance = (Instance *)component;
    return instance == NULL ? fmi2Error : axcomp_say(instance, fmi2Error, "this FMU has no directional derivatives");
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetRealOutputDerivatives)(fmi2Component component,
                                                               const fmi2ValueReference references[], size_t count,
                                                               const fmi2Integer orders[], fmi2Real values[])
{
    (void)references, (void)orders, (void)values;
    Instance *instance = (Instance *)component;
    return instance == NULL ? fmi2Error
        : count == 0        ? fmi2OK
                            : axcomp_say(instance, fmi2Error, "this FMU has no derivatives of outputs");
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2CancelStep)(fmi2Component component)
{
    Instance *instance = (Instance *)component;
    return instance == NULL ? fmi2Error : axcomp_say(instance, fmi2Error, "fmi2CancelStep: no step is ever pending");
}

/* All steps are finished when fmi2DoStep returns: there is no status to ask for. */
#define STATUS(NAME, TYPE)                                                                                             \
    FMI2_EXPORT fmi2Status FMI2_NAME(NAME)(fmi2Component component, const fmi2StatusKind kind, TYPE *value)            \
    {                                                                                                                  \
        (void)kind;                                                                                                    \
        (void)value;                                                                                                   \
        return component == NULL ? fmi2Error : fmi2Discard;                                                            \
    }

STATUS(fmi2GetStatus, fmi2Status)
STATUS(fmi2GetRealStatus, fmi2Real)
STATUS(fmi2GetIntegerStatus, fmi2Integer)
STATUS(fmi2GetBooleanStatus, fmi2Boolean)
STATUS(fmi2GetStringStatus, fmi2String)
