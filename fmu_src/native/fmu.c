/* The functions of FMI 2.0 for co-simulation. Each first looks whether it may be called now, and with what. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2.h"
#include "instance.h"
#include "places.h"

enum {
    WITH_INPUTS = INSTANTIATED | INITIALIZATION | STEPPING,
    WITH_VALUES = INITIALIZATION | STEPPING | TERMINATED
};

static const char STATE_MAGIC[8] = {'A', 'X', 'C', 'O', 'M', 'P', 'F', '1'};

/* A state of the FMU: a copy of everything that changes. It refers to the lists by their identity, so that it outlives
 * the instance and fits another one; its bytes are the serialized state. */
typedef struct {
    char magic[8];
    uint32_t check;    /* CRC-32 of everything behind it, in serialized states */
    uint32_t layout;
    uint32_t size;     /* of the memory */
    uint32_t lists;    /* identity of the lists in force */
    uint32_t waiting;  /* and of those that wait */
    uint32_t waits;    /* whether some do */
    Memory memory;
} Saved;

/* The instance, if this call is allowed in its phase; else NULL, after telling the host. */
static Instance *allowed(fmi2Component component, unsigned phases, const char *function)
{
    Instance *instance = (Instance *)component;
    if (instance == NULL) {
        return NULL;
    }
    if ((instance->memory.phase & phases) == 0) {
        axcomp_say(instance, fmi2Error, "%s must not be called now", function);
        return NULL;
    }
    return instance;
}

/* The instance, if a pointer that this call needs is there; else NULL, after telling the host. */
static Instance *given(Instance *instance, const void *pointer, const char *function)
{
    if (instance != NULL && pointer == NULL) {
        axcomp_say(instance, fmi2Error, "%s: an argument is NULL", function);
        return NULL;
    }
    return instance;
}

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
        instance = given(instance, categories, "fmi2SetDebugLogging");
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
    instance->logging = on != fmi2False;
    instance->categories = wanted;
    return fmi2OK;
}

/* ---- Creation and destruction ---- */

/* Read the tables that belong to this FMU; NULL after telling the host why that does not work. */
static Lists *read_own_lists(Instance *instance, fmi2String location)
{
#if defined(AXCOMP_EMBEDDED)
    (void)location;
#else
    static const char FILE_NAME[] = "tables.bin";
    int known = location != NULL && location[0] != 0 ? axcomp_path_of(location, FILE_NAME, instance->own_path)
                                                     : axcomp_path_beside_library(FILE_NAME, instance->own_path);
    if (!known) {
        axcomp_say(instance, fmi2Error, "fmi2Instantiate: there is no resource location, or it is too long");
        return NULL;
    }
#endif
    return axcomp_read_lists(instance, fmi2Error, "fmi2Instantiate", instance->own_path);
}

