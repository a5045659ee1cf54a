/* New lists while the machine runs: read when the host asks for them, taken by the next step. */
#include <stdlib.h>
#include <string.h>

#include "instance.h"
#include "lists.h"

enum { KEPT_LISTS = 8 };

static Lists *read_lists(const Instance *instance, fmi2Status status, const char *call, const char *path)
{
    const char *complaint = "there is no memory for it";
    Lists *lists = (Lists *)calloc(1, sizeof *lists);
    int rounding = axcomp_round_to_nearest();
    size_t size = 0;
    unsigned char *data = axcomp_read_file(path, &size);
    if (data == NULL) {
        axcomp_restore_rounding(rounding);
        axcomp_say(instance, status, "%s: %s cannot be read", call, path);
        axcomp_free_lists(lists);
        return NULL;
    }
    if (lists != NULL) {
        complaint = axcomp_read_image(data, size, lists);
    }
    free(data);
    axcomp_restore_rounding(rounding);
    if (complaint != NULL) {
        axcomp_say(instance, status, "%s: %s is refused: %s", call, path, complaint);
        axcomp_free_lists(lists);
        return NULL;
    }
    return lists;
}

/* Let an axis of new lists keep the tables that are in force. */
static bool keep_axis(Lists *lists, const Lists *now, int i)
{
    const AxisTable *old = &now->tables.axis[i];
    size_t count = (size_t)lists->numbers + (size_t)old->numbers;
    double *pool = (double *)realloc((void *)lists->pool, (count + 1u) * sizeof *pool);
    if (pool == NULL) {
        return false;
    }
    memcpy(pool + lists->numbers, now->pool + old->first, (size_t)old->numbers * sizeof *pool);
    lists->pool = pool;
    lists->tables.axis[i] = *old;
    axcomp_move_axis_table(&lists->tables.axis[i], lists->numbers);
    lists->numbers = (int32_t)count;
    return true;
}

/* Tell whether new lists have no volumetric compensation that was not declared at the start. */
static bool volumetrics_fit(const Lists *lists, const Lists *declared)
{
    for (int k = 0; k < lists->tables.volumetrics; k++) {
        if (lists->tables.volumetric[k].configured && !declared->tables.volumetric[k].configured) {
            return false;
        }
    }
    return true;
}

/* Tell whether new lists can be taken at all; those axes that cannot take theirs get the ones in force. */
static bool fit_update(const Instance *instance, Lists *lists)
{
    const Lists *now = instance->lists;
    if (lists->tables.axis_count != now->tables.axis_count || !volumetrics_fit(lists, instance->first)) {
        axcomp_say(instance, fmi2Warning,
                   "reload: the new lists have other axes or compensations than the ones in force");
        return false;
    }
    if (lists->found > 0) {
        axcomp_say(instance, fmi2Warning, "reload: the new lists are refused: errors in them: %u, the first: %s",
                   (unsigned)lists->found, lists->said);
        return false;
    }
    uint32_t mixed = axcomp_crc32(lists->identity, &now->identity, sizeof now->identity);
    for (int i = 0; i < now->tables.axis_count; i++) {
        const AxisTable *old = &now->tables.axis[i];
        lists->errors[i] = axcomp_update_error(old, &lists->tables.axis[i]);
        if (lists->errors[i] == ERROR_UPDATE) {
            axcomp_say(instance, fmi2Warning, "reload: the new lists do not fit axis %d", old->number);
            return false;
        }
        if (lists->errors[i] != 0) {
            axcomp_say(instance, fmi2Warning, "reload: axis %d keeps its old lists: error %d", old->number,
                       lists->errors[i]);
            lists->identity = mixed;
            if (!keep_axis(lists, now, i)) {
                axcomp_say(instance, fmi2Warning, "reload: there is no memory for the new lists");
                return false;
            }
        }
    }
    return true;
}

/* Give new lists the memory that an update needs: tables for as many volumetric compensations as there are now, and delay
 * lines for their delays. Returns whether there is so much. */
static bool make_room(Instance *instance, Lists *lists)
{
    size_t before = (size_t)lists->tables.volumetrics, after = (size_t)instance->tables.volumetrics;
    if (before < after) {
        void *larger = realloc(lists->tables.volumetric, after * sizeof(VolumetricTable));
        if (larger == NULL) {
            return false;
        }
        lists->tables.volumetric = (VolumetricTable *)larger;
        memset(lists->tables.volumetric + before, 0, (after - before) * sizeof(VolumetricTable));
    }
    Shape needed, old = instance->shape;
    axcomp_shape_of(&lists->tables, &needed);
    for (int32_t i = 0; i < old.axes; i++) {
        if (instance->shape.lines[i] < needed.lines[i]) {
            instance->shape.lines[i] = needed.lines[i];
        }
    }
    if (memcmp(&old, &instance->shape, sizeof old) == 0) {
        return true;
    }
    void *block = instance->block;
    Memory memory = instance->memory;
    if (!axcomp_give_arrays(instance)) {
        instance->block = block;
        instance->shape = old;
        return false;
    }
    axcomp_copy_arrays(&instance->memory, &memory, &old);
    free(block);
    return true;
}

static Lists *own_lists_with(const Instance *instance, uint32_t identity)
{
    Lists *lists = instance->own;
    while (lists != NULL && lists->identity != identity) {
        lists = lists->next;
    }
    return lists;
}

const Lists *axcomp_lists_with(const Instance *instance, uint32_t identity)
{
    const Lists *lists = own_lists_with(instance, identity);
    return lists == NULL && instance->first->identity == identity ? instance->first : lists;
}

