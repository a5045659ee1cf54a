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

void *axcomp_new_state(size_t size)
{
    return calloc(1, size);
}

void axcomp_free_state(void *state)
{
    free(state);
}

#endif
