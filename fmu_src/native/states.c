/* The functions of FMI 2.0 that save states of the FMU, here and in bytes, and go back to them. */
#include <stddef.h>
#include <string.h>

#include "fmi2.h"
#include "instance.h"
#include "layout.h"

static const char STATE_MAGIC[8] = {'A', 'X', 'C', 'O', 'M', 'P', 'F', '2'};

/* A state of the FMU: everything that changes, and behind it, at a multiple of 8 bytes from the begin, the arrays. It
 * refers to the lists by their identity, so that it outlives the instance and fits another one; its bytes, in which
 * pointers are 0, are the serialized state. Of the path in it there is only what is used. */
typedef struct {
    char magic[8];
    uint32_t check;    /* CRC-32 of everything behind it, in serialized states */
    uint32_t layout;
    uint32_t size;     /* of all of it */
    uint32_t lists;    /* identity of the lists in force */
    uint32_t waiting;  /* and of those that wait */
    uint32_t waits;    /* whether some do */
    Memory memory;
} Saved;

enum { CHECKED = offsetof(Saved, layout), PATH = offsetof(Saved, memory) + offsetof(Memory, controls.update_path) };

/* Where the arrays begin in a state whose path has so many bytes with its end. */
static size_t arrays_at(size_t path)
{
    size_t begin = PATH + path;
    return (begin + sizeof(double) - 1u) / sizeof(double) * sizeof(double);
}

static size_t size_of(size_t path, const Shape *shape)
{
    return arrays_at(path) + axcomp_state_size(shape) + 2u * axcomp_inputs_size(shape) + axcomp_outputs_size(shape);
}

/* Bytes of the path in a state of so many bytes, with its end; 0: it has none. */
static size_t path_size(const char *state, size_t size)
{
    for (size_t length = 0; length < PATH_LENGTH && PATH + length < size; length++) {
        if (state[PATH + length] == 0) {
            return length + 1u;
        }
    }
    return 0;
}

/* Let records point to the arrays of a state. */
static void place(char *arrays, const Shape *shape, Memory *memory)
{
    size_t state = axcomp_state_size(shape), inputs = axcomp_inputs_size(shape);
    axcomp_place_state(&memory->state, arrays, shape);
    axcomp_place_inputs(&memory->inputs, arrays + state, shape);
    axcomp_place_inputs(&memory->slopes, arrays + state + inputs, shape);
    axcomp_place_outputs(&memory->outputs, arrays + state + 2u * inputs, shape);
}

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
    const Memory *memory = &instance->memory;
    const Lists *waiting = axcomp_waiting_lists(instance);
    Shape shape;
    axcomp_shape_of(&instance->tables, &shape);
    size_t path = strlen(memory->controls.update_path) + 1u;
    size_t size = size_of(path, &shape);
    Saved *saved = (Saved *)*state;
    if (saved != NULL) {
        hold_lists_of(instance, saved, -1);
        if (saved->size != size) {
            axcomp_free_state(saved);
            saved = NULL;
        }
    }
    if (saved == NULL) {
        saved = (Saved *)axcomp_new_state(size > sizeof *saved ? size : sizeof *saved);
    }
    *state = saved;
    if (saved == NULL) {
        return axcomp_say(instance, fmi2Error, "fmi2GetFMUstate: there is no memory for the state");
    }
    memcpy(saved->magic, STATE_MAGIC, sizeof saved->magic);
    saved->layout = AXCOMP_LAYOUT;
    saved->size = (uint32_t)size;
    saved->lists = instance->lists->identity;
    if (instance->lists->tuned) {
        ((Lists *)instance->lists)->saved = true; /* it is this instance's own */
    }
    saved->waits = waiting != NULL;
    saved->waiting = waiting != NULL ? waiting->identity : 0;
    hold_lists_of(instance, saved, 1);
    saved->check = 0;
    memcpy((char *)saved + offsetof(Saved, memory), memory, PATH - offsetof(Saved, memory) + path);
    Memory *to = &saved->memory;
    place((char *)saved + arrays_at(path), &shape, to);
    axcomp_copy_arrays(to, memory, &shape);
    return fmi2OK;
}

/* Whether this is a state that this version has made. */
static bool is_state(const Saved *saved)
{
    return memcmp(saved->magic, STATE_MAGIC, sizeof saved->magic) == 0 && saved->layout == AXCOMP_LAYOUT;
}

