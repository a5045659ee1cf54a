/* What an instance does between the calls of FMI: initial values, cycles, messages. */
#include "instance.h"

#include <fenv.h>
#include <math.h>
#include <string.h>

#include "places.h"

static const double COUNTED_MAX = 9007199254740992.0;  /* cycles are counted exactly */

const char *const axcomp_log_categories[CATEGORIES] = {"logStatusWarning", "logStatusError", "logAll"};

#if defined(FE_TONEAREST)
int axcomp_round_to_nearest(void)
{
    int before = fegetround();
    if (before != FE_TONEAREST) {
        fesetround(FE_TONEAREST);
    }
    return before;
}

void axcomp_restore_rounding(int mode)
{
    if (mode != FE_TONEAREST && mode >= 0) {
        fesetround(mode);
    }
}
#else
/* A processor that rounds in one way. */
int axcomp_round_to_nearest(void)
{
    return 0;
}

void axcomp_restore_rounding(int mode)
{
    (void)mode;
}
#endif

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
    axcomp_place_inputs(&instance->memory.slopes, block + 2u * state + inputs, shape);
    axcomp_place_inputs(&instance->begin, block + 2u * state + 2u * inputs, shape);
    axcomp_place_outputs(&instance->memory.outputs, block + 2u * state + 3u * inputs, shape);
}

size_t axcomp_block_size(const Shape *shape)
{
    return 2u * axcomp_state_size(shape) + 3u * axcomp_inputs_size(shape) + axcomp_outputs_size(shape);
}

void axcomp_copy_arrays(Memory *to, const Memory *from, const Shape *shape)
{
    axcomp_copy_state(&to->state, &from->state, shape);
    axcomp_copy_inputs(&to->inputs, &from->inputs, shape);
    axcomp_copy_inputs(&to->slopes, &from->slopes, shape);
    axcomp_copy_outputs(&to->outputs, &from->outputs, shape);
}

void axcomp_begin_again(Instance *instance)
{
    Memory *memory = &instance->memory;
    const Shape *shape = &instance->shape;
    memset(memory, 0, sizeof *memory);
    memset(instance->block, 0, axcomp_block_size(shape));
    axcomp_place_arrays(instance);
    memset(instance->told, 0, sizeof instance->told);
    memory->phase = INSTANTIATED;
    memory->controls.cycle_time = instance->first->tables.cycle_time;
    memory->controls.largest_step = AXCOMP_LARGEST_STEP;
    memory->stop_time = HUGE_VAL;
    axcomp_use_lists(instance, instance->first);
    (void)axcomp_wait_for(instance, NULL);
}

bool axcomp_memory_fits(const Lists *lists, const Memory *memory)
{
    const bool *const booleans[] = {&memory->controls.reload, &memory->reload_seen, &memory->refused, &memory->sloped};
    for (size_t i = 0; i < sizeof booleans / sizeof booleans[0]; i++) {
        if (*(const unsigned char *)booleans[i] > 1) {
            return false;
        }
    }
    int phase = 0;
    memcpy(&phase, &memory->phase, sizeof memory->phase);
    return (phase == INSTANTIATED || phase == INITIALIZATION || phase == STEPPING || phase == TERMINATED
            || phase == EVENT)
        && axcomp_cycle_time_fits(memory->controls.cycle_time) && memory->start_time - memory->start_time == 0.0
        && memory->time - memory->time == 0.0 && memory->stop_time == memory->stop_time && memory->cycles >= 0.0
        && memory->cycles <= COUNTED_MAX && axcomp_state_fits(&lists->tables, &memory->state)
        && axcomp_given_fits(&lists->tables, &memory->inputs, &memory->outputs)
        && axcomp_given_fits(&lists->tables, &memory->slopes, &memory->outputs);
}

void axcomp_preview_outputs(Instance *instance)
{
    Memory *memory = &instance->memory;
    instance->tables.cycle_time = memory->controls.cycle_time;
    axcomp_copy_state(&instance->preview, &memory->state, &instance->shape);
    int rounding = axcomp_round_to_nearest();
    axcomp_cycle(&instance->tables, instance->lists->pool, &instance->preview, &memory->inputs, &memory->outputs);
    axcomp_restore_rounding(rounding);
}

