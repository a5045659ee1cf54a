/* Where instances and saved states get their memory: from the heap, or, among other sources, from arrays. */
#include "instance.h"

#include <string.h>

#if defined(AXCOMP_EMBEDDED)

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

#else

#include <stdlib.h>

#include "lists.h"

Instance *axcomp_new_instance(const char *name)
{
    Instance *instance = (Instance *)calloc(1, sizeof *instance);
    if (instance != NULL) {
        instance->name = (char *)malloc(strlen(name) + 1);
        if (instance->name == NULL) {
            free(instance);
            return NULL;
        }
        memcpy(instance->name, name, strlen(name) + 1);
    }
    return instance;
}

bool axcomp_give_arrays(Instance *instance)
{
    const Shape *shape = &instance->shape;
    instance->block = calloc(1, axcomp_block_size(shape));
    if (instance->block != NULL) {
        axcomp_place_arrays(instance);
    }
    return instance->block != NULL;
}

void axcomp_free_instance(Instance *instance)
{
    axcomp_release_lists(instance->first);
    while (instance->own != NULL) {
        Lists *next = instance->own->next;
        axcomp_free_lists(instance->own);
        instance->own = next;
    }
    free(instance->block);
    free(instance->name);
    free(instance);
}

/* Free what was changed, is not in force any more, and no state refers to. */
static void forget_tuned(Instance *instance)
{
    for (Lists **link = &instance->own; *link != NULL;) {
        Lists *lists = *link;
        if (lists->tuned && !lists->saved && lists != instance->lists) {
            *link = lists->next;
            axcomp_free_lists(lists);
        } else {
            link = &lists->next;
        }
    }
}

Lists *axcomp_copy_lists(Instance *instance)
{
    const Lists *from = instance->lists;
    const Tables *tables = &from->tables;
    size_t axes = (size_t)tables->axis_count, volumetrics = (size_t)tables->volumetrics, numbers = (size_t)from->numbers;
    forget_tuned(instance);
    Lists *lists = (Lists *)malloc(sizeof *lists);
    if (lists == NULL) {
        return NULL;
    }
    *lists = *from;
    lists->tuned = true;
    lists->saved = false;
    lists->users = 0;
    double *pool = (double *)malloc((numbers + 1u) * sizeof *pool);
    lists->pool = pool;
    lists->tables.axis = (AxisTable *)malloc((axes + 1u) * sizeof(AxisTable));
    lists->tables.volumetric = (VolumetricTable *)malloc((volumetrics + 1u) * sizeof(VolumetricTable));
    if (pool == NULL || lists->tables.axis == NULL || lists->tables.volumetric == NULL) {
        axcomp_free_lists(lists);
        return NULL;
    }
    memcpy(pool, from->pool, numbers * sizeof *pool);
    memcpy(lists->tables.axis, tables->axis, axes * sizeof(AxisTable));
    memcpy(lists->tables.volumetric, tables->volumetric, volumetrics * sizeof(VolumetricTable));
    lists->next = instance->own;
    instance->own = lists;
    return lists;
}

void axcomp_drop_lists(Instance *instance, Lists *copy)
{
    instance->own = copy->next;
    axcomp_free_lists(copy);
}

void *axcomp_new_state(size_t size)
{
    return calloc(1, size);
}

void axcomp_free_state(void *state)
{
    free(state);
}

#endif
