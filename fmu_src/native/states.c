/* The functions of FMI 2.0 that save states of the FMU, here and in bytes, and go back to them. */
#include <stdlib.h>
#include <string.h>

#include "fmi2.h"
#include "instance.h"
#include "layout.h"

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

/* Note that a state refers to its lists (`by` 1), or no longer does (-1); a new one has none. */
static void hold_lists_of(Instance *instance, const Saved *saved, int by)
{
    if (saved->size != 0) {
        axcomp_hold_lists(instance, saved->lists, by);
        if (saved->waits != 0) {
            axcomp_hold_lists(instance, saved->waiting, by);
        }
    }
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetFMUstate)(fmi2Component component, fmi2FMUstate *state)
{
    Instance *instance = axcomp_given((Instance *)component, state, "fmi2GetFMUstate");
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
    hold_lists_of(instance, saved, -1);
    saved->layout = AXCOMP_LAYOUT;
    saved->size = (uint32_t)sizeof saved->memory;
    saved->lists = instance->lists->identity;
    saved->waits = instance->waiting != NULL;
    saved->waiting = instance->waiting != NULL ? instance->waiting->identity : 0;
    hold_lists_of(instance, saved, 1);
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
    Instance *instance = axcomp_given((Instance *)component, state, "fmi2SetFMUstate");
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
    if (!axcomp_memory_fits(axcomp_lists_with(instance, saved->lists), &saved->memory)) {
        return axcomp_say(instance, fmi2Error, "fmi2SetFMUstate: the state has numbers that no run leads to");
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
    if (state != NULL && *state != NULL) {
        hold_lists_of((Instance *)component, (const Saved *)*state, -1);
        free(*state);
        *state = NULL;
    }
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SerializedFMUstateSize)(fmi2Component component, fmi2FMUstate state, size_t *size)
{
    Instance *instance = axcomp_given((Instance *)component, state, "fmi2SerializedFMUstateSize");
    if (axcomp_given(instance, size, "fmi2SerializedFMUstateSize") == NULL) {
        return fmi2Error;
    }
    *size = sizeof(Saved);
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SerializeFMUstate)(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[],
                                                        size_t size)
{
    Instance *instance = axcomp_given((Instance *)component, state, "fmi2SerializeFMUstate");
    if (axcomp_given(instance, bytes, "fmi2SerializeFMUstate") == NULL) {
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
    const Lists *lists = has_lists(instance, saved) ? axcomp_lists_with(instance, saved->lists) : NULL;
    if (lists == NULL) {
        return "the state belongs to other lists";
    }
    return axcomp_memory_fits(lists, &saved->memory) ? NULL : "the state has numbers that no run leads to";
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2DeSerializeFMUstate)(fmi2Component component, const fmi2Byte bytes[], size_t size,
                                                          fmi2FMUstate *state)
{
    Instance *instance = axcomp_given((Instance *)component, bytes, "fmi2DeSerializeFMUstate");
    if (axcomp_given(instance, state, "fmi2DeSerializeFMUstate") == NULL) {
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
    hold_lists_of(instance, saved, 1);
    *state = saved;
    return fmi2OK;
}