bool axcomp_cycle_begins(const Instance *instance)
{
    const Memory *memory = &instance->memory;
    double since = memory->time - memory->start_time, cycle_time = instance->tables.cycle_time;
    return memory->cycles * cycle_time - since <= AXCOMP_ON_INSTANT * cycle_time;
}

void axcomp_refresh_outputs(Instance *instance)
{
    if (instance->stale && axcomp_cycle_begins(instance)) {
        axcomp_preview_outputs(instance);
    }
    instance->stale = false;
}

/* Tell, once for an axis and a kind, that a compensation is used beyond its table, and of switches that are none. */
static void give_notices(Instance *instance)
{
    for (int i = 0; i < instance->tables.axis_count; i++) {
        const AxisState *axis = &instance->memory.state.axis[i];
        for (int kind = 0; kind <= KINDS; kind++) {
            bool told = (instance->told[kind] >> i & 1u) != 0;
            if (!told && (kind < KINDS ? axcomp_has_notice(kind, &axis->compensation) : axis->error == ERROR_SWITCH)) {
                instance->told[kind] |= 1u << i;
                axcomp_say(instance, fmi2Warning, "axis %d: %s", instance->tables.axis[i].number,
                           kind < KINDS ? axcomp_notices[kind] : axcomp_no_command);
            }
        }
    }
}

/* Put the values that inputs with a slope have some time after they were set (`begin`) into a record of inputs. */
static void incline_record(const Place places[], void *inputs, const void *begin, const void *slopes, double since)
{
    for (int i = 0; i < PLACES; i++) {
        if (places[i].type == 'r' && places[i].causality == 'i') {
            double slope = *(const double *)((const char *)slopes + places[i].offset);
            if (slope != 0.0) {
                double value = *(const double *)((const char *)begin + places[i].offset);
                *(double *)((char *)inputs + places[i].offset) = value + slope * since;
            }
        }
    }
}

/* The same for all inputs; `since`: s after the begin of the step. */
static void incline(Instance *instance, double since)
{
    Memory *memory = &instance->memory;
    const Tables *tables = &instance->tables;
    since = since > 0.0 ? since : 0.0;
    memory->inputs.tool_length = instance->begin.tool_length + memory->slopes.tool_length * since;
    for (int i = 0; i < tables->axis_count; i++) {
        incline_record(axcomp_axis_places, &memory->inputs.axis[i], &instance->begin.axis[i], &memory->slopes.axis[i],
                       since);
    }
    for (int k = 0; k < tables->volumetrics; k++) {
        incline_record(axcomp_volumetric_places, &memory->inputs.volumetric[k], &instance->begin.volumetric[k],
                       &memory->slopes.volumetric[k], since);
    }
}

fmi2Status axcomp_advance(Instance *instance, double begin, double end)
{
    Memory *memory = &instance->memory;
    double cycle_time = instance->tables.cycle_time;
    int rounding = axcomp_round_to_nearest();
    double due = ceil((end - memory->start_time) / cycle_time - AXCOMP_ON_INSTANT);
    if (!(due - memory->cycles <= memory->controls.largest_step && due <= COUNTED_MAX)) {
        axcomp_restore_rounding(rounding);
        return axcomp_say(instance, fmi2Error, "fmi2DoStep: a step of %.0f cycles is refused; largest_step is %d",
                          due - memory->cycles, (int)memory->controls.largest_step);
    }
    axcomp_take_update(instance);
    bool sloped = memory->sloped;
    if (sloped) {
        axcomp_copy_inputs(&instance->begin, &memory->inputs, &instance->shape);
    }
    for (; memory->cycles < due; memory->cycles += 1.0) {
        if (sloped) {
            incline(instance, memory->start_time + memory->cycles * cycle_time - begin);
        }
        axcomp_cycle(&instance->tables, instance->lists->pool, &memory->state, &memory->inputs, &memory->outputs);
    }
    if (sloped) {
        incline(instance, end - begin);
        memory->slopes.tool_length = 0.0;
        memset(memory->slopes.axis, 0, axcomp_inputs_size(&instance->shape));
        memory->sloped = false;
    }
    memory->time = end;
    axcomp_restore_rounding(rounding);
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
