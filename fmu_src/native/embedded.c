/* What only the sources in an FMU have: the tables stand among them (tables.c), instances and saved states in arrays; there
 * is no log, and there are no other lists than these. */
#include <string.h>

#include "instance.h"

#ifndef AXCOMP_INSTANCES
#define AXCOMP_INSTANCES 4 /* that there can be at a time */
#endif
#ifndef AXCOMP_STATES
#define AXCOMP_STATES 4 /* that can be saved at a time */
#endif

/* Bytes of the arrays, of which the state's are there twice, the inputs' three times; as in memory.c. */
#define STATE_SIZE                                                                                                     \
    (AXCOMP_AXES * (sizeof(AxisMotion) + sizeof(AxisState)) + AXCOMP_VOLUMETRICS * sizeof(VolumetricState)              \
     + AXCOMP_LINES * sizeof(double))
#define OTHER_SIZE                                                                                                     \
    (AXCOMP_AXES * (3u * sizeof(AxisInputs) + sizeof(AxisOutputs))                                                     \
     + AXCOMP_VOLUMETRICS * (3u * sizeof(VolumetricInputs) + sizeof(VolumetricOutputs)) + sizeof(double))

/* Numbers of the largest alignment that is needed. */
enum {
    BLOCK_NUMBERS = (2u * STATE_SIZE + OTHER_SIZE) / sizeof(double) + 1u,
    STATE_NUMBERS = (64u + sizeof(Memory) + STATE_SIZE + OTHER_SIZE) / sizeof(double) + 2u
};

static Instance instances[AXCOMP_INSTANCES];
static double blocks[AXCOMP_INSTANCES][BLOCK_NUMBERS];
static double states[AXCOMP_STATES][STATE_NUMBERS];
static bool state_used[AXCOMP_STATES];

Instance *axcomp_new_instance(const char *name)
{
    (void)name;
    for (int k = 0; k < AXCOMP_INSTANCES; k++) {
        if (instances[k].block == NULL) {
            instances[k].block = blocks[k];
            return &instances[k];
        }
    }
    return NULL;
}

bool axcomp_give_arrays(Instance *instance)
{
    axcomp_place_arrays(instance);
    return true;
}

void axcomp_free_instance(Instance *instance)
{
    memset(instance, 0, sizeof *instance);
}

#if defined(AXCOMP_NUMBERS)
/* Two for each instance: those in force, and those that come into force. */
static Lists tuned[AXCOMP_INSTANCES][2];
static AxisTable tuned_axes[AXCOMP_INSTANCES][2][AXCOMP_AXES];
static double tuned_pools[AXCOMP_INSTANCES][2][AXCOMP_NUMBERS + 1];

Lists *axcomp_copy_lists(Instance *instance)
{
    size_t i = (size_t)(instance - instances);
    size_t k = instance->lists == &tuned[i][0] ? 1u : 0u;
    Lists *lists = &tuned[i][k];
    *lists = *instance->lists;
    lists->tuned = true;
    memcpy(tuned_axes[i][k], lists->tables.axis, (size_t)lists->tables.axis_count * sizeof(AxisTable));
    memcpy(tuned_pools[i][k], lists->pool, (size_t)lists->numbers * sizeof(double));
    lists->tables.axis = tuned_axes[i][k];
    lists->pool = tuned_pools[i][k];
    return lists;
}

void axcomp_drop_lists(Instance *instance, Lists *copy)
{
    (void)instance, (void)copy;
}
#endif

void *axcomp_new_state(size_t size)
{
    for (int k = 0; k < AXCOMP_STATES; k++) {
        if (!state_used[k] && size <= sizeof states[k]) {
            state_used[k] = true;
            memset(states[k], 0, sizeof states[k]);
            return states[k];
        }
    }
    return NULL;
}

void axcomp_free_state(void *state)
{
    for (int k = 0; k < AXCOMP_STATES; k++) {
        if (state == states[k]) {
            state_used[k] = false;
        }
    }
}

fmi2Status axcomp_say(const Instance *instance, fmi2Status status, const char *format, ...)
{
    (void)instance, (void)format;
    return status;
}

void axcomp_log_as_wanted(Instance *instance, bool on, unsigned categories)
{
    (void)instance, (void)on, (void)categories;
}

const Lists *axcomp_own_lists(Instance *instance, fmi2String location)
{
    (void)instance, (void)location;
    return &axcomp_tables;
}

/* An update is refused. */
void axcomp_watch_reload(Instance *instance, bool path_set)
{
    (void)path_set;
    instance->memory.refused = instance->memory.controls.reload && !instance->memory.reload_seen;
}

void axcomp_take_update(Instance *instance)
{
    Memory *memory = &instance->memory;
    for (int32_t i = 0; memory->refused && i < instance->tables.axis_count; i++) {
        memory->state.axis[i].error = memory->outputs.axis[i].error = ERROR_UPDATE;
    }
    memory->refused = false;
    memory->reload_seen = memory->controls.reload;
}

const Lists *axcomp_lists_with(const Instance *instance, uint32_t identity)
{
    return instance->first->identity == identity ? instance->first
        : instance->lists->identity == identity  ? instance->lists
                                                 : NULL;
}

void axcomp_hold_lists(Instance *instance, uint32_t identity, int by)
{
    (void)instance, (void)identity, (void)by;
}

const Lists *axcomp_waiting_lists(const Instance *instance)
{
    (void)instance;
    return NULL;
}

bool axcomp_wait_for(Instance *instance, const Lists *lists)
{
    (void)instance;
    return lists == NULL;
}