/* The shape of the arrays of a state; false: it belongs to other lists. */
static bool shape_of(const Instance *instance, const Saved *saved, Shape *shape)
{
    const Lists *lists = axcomp_lists_with(instance, saved->lists);
    if (lists == NULL || (saved->waits != 0 && axcomp_lists_with(instance, saved->waiting) == NULL)) {
        return false;
    }
    axcomp_shape_of(&lists->tables, shape);
    return true;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetFMUstate)(fmi2Component component, fmi2FMUstate state)
{
    Instance *instance = axcomp_given((Instance *)component, state, "fmi2SetFMUstate");
    const Saved *saved = (const Saved *)state;
    Shape shape;
    if (instance == NULL) {
        return fmi2Error;
    }
    if (!is_state(saved)) {
        return axcomp_say(instance, fmi2Error, "fmi2SetFMUstate: the state is of another version");
    }
    if (!shape_of(instance, saved, &shape)) {
        return axcomp_say(instance, fmi2Error, "fmi2SetFMUstate: the state belongs to other lists");
    }
    if (!axcomp_memory_fits(axcomp_lists_with(instance, saved->lists), &saved->memory)) {
        return axcomp_say(instance, fmi2Error, "fmi2SetFMUstate: the state has numbers that no run leads to");
    }
    if (!axcomp_wait_for(instance, saved->waits != 0 ? axcomp_lists_with(instance, saved->waiting) : NULL)) {
        return axcomp_say(instance, fmi2Error, "fmi2SetFMUstate: there is no memory for the lists that wait");
    }
    Memory *memory = &instance->memory;
    const Memory *from = &saved->memory;
    memcpy((char *)memory, from, PATH - offsetof(Saved, memory) + path_size((const char *)saved, saved->size));
    axcomp_place_arrays(instance);
    axcomp_copy_arrays(memory, from, &shape);
    axcomp_use_lists(instance, axcomp_lists_with(instance, saved->lists));
    instance->stale = true;
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2FreeFMUstate)(fmi2Component component, fmi2FMUstate *state)
{
    if (component == NULL) {
        return fmi2Error;
    }
    if (state != NULL && *state != NULL) {
        hold_lists_of((Instance *)component, (const Saved *)*state, -1);
        axcomp_free_state(*state);
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
    *size = ((const Saved *)state)->size;
    return fmi2OK;
}

/* Put 0 in the place of a pointer. */
static void forget(fmi2Byte *bytes, size_t at)
{
    memset(bytes + at, 0, sizeof(void *));
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SerializeFMUstate)(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[],
                                                        size_t size)
{
    Instance *instance = axcomp_given((Instance *)component, state, "fmi2SerializeFMUstate");
    if (axcomp_given(instance, bytes, "fmi2SerializeFMUstate") == NULL) {
        return fmi2Error;
    }
    const Saved *saved = (const Saved *)state;
    if (size < saved->size) {
        return axcomp_say(instance, fmi2Error, "fmi2SerializeFMUstate: the state has more bytes");
    }
    memcpy(bytes, saved, saved->size);
    size_t memory = offsetof(Saved, memory);
    forget(bytes, memory + offsetof(Memory, state.motion.axis));
    forget(bytes, memory + offsetof(Memory, state.axis));
    forget(bytes, memory + offsetof(Memory, state.volumetric));
    forget(bytes, memory + offsetof(Memory, inputs.axis));
    forget(bytes, memory + offsetof(Memory, inputs.volumetric));
    forget(bytes, memory + offsetof(Memory, slopes.axis));
    forget(bytes, memory + offsetof(Memory, slopes.volumetric));
    forget(bytes, memory + offsetof(Memory, outputs.axis));
    forget(bytes, memory + offsetof(Memory, outputs.volumetric));
    size_t axes = (size_t)((const char *)saved->memory.state.axis - (const char *)saved);
    for (size_t i = 0; i < (size_t)instance->shape.axes; i++) {
        forget(bytes, axes + i * sizeof(AxisState) + offsetof(AxisState, compensation.friction.line));
    }
    uint32_t check = axcomp_crc32(0, bytes + CHECKED, saved->size - CHECKED);
    memcpy(bytes + offsetof(Saved, check), &check, sizeof check);
    return fmi2OK;
}

FMI2_EXPORT fmi2Status FMI2_NAME(fmi2DeSerializeFMUstate)(fmi2Component component, const fmi2Byte bytes[], size_t size,
                                                          fmi2FMUstate *state)
{
    Instance *instance = axcomp_given((Instance *)component, bytes, "fmi2DeSerializeFMUstate");
    if (axcomp_given(instance, state, "fmi2DeSerializeFMUstate") == NULL) {
        return fmi2Error;
    }
    if (size <= PATH) {
        return axcomp_say(instance, fmi2Error, "fmi2DeSerializeFMUstate: the state is truncated, or none of this FMU");
    }
    Saved *saved = (Saved *)axcomp_new_state(size > sizeof *saved ? size : sizeof *saved);
    if (saved == NULL) {
        return axcomp_say(instance, fmi2Error, "fmi2DeSerializeFMUstate: there is no memory for the state");
    }
    memcpy(saved, bytes, size);
    Shape shape;
    size_t path = path_size((const char *)saved, size);
    const char *complaint = NULL;
    if (!is_state(saved)) {
        complaint = "the state is of another version";
    } else if (saved->size != size) {
        complaint = "the state is truncated, or none of this FMU";
    } else if (axcomp_crc32(0, bytes + CHECKED, size - CHECKED) != saved->check) {
        complaint = "the state has been altered";
    } else if (!shape_of(instance, saved, &shape)) {
        complaint = "the state belongs to other lists";
    } else if (path == 0 || size != size_of(path, &shape)) {
        complaint = "the state is truncated, or none of this FMU";
    } else {
        place((char *)saved + arrays_at(path), &shape, &saved->memory);
        if (!axcomp_memory_fits(axcomp_lists_with(instance, saved->lists), &saved->memory)) {
            complaint = "the state has numbers that no run leads to";
        }
    }
    if (complaint != NULL) {
        axcomp_free_state(saved);
        return axcomp_say(instance, fmi2Error, "fmi2DeSerializeFMUstate: %s", complaint);
    }
    hold_lists_of(instance, saved, 1);
    *state = saved;
    return fmi2OK;
}
