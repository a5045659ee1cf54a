/* What an instance does between the calls of FMI: initial values, updates, cycles, messages. */
#include "instance.h"

#include <fenv.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "places.h"

enum { MESSAGE_LENGTH = 1024, KEPT_LISTS = 8 };

static const double COUNTED_MAX = 9007199254740992.0;  /* cycles are counted exactly */

/* Round to nearest, whatever the host does; what it did is to be restored. */
static int round_to_nearest(void)
{
    int before = fegetround();
    if (before != FE_TONEAREST) {
        fesetround(FE_TONEAREST);
    }
    return before;
}

static void restore_rounding(int mode)
{
    if (mode != FE_TONEAREST && mode >= 0) {
        fesetround(mode);
    }
}

const char *const axcomp_log_categories[CATEGORIES] = {"logStatusWarning", "logStatusError", "logAll"};

fmi2Status axcomp_say(const Instance *instance, fmi2Status status, const char *format, ...)
{
    int category = status == fmi2OK ? CATEGORY_ALL : status == fmi2Warning ? CATEGORY_WARNING : CATEGORY_ERROR;
    bool wanted = instance->logging && (instance->categories >> category & 1u) != 0;
    if (instance->callbacks.logger == NULL || (!wanted && category != CATEGORY_ERROR)) {
        return status;
    }
    char message[MESSAGE_LENGTH] = "";
    char doubled[2 * MESSAGE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    /* The host takes the message for a format. */
    size_t length = 0;
    for (const char *from = message; *from != 0; from++) {
        if (*from == '%') {
            doubled[length++] = '%';
        }
        doubled[length++] = *from;
    }
    doubled[length] = 0;
    instance->callbacks.logger(instance->callbacks.componentEnvironment, instance->name, status,
                               axcomp_log_categories[category], doubled);
    return status;
}

bool axcomp_cycle_time_fits(double cycle_time)
{
    return cycle_time > 0.0 && cycle_time < AXCOMP_CYCLE_TIME_MAX;
}

void axcomp_begin_again(Instance *instance)
{
    Memory *memory = &instance->memory;
    memset(memory, 0, sizeof *memory);
    instance->lists = instance->first;
    instance->waiting = NULL;
    memset(instance->told, 0, sizeof instance->told);
    memory->phase = INSTANTIATED;
    memory->controls.cycle_time = instance->lists->cycle_time;
    memory->controls.largest_step = AXCOMP_LARGEST_STEP;
    axcomp_set_initial_inputs(&instance->lists->tables, &memory->inputs);
}

static void free_lists(Lists *lists)
{
    if (lists != NULL) {
        free(lists->pool);
        free(lists);
    }
}

Lists *axcomp_read_lists(const Instance *instance, fmi2Status status, const char *call, const char *path)
{
    const char *complaint = "there is no memory for it";
    Lists *lists = (Lists *)calloc(1, sizeof *lists);
    int rounding = round_to_nearest();
#if defined(AXCOMP_EMBEDDED)
    if (path[0] == 0) {
        path = "the image in the sources";
        if (lists != NULL) {
            complaint = axcomp_read_image((const unsigned char *)axcomp_image, axcomp_image_size, lists);
        }
    } else
#endif
    {
        size_t size = 0;
        unsigned char *data = axcomp_read_file(path, &size);
        if (data == NULL) {
            restore_rounding(rounding);
            axcomp_say(instance, status, "%s: %s cannot be read", call, path);
            free_lists(lists);
            return NULL;
        }
        if (lists != NULL) {
            complaint = axcomp_read_image(data, size, lists);
        }
        free(data);
    }
    restore_rounding(rounding);
    if (complaint != NULL) {
        axcomp_say(instance, status, "%s: %s is refused: %s", call, path, complaint);
        free_lists(lists);
        return NULL;
    }
    return lists;
}

/* Let an axis of new lists keep the tables that are in force. */
static bool keep_axis(Lists *lists, const Lists *now, int i)
{
    const AxisTable *old = &now->tables.axis[i];
    size_t count = (size_t)lists->numbers + (size_t)old->numbers;
    double *pool = (double *)realloc(lists->pool, (count + 1u) * sizeof *pool);
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

Lists *axcomp_lists_with(const Instance *instance, uint32_t identity)
{
    Lists *lists = instance->first;
    while (lists != NULL && lists->identity != identity) {
        lists = lists->next;
    }
    return lists;
}

void axcomp_hold_lists(Instance *instance, uint32_t identity, int by)
{
    Lists *lists = axcomp_lists_with(instance, identity);
    if (lists != NULL && lists->held + by >= 0) {
        lists->held += by;
    }
}

/* Free lists that nothing uses, but for the last ones: a state in bytes may come back to them. */
static void forget_lists(Instance *instance)
{
    int kept = 0;
    for (Lists **at = &instance->first->next; *at != NULL;) {
        Lists *lists = *at;
        bool used = lists == instance->lists || lists == instance->waiting || lists->held > 0;
        if (!used && ++kept > KEPT_LISTS) {
            *at = lists->next;
            free_lists(lists);
        } else {
            at = &lists->next;
        }
    }
}

bool axcomp_memory_fits(const Lists *lists, const Memory *memory)
{
    const bool *const booleans[] = {&memory->controls.reload, &memory->reload_seen, &memory->refused};
    for (size_t i = 0; i < sizeof booleans / sizeof booleans[0]; i++) {
        if (*(const unsigned char *)booleans[i] > 1) {
            return false;
        }
    }
    int phase = 0;
    memcpy(&phase, &memory->phase, sizeof memory->phase);
    return (phase == INSTANTIATED || phase == INITIALIZATION || phase == STEPPING || phase == TERMINATED)
        && memchr(memory->controls.update_path, 0, sizeof memory->controls.update_path) != NULL
        && axcomp_cycle_time_fits(memory->controls.cycle_time) && memory->start_time - memory->start_time == 0.0
        && memory->cycles >= 0.0 && memory->cycles <= COUNTED_MAX
        && axcomp_state_fits(&lists->tables, &memory->state)
        && axcomp_given_fits(&memory->inputs, &memory->outputs);
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
    Lists *lists = axcomp_read_lists(instance, fmi2Warning, "reload", path[0] != 0 ? path : instance->own_path);
    if (lists != NULL && !fit_update(instance, lists)) {
        free_lists(lists);
        lists = NULL;
    }
    if (lists != NULL) {
        /* The same again needs no memory: an instance may be updated as often as one likes. */
        Lists *known = axcomp_lists_with(instance, lists->identity);
        if (known != NULL) {
            free_lists(lists);
            lists = known;
        } else {
            lists->next = instance->first->next;
            instance->first->next = lists;
        }
    }
    instance->waiting = lists;
    memory->refused = lists == NULL;
    forget_lists(instance);
}

/* Take the lists that wait, or tell by the outputs that they were refused. */
static void take_update(Instance *instance)
{
    Memory *memory = &instance->memory;
    Lists *before = instance->lists;
    Lists *after = instance->waiting;
    if (memory->refused || after != NULL) {
        for (int i = 0; i < before->tables.axis_count; i++) {
            int32_t error = memory->refused ? ERROR_UPDATE : after->errors[i];
            memory->state.axis[i].error = memory->outputs.axis[i].error = error;
            if (error == 0) {
                axcomp_adopt_axis(&before->tables.axis[i], before->pool, &after->tables.axis[i], after->pool,
                                  &memory->state, &memory->inputs.axis[i], i);
            }
        }
    }
    if (after != NULL) {
        axcomp_adopt_volumetrics(&before->tables, &after->tables, &memory->state, &memory->outputs);
        after->tables.cycle_time = before->tables.cycle_time;
        instance->lists = after;
    }
    instance->waiting = NULL;
    memory->refused = false;
    memory->reload_seen = memory->controls.reload;
}

void axcomp_preview_outputs(Instance *instance)
{
    Memory *memory = &instance->memory;
    instance->lists->tables.cycle_time = memory->controls.cycle_time;
    instance->preview = memory->state;
    int rounding = round_to_nearest();
    axcomp_cycle(&instance->lists->tables, instance->lists->pool, &instance->preview, &memory->inputs, &memory->outputs);
    restore_rounding(rounding);
}

/* Tell, once for an axis and a kind, that a compensation is used beyond its table. */
static void give_notices(Instance *instance)
{
    for (int i = 0; i < instance->lists->tables.axis_count; i++) {
        for (int kind = 0; kind < KINDS; kind++) {
            bool told = (instance->told[kind] >> i & 1u) != 0;
            if (!told && axcomp_has_notice(kind, &instance->memory.state.axis[i].compensation)) {
                instance->told[kind] |= 1u << i;
                axcomp_say(instance, fmi2Warning, "axis %d: %s", instance->lists->tables.axis[i].number,
                           axcomp_notices[kind]);
            }
        }
    }
}

fmi2Status axcomp_advance(Instance *instance, double time)
{
    Memory *memory = &instance->memory;
    int rounding = round_to_nearest();
    double due = ceil((time - memory->start_time) / instance->lists->tables.cycle_time - AXCOMP_ON_INSTANT);
    if (!(due - memory->cycles <= memory->controls.largest_step && due <= COUNTED_MAX)) {
        restore_rounding(rounding);
        return axcomp_say(instance, fmi2Error, "fmi2DoStep: a step of %.0f cycles is refused; largest_step is %d",
                          due - memory->cycles, memory->controls.largest_step);
    }
    take_update(instance);
    for (; memory->cycles < due; memory->cycles += 1.0) {
        axcomp_cycle(&instance->lists->tables, instance->lists->pool, &memory->state, &memory->inputs, &memory->outputs);
    }
    restore_rounding(rounding);
    give_notices(instance);
    return fmi2OK;
}

void axcomp_free_instance(Instance *instance)
{
    for (Lists *lists = instance->first; lists != NULL;) {
        Lists *next = lists->next;
        free_lists(lists);
        lists = next;
    }
    free(instance->name);
    free(instance);
}

/* The instance, if this call is allowed in its phase; else NULL, after telling the host. */
Instance *axcomp_allowed(fmi2Component component, unsigned phases, const char *function)
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
Instance *axcomp_given(Instance *instance, const void *pointer, const char *function)
{
    if (instance != NULL && pointer == NULL) {
        axcomp_say(instance, fmi2Error, "%s: an argument is NULL", function);
        return NULL;
    }
    return instance;
}