void axcomp_hold_lists(Instance *instance, uint32_t identity, int by)
{
    Lists *lists = own_lists_with(instance, identity);
    if (lists != NULL && (by > 0 || lists->held > 0)) {
        lists->held += (unsigned)by;
    }
}

void axcomp_forget_lists(Instance *instance)
{
    int kept = 0;
    for (Lists **link = &instance->own; *link != NULL;) {
        Lists *lists = *link;
        bool used = lists == instance->lists || lists == instance->waiting || lists->held > 0;
        if (!used && ((lists->tuned && !lists->saved) || ++kept > KEPT_LISTS)) {
            *link = lists->next;
            axcomp_free_lists(lists);
        } else {
            link = &lists->next;
        }
    }
}

void axcomp_watch_reload(Instance *instance, bool path_set)
{
    Memory *memory = &instance->memory;
    if (!memory->controls.reload) {
        instance->waiting = NULL;
        memory->refused = false;
        return;
    }
    bool is_read = instance->waiting != NULL || memory->refused;
    if (memory->reload_seen || (is_read && !path_set)) {
        return;
    }
    char path[PATH_LENGTH];
    axcomp_path_of(memory->controls.update_path, NULL, path);
    Lists *lists = read_lists(instance, fmi2Warning, "reload", path[0] != 0 ? path : instance->own_path);
    if (lists != NULL && !fit_update(instance, lists)) {
        axcomp_free_lists(lists);
        lists = NULL;
    }
    if (lists != NULL) {
        /* The same again needs no memory: an instance may be updated as often as one likes. */
        Lists *known = own_lists_with(instance, lists->identity);
        if (known != NULL) {
            axcomp_free_lists(lists);
            lists = known;
        } else if (make_room(instance, lists)) {
            lists->next = instance->own;
            instance->own = lists;
        } else {
            axcomp_say(instance, fmi2Warning, "reload: there is no memory for the new lists");
            axcomp_free_lists(lists);
            lists = NULL;
        }
    }
    instance->waiting = lists;
    memory->refused = lists == NULL;
    axcomp_forget_lists(instance);
}

void axcomp_take_update(Instance *instance)
{
    Memory *memory = &instance->memory;
    const Lists *before = instance->lists;
    Lists *after = instance->waiting;
    if (memory->refused || after != NULL) {
        for (int i = 0; i < instance->tables.axis_count; i++) {
            int32_t error = memory->refused ? ERROR_UPDATE : after->errors[i];
            memory->state.axis[i].error = memory->outputs.axis[i].error = error;
            if (error == 0) {
                axcomp_adopt_axis(&instance->tables.axis[i], before->pool, &after->tables.axis[i], after->pool,
                                  &memory->state, &memory->inputs.axis[i], i);
            }
        }
    }
    if (after != NULL) {
        axcomp_adopt_volumetrics(&instance->tables, &after->tables, &memory->state, &memory->outputs);
        axcomp_use_lists(instance, after);
    }
    instance->waiting = NULL;
    memory->refused = false;
    memory->reload_seen = memory->controls.reload;
}

const Lists *axcomp_waiting_lists(const Instance *instance)
{
    return instance->waiting;
}

/* A copy of an array, NULL if there is no memory; it has room for one element even if there is none. */
static void *copy_of(const void *array, int32_t count, size_t size)
{
    void *copy = calloc((size_t)count + 1u, size);
    if (copy != NULL && count > 0) {
        memcpy(copy, array, (size_t)count * size);
    }
    return copy;
}

/* Make shared lists the instance's own: an update writes into those that it takes. NULL: there is no memory. */
static Lists *own_copy(Instance *instance, const Lists *lists)
{
    Lists *own = (Lists *)copy_of(lists, 1, sizeof *own);
    if (own == NULL) {
        return NULL;
    }
    own->pool = (const double *)copy_of(lists->pool, lists->numbers, sizeof(double));
    own->tables.axis = (AxisTable *)copy_of(lists->tables.axis, lists->tables.axis_count, sizeof(AxisTable));
    own->tables.volumetric =
        (VolumetricTable *)copy_of(lists->tables.volumetric, lists->tables.volumetrics, sizeof(VolumetricTable));
    if (own->pool == NULL || own->tables.axis == NULL || own->tables.volumetric == NULL) {
        axcomp_free_lists(own);
        return NULL;
    }
    own->next = instance->own;
    instance->own = own;
    return own;
}

bool axcomp_wait_for(Instance *instance, const Lists *lists)
{
    instance->waiting = lists != NULL ? own_lists_with(instance, lists->identity) : NULL;
    if (lists != NULL && instance->waiting == NULL) {
        instance->waiting = own_copy(instance, lists);
    }
    return lists == NULL || instance->waiting != NULL;
}

const Lists *axcomp_own_lists(Instance *instance, fmi2String location)
{
    static const char FILE_NAME[] = "tables.bin";
    int known = location != NULL && location[0] != 0 ? axcomp_path_of(location, FILE_NAME, instance->own_path)
                                                     : axcomp_path_beside_library(FILE_NAME, instance->own_path);
    if (!known) {
        axcomp_say(instance, fmi2Error, "fmi2Instantiate: there is no resource location, or it is too long");
        return NULL;
    }
    Lists *lists = read_lists(instance, fmi2Error, "fmi2Instantiate", instance->own_path);
    return lists != NULL ? axcomp_share_lists(lists) : NULL;
}
