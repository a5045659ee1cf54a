/* What an instance does between the calls of FMI: initial values, updates, cycles, messages. */
#include "instance.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "places.h"

enum { MESSAGE_LENGTH = 1024 };

static const double ON_INSTANT = 1e-6;     /* share of a cycle by which a communication point may miss an instant */
static const double CYCLES_AT_ONCE = 1e9;  /* a longer step is refused: it would seem to hang */

const char *const axcomp_log_categories[CATEGORIES] = {"logStatusWarning", "logStatusError", "logAll"};

fmi2Status axcomp_say(const Instance *instance, fmi2Status status, const char *format, ...)
{
    int category = status == fmi2OK ? CATEGORY_ALL : status == fmi2Warning ? CATEGORY_WARNING : CATEGORY_ERROR;
    bool wanted = instance->logging && (instance->categories >> category & 1u) != 0;
    if (instance->callbacks.logger == NULL || (!wanted && category != CATEGORY_ERROR)) {
        return status;
    }
    char message[MESSAGE_LENGTH];
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
    return cycle_time > 0.0 && cycle_time < 1e3;
}

void axcomp_begin_again(Instance *instance)
{
    Memory *memory = &instance->memory;
    memset(memory, 0, sizeof *memory);
    instance->lists = instance->first;
    instance->waiting = NULL;
    instance->notice_given = false;
    memory->phase = INSTANTIATED;
    memory->controls.cycle_time = instance->lists->cycle_time;
    axcomp_set_initial_inputs(&instance->lists->tables, &memory->inputs);
}

/* Read an image from a file into lists of their own; says what is wrong. */
static Lists *read_lists(Instance *instance, const char *path)
{
    size_t size = 0;
    unsigned char *data = axcomp_read_file(path, &size);
    if (data == NULL) {
        axcomp_say(instance, fmi2Warning, "reload: %s cannot be read", path);
        return NULL;
    }
    Lists *lists = (Lists *)calloc(1, sizeof *lists);
    const char *complaint = lists == NULL ? "there is no memory for it" : axcomp_read_image(data, size, lists);
    free(data);
    if (complaint != NULL) {
        axcomp_say(instance, fmi2Warning, "reload: %s is refused: %s", path, complaint);
        if (lists != NULL) {
            free(lists->pool);
            free(lists);
        }
        return NULL;
    }
    lists->next = instance->first->next;
    instance->first->next = lists;
    return lists;
}

void axcomp_read_update(Instance *instance)
{
    char path[PATH_LENGTH];
    const Tables *now = &instance->lists->tables;
    const char *given = instance->memory.controls.update_path;
    Lists *lists = axcomp_path_of(given, NULL, path) && path[0] != 0 ? read_lists(instance, path) : NULL;
    if (path[0] == 0) {
        axcomp_say(instance, fmi2Warning, "reload: update_path names no image");
    }
    if (lists != NULL && (lists->tables.axis_count != now->axis_count || lists->tables.volumetrics > now->volumetrics)) {
        axcomp_say(instance, fmi2Warning,
                   "reload: the new lists have other axes or compensations than the ones in force");
        lists = NULL;
    }
    for (int i = 0; lists != NULL && i < now->axis_count; i++) {
        if (axcomp_update_error(&now->axis[i], &lists->tables.axis[i]) == ERROR_UPDATE) {
            axcomp_say(instance, fmi2Warning, "reload: the new lists do not fit axis %d", now->axis[i].number);
            lists = NULL;
        }
    }
    instance->waiting = lists;
    instance->memory.refused = lists == NULL;
}

/* Take the lists that wait: axis by axis, one whose reserved sizes differ keeps its old ones. */
static void take_update(Instance *instance)
{
    Memory *memory = &instance->memory;
    Lists *before = instance->lists;
    Lists *after = instance->waiting;
    if (memory->refused) {
        for (int i = 0; i < before->tables.axis_count; i++) {
            memory->state.axis[i].error = memory->outputs.axis[i].error = ERROR_UPDATE;
        }
    } else if (after != NULL) {
        for (int i = 0; i < before->tables.axis_count; i++) {
            const AxisTable *old = &before->tables.axis[i];
            int32_t error = axcomp_update_error(old, &after->tables.axis[i]);
            memory->state.axis[i].error = memory->outputs.axis[i].error = error;
            if (error == 0) {
                axcomp_adopt_axis(old, &after->tables.axis[i], &memory->state.axis[i], &memory->outputs.axis[i]);
            } else {
                after->tables.axis[i] = *old;
                after->identity =
                    axcomp_crc32(after->identity, &before->identity, sizeof before->identity) + (uint32_t)i;
                axcomp_say(instance, fmi2Warning, "axis %d keeps its old lists: error %d", old->number, error);
            }
        }
        axcomp_adopt_volumetrics(&before->tables, &after->tables, &memory->state, &memory->outputs);
        after->tables.cycle_time = before->tables.cycle_time;
        instance->lists = after;
    }
    instance->waiting = NULL;
    memory->refused = false;
}

void axcomp_preview_outputs(Instance *instance)
{
    Memory *memory = &instance->memory;
    instance->lists->tables.cycle_time = memory->controls.cycle_time;
    instance->preview = memory->state;
    axcomp_cycle(&instance->lists->tables, &instance->preview, &memory->inputs, &memory->outputs);
}

/* Tell, once, that crosstalk is computed from the edge of its tests. */
static void give_notice(Instance *instance)
{
    for (int i = 0; !instance->notice_given && i < instance->lists->tables.axis_count; i++) {
        if (instance->memory.state.axis[i].crosstalk.outside) {
            instance->notice_given = true;
            axcomp_say(instance, fmi2Warning,
                       "axis %d: the adaptation axes of its crosstalk compensation have left the tests",
                       instance->lists->tables.axis[i].number);
        }
    }
}

fmi2Status axcomp_advance(Instance *instance, double time)
{
    Memory *memory = &instance->memory;
    take_update(instance);
    double due = ceil((time - memory->start_time) / instance->lists->tables.cycle_time - ON_INSTANT);
    if (!(due - memory->cycles <= CYCLES_AT_ONCE)) {
        return axcomp_say(instance, fmi2Error, "fmi2DoStep: a step of more than %g cycles is refused", CYCLES_AT_ONCE);
    }
    for (; memory->cycles < due; memory->cycles += 1.0) {
        axcomp_cycle(&instance->lists->tables, &memory->state, &memory->inputs, &memory->outputs);
    }
    give_notice(instance);
    return fmi2OK;
}

void axcomp_free_instance(Instance *instance)
{
    for (Lists *lists = instance->first; lists != NULL;) {
        Lists *next = lists->next;
        free(lists->pool);
        free(lists);
        lists = next;
    }
    free(instance->name);
    free(instance);
}
