/* Where instances and saved states of the library get their memory. */
#include <stdlib.h>
#include <string.h>

#include "instance.h"
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
