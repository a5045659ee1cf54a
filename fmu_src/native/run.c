/* Many cycles in one call: columns go into the inputs, the outputs into columns. */
#include "run.h"

#include <stdbool.h>

#include "layout.h"

uint32_t axcomp_layout(void)
{
    return AXCOMP_LAYOUT;
}

static void set_inputs(const Columns *given, int64_t row, char *inputs)
{
    const Field *field = given->fields;
    for (const Field *end = field + given->reals; field < end; field++) {
        *(double *)(inputs + field->offset) = *(const double *)(field->column + row * field->stride);
    }
    for (const Field *end = field + given->integers; field < end; field++) {
        *(int32_t *)(inputs + field->offset) = (int32_t)*(const int64_t *)(field->column + row * field->stride);
    }
    for (const Field *end = field + given->booleans; field < end; field++) {
        *(bool *)(inputs + field->offset) = field->column[row * field->stride] != 0;
    }
}

static void get_outputs(const Columns *results, int64_t row, const char *outputs)
{
    const Field *field = results->fields;
    for (const Field *end = field + results->reals; field < end; field++) {
        *(double *)(field->column + row * field->stride) = *(const double *)(outputs + field->offset);
    }
    for (const Field *end = field + results->integers; field < end; field++) {
        *(int64_t *)(field->column + row * field->stride) = *(const int32_t *)(outputs + field->offset);
    }
    for (const Field *end = field + results->booleans; field < end; field++) {
        field->column[row * field->stride] = *(const bool *)(outputs + field->offset);
    }
}

static bool *place_of(const Run *run, const Poke *poke)
{
    return (bool *)((poke->in_state != 0 ? (char *)run->state : (char *)run->inputs) + poke->offset);
}

static void obey(const Run *run, const Event *event, bool *before)
{
    for (int32_t k = 0; k < event->count; k++) {
        const Poke *poke = &run->pokes[event->first + k];
        before[k] = *place_of(run, poke);
        *place_of(run, poke) = poke->value != 0;
    }
}

static void put_back(const Run *run, const Event *event, const bool *before)
{
    for (int32_t k = event->count; k-- > 0;) {
        const Poke *poke = &run->pokes[event->first + k];
        if (poke->held != 0 && *place_of(run, poke) == (poke->value != 0)) {
            *place_of(run, poke) = before[k];
        }
    }
}

void axcomp_run(const Run *run)
{
    const Event *event = run->events;
    const Event *end = event + run->event_count;
    bool before[POKES];
    for (int64_t row = 0; row < run->rows; row++) {
        set_inputs(&run->given, row, (char *)run->inputs);
        bool commanded = event < end && event->row == row;
        if (commanded) {
            obey(run, event, before);
        }
        axcomp_cycle(run->tables, run->pool, run->state, run->inputs, run->outputs);
        if (commanded) {
            put_back(run, event++, before);
        }
        get_outputs(&run->results, row, (const char *)run->outputs);
    }
}
