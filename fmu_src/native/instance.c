/* What an instance does between the calls of FMI: initial values, cycles, messages. */
#include "instance.h"

#include <math.h>
#include <string.h>

#include "places.h"

static const double CYCLES_AT_ONCE = 1e9;  /* a longer step is refused: it would seem to hang */

const char *const axcomp_log_categories[CATEGORIES] = {"logStatusWarning", "logStatusError", "logAll"};

bool axcomp_cycle_time_fits(double cycle_time)
{
    return cycle_time > 0.0 && cycle_time < AXCOMP_CYCLE_TIME_MAX;
}

void axcomp_use_lists(Instance *instance, const Lists *lists)
{
    instance->lists = lists;
    instance->tables = lists->tables;
    instance->tables.cycle_time = instance->memory.controls.cycle_time;
}

void axcomp_place_arrays(Instance *instance)
{
    const Shape *shape = &instance->shape;
    size_t state = axcomp_state_size(shape), inputs = axcomp_inputs_size(shape);
    char *block = (char *)instance->block;
    axcomp_place_state(&instance->memory.state, block, shape);
    axcomp_place_state(&instance->preview, block + state, shape);
    axcomp_place_inputs(&instance->memory.inputs, block + 2u * state, shape);
    axcomp_place_outputs(&instance->memory.outputs, block + 2u * state + inputs, shape);
}

void axcomp_begin_again(Instance *instance)
{
    Memory *memory = &instance->memory;
    const Shape *shape = &instance->shape;
    memset(memory, 0, sizeof *memory);
    memset(instance->block, 0,
           2u * axcomp_state_size(shape) + axcomp_inputs_size(shape) + axcomp_outputs_size(shape));
    axcomp_place_arrays(instance);
    memset(instance->told, 0, sizeof instance->told);
    memory->phase = INSTANTIATED;
    memory->controls.cycle_time = instance->first->tables.cycle_time;
    axcomp_use_lists(instance, instance->first);
    (void)axcomp_wait_for(instance, NULL);
    axcomp_set_initial_inputs(&instance->tables, &memory->inputs);
}

void axcomp_preview_outputs(Instance *instance)
{
    Memory *memory = &instance->memory;
    instance->tables.cycle_time = memory->controls.cycle_time;
    axcomp_copy_state(&instance->preview, &memory->state, &instance->shape);
    axcomp_cycle(&instance->tables, instance->lists->pool, &instance->preview, &memory->inputs, &memory->outputs);
}

/* Tell, once for an axis and a kind, that a compensation is used beyond its table. */
static void give_notices(Instance *instance)
{
    for (int i = 0; i < instance->tables.axis_count; i++) {
        for (int kind = 0; kind < KINDS; kind++) {
            bool told = (instance->told[kind] >> i & 1u) != 0;
            if (!told && axcomp_has_notice(kind, &instance->memory.state.axis[i].compensation)) {
                instance->told[kind] |= 1u << i;
                axcomp_say(instance, fmi2Warning, "axis %d: %s", instance->tables.axis[i].number,
                           axcomp_notices[kind]);
            }
        }
    }
}

fmi2Status axcomp_advance(Instance *instance, double time)
{
    Memory *memory = &instance->memory;
    double due = ceil((time - memory->start_time) / instance->tables.cycle_time - AXCOMP_ON_INSTANT);
    if (!(due - memory->cycles <= CYCLES_AT_ONCE)) {
        return axcomp_say(instance, fmi2Error, "fmi2DoStep: a step of more than %g cycles is refused", CYCLES_AT_ONCE);
    }
    axcomp_take_update(instance);
    for (; memory->cycles < due; memory->cycles += 1.0) {
        axcomp_cycle(&instance->tables, instance->lists->pool, &memory->state, &memory->inputs, &memory->outputs);
    }
    give_notices(instance);
    return fmi2OK;
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