FMI2_EXPORT fmi2Component FMI2_NAME(fmi2Instantiate)(fmi2String name, fmi2Type type, fmi2String guid,
                                                     fmi2String location, const fmi2CallbackFunctions *callbacks,
                                                     fmi2Boolean visible, fmi2Boolean logging)
{
    (void)visible;
    Instance *instance = (Instance *)calloc(1, sizeof *instance);
    if (instance == NULL) {
        return NULL;
    }
    if (callbacks != NULL) {
        instance->callbacks = *callbacks;
    }
    instance->logging = logging != fmi2False;
    instance->categories = ~0u;
    const char *known = name != NULL ? name : "";
    instance->name = (char *)malloc(strlen(known) + 1);
    if (instance->name == NULL) {
        axcomp_free_instance(instance);
        return NULL;
    }
    memcpy(instance->name, known, strlen(known) + 1);

    int usable = 0;
    if (known[0] == 0) {
        axcomp_say(instance, fmi2Error, "fmi2Instantiate: the instance has no name");
    } else if (type != fmi2CoSimulation) {
        axcomp_say(instance, fmi2Error, "fmi2Instantiate: this is an FMU for co-simulation");
    } else if (guid == NULL) {
        axcomp_say(instance, fmi2Error, "fmi2Instantiate: there is no guid");
    } else {
        instance->first = read_own_lists(instance, location);
        usable = instance->first != NULL && strcmp(guid, instance->first->guid) == 0;
        if (!usable && instance->first != NULL) {
            axcomp_say(instance, fmi2Error, "fmi2Instantiate: the guid is %s, but the tables belong to %s", guid,
                       instance->first->guid);
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
    Instance *instance = allowed(component, INSTANTIATED, "fmi2SetupExperiment");
    if (instance == NULL) {
        return fmi2Error;
    }
    if (!isfinite(start) || (stop_defined && !(stop >= start))) {
        return axcomp_say(instance, fmi2Error, "fmi2SetupExperiment: start and stop time do not fit");
    }
    instance->memory.start_time = start;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2EnterInitializationMode)(fmi2Component component)
{
    Instance *instance = allowed(component, INSTANTIATED, "fmi2EnterInitializationMode");
    if (instance == NULL) {
        return fmi2Error;
    }
    instance->memory.phase = INITIALIZATION;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2ExitInitializationMode)(fmi2Component component)
{
    Instance *instance = allowed(component, INITIALIZATION, "fmi2ExitInitializationMode");
    if (instance == NULL) {
        return fmi2Error;
    }
    axcomp_preview_outputs(instance);
    instance->memory.phase = STEPPING;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2Terminate)(fmi2Component component)
{
    Instance *instance = allowed(component, STEPPING, "fmi2Terminate");
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
    Instance *instance = allowed(component, STEPPING, "fmi2DoStep");
    if (instance == NULL) {
        return fmi2Error;
    }
    if (!isfinite(time) || !isfinite(step) || step < 0.0) {
        return axcomp_say(instance, fmi2Error,
                          "fmi2DoStep: time and step size must be finite, and the step not negative");
    }
    return axcomp_advance(instance, time + step);
}

/* ---- Values ---- */

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
    if (record == NULL || (*place)->type != type) {
        axcomp_say(instance, fmi2Error, "there is no variable of this type with the value reference %u", reference);
        return NULL;
    }
    return (char *)record + (*place)->offset;
}

/* The instance, if values may be read now; during initialization the outputs are computed first. */
static Instance *readable(fmi2Component component, const void *references, const void *values, size_t count)
{
    Instance *instance = allowed(component, WITH_VALUES, "fmi2Get...");
    if (count > 0) {
        instance = given(given(instance, references, "fmi2Get..."), values, "fmi2Get...");
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
    Instance *instance = allowed(component, WITH_INPUTS, "fmi2Set...");
    return count == 0 ? instance : given(given(instance, references, "fmi2Set..."), values, "fmi2Set...");
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
        const double *value = (const double *)place_of(instance, references[i], 'r', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        values[i] = *value;
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
    const Place *place;
    for (size_t i = 0; i < count; i++) {
        double *value = (double *)settable(instance, references[i], 'r', &place);
        if (value == NULL) {
            return fmi2Error;
        }
        if (place->causality == 'p' && !axcomp_cycle_time_fits(values[i])) {
            return axcomp_say(instance, fmi2Error, "cycle_time must be above 0 s and below 1000 s, not %g", values[i]);
        }
        *value = values[i];
    }
    return fmi2OK;
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

/* ---- States ---- */

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetFMUstate)(fmi2Component component, fmi2FMUstate *state)
{
    Instance *instance = given((Instance *)component, state, "fmi2GetFMUstate");
    if (instance == NULL) {
        return fmi2Error;
    }
    if (*state == NULL) {
        *state = calloc(1, sizeof(Saved));
    }
    Saved *saved = (Saved *)*state;
    if (saved == NULL) {
        return axcomp_say(instance, fmi2Error, "fmi2GetFMUstate: there is no memory for the state");
    }
    memcpy(saved->magic, STATE_MAGIC, sizeof saved->magic);
    saved->layout = AXCOMP_LAYOUT;
    saved->size = (uint32_t)sizeof saved->memory;
    saved->lists = instance->lists->identity;
    saved->waits = instance->waiting != NULL;
    saved->waiting = instance->waiting != NULL ? instance->waiting->identity : 0;
    saved->check = 0;
    memcpy(&saved->memory, &instance->memory, sizeof saved->memory);
    return fmi2OK;
}

/* Whether this is a state that this version has made. */
static bool is_state(const Saved *saved)
{
    return memcmp(saved->magic, STATE_MAGIC, sizeof saved->magic) == 0 && saved->layout == AXCOMP_LAYOUT
        && saved->size == sizeof saved->memory;
}

static uint32_t check_of(const Saved *saved)
{
    return axcomp_crc32(0, (const char *)saved + offsetof(Saved, layout), sizeof *saved - offsetof(Saved, layout));
}

/* Whether the instance has the lists of a state. */
static bool has_lists(const Instance *instance, const Saved *saved)
{
    return axcomp_lists_with(instance, saved->lists) != NULL
        && (saved->waits == 0 || axcomp_lists_with(instance, saved->waiting) != NULL);
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetFMUstate)(fmi2Component component, fmi2FMUstate state)
{
    Instance *instance = given((Instance *)component, state, "fmi2SetFMUstate");
    const Saved *saved = (const Saved *)state;
    if (instance == NULL) {
        return fmi2Error;
    }
    if (!is_state(saved)) {
        return axcomp_say(instance, fmi2Error, "fmi2SetFMUstate: the state is of another version");
    }
    if (!has_lists(instance, saved)) {
        return axcomp_say(instance, fmi2Error, "fmi2SetFMUstate: the state belongs to other lists");
    }
    memcpy(&instance->memory, &saved->memory, sizeof instance->memory);
    instance->lists = axcomp_lists_with(instance, saved->lists);
    instance->waiting = saved->waits != 0 ? axcomp_lists_with(instance, saved->waiting) : NULL;
    instance->lists->tables.cycle_time = instance->memory.controls.cycle_time;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2FreeFMUstate)(fmi2Component component, fmi2FMUstate *state)
{
    if (component == NULL) {
        return fmi2Error;
    }
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SerializedFMUstateSize)(fmi2Component component, fmi2FMUstate state, size_t *size)
{
    Instance *instance = given((Instance *)component, state, "fmi2SerializedFMUstateSize");
    if (given(instance, size, "fmi2SerializedFMUstateSize") == NULL) {
        return fmi2Error;
    }
    *size = sizeof(Saved);
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SerializeFMUstate)(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[],
                                                        size_t size)
{
    Instance *instance = given((Instance *)component, state, "fmi2SerializeFMUstate");
    if (given(instance, bytes, "fmi2SerializeFMUstate") == NULL) {
        return fmi2Error;
    }
    if (size < sizeof(Saved)) {
        return axcomp_say(instance, fmi2Error, "fmi2SerializeFMUstate: the state has more bytes");
    }
    const Saved *saved = (const Saved *)state;
    uint32_t check = check_of(saved);
    memcpy(bytes, saved, sizeof *saved);
    memcpy(bytes + offsetof(Saved, check), &check, sizeof check);
    return fmi2OK;
}

/* What is wrong with the bytes of a state, NULL: nothing. */
static const char *complaint_about(const Instance *instance, const Saved *saved)
{
    if (!is_state(saved)) {
        return "the state is of another version";
    }
    if (check_of(saved) != saved->check) {
        return "the state has been altered";
    }
    return has_lists(instance, saved) ? NULL : "the state belongs to other lists";
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2DeSerializeFMUstate)(fmi2Component component, const fmi2Byte bytes[], size_t size,
                                                          fmi2FMUstate *state)
{
    Instance *instance = given((Instance *)component, bytes, "fmi2DeSerializeFMUstate");
    if (given(instance, state, "fmi2DeSerializeFMUstate") == NULL) {
        return fmi2Error;
    }
    if (size != sizeof(Saved)) {
        return axcomp_say(instance, fmi2Error, "fmi2DeSerializeFMUstate: the state is truncated, or none of this FMU");
    }
    Saved *saved = (Saved *)malloc(sizeof *saved);
    if (saved == NULL) {
        return axcomp_say(instance, fmi2Error, "fmi2DeSerializeFMUstate: there is no memory for the state");
    }
    memcpy(saved, bytes, sizeof *saved);
    const char *complaint = complaint_about(instance, saved);
    if (complaint != NULL) {
        free(saved);
        return axcomp_say(instance, fmi2Error, "fmi2DeSerializeFMUstate: %s", complaint);
    }
    *state = saved;
    return fmi2OK;
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

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetRealInputDerivatives)(fmi2Component component,
                                                              const fmi2ValueReference references[], size_t count,
                                                              const fmi2Integer orders[], const fmi2Real values[])
{
    (void)references, (void)orders, (void)values;
    Instance *instance = (Instance *)component;
    return instance == NULL ? fmi2Error
        : count == 0        ? fmi2OK
                            : axcomp_say(instance, fmi2Error, "this FMU does not interpolate its inputs");
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
