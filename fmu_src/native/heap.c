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

Lists *axcomp_copy_lists(Instance *instance)
{
    const Lists *from = instance->lists;
    const Tables *tables = &from->tables;
    size_t axes = (size_t)tables->axis_count, volumetrics = (size_t)tables->volumetrics, numbers = (size_t)from->numbers;
    axcomp_forget_lists(instance);
    Lists *lists = (Lists *)malloc(sizeof *lists);
    if (lists == NULL) {
        return NULL;
    }
    *lists = *from;
    lists->tuned = true;
    lists->saved = false;
    lists->users = 0;
    lists->held = 0;
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
