/* Many cycles in one call: columns go into the inputs, the outputs into columns. */
#include "run.h"

#include <stdbool.h>

#include "layout.h"

uint32_t axcomp_layout(void)
{
    return AXCOMP_LAYOUT;
}

/* The nearest integer of 32 bits; of what has none the largest, which is no value of a switch. */
static int32_t whole(int64_t value)
{
    return value > -INT32_MAX && value < INT32_MAX ? (int32_t)value : INT32_MAX;
}

static void set_inputs(const Columns *given, int64_t row)
{
    const Field *field = given->fields;
    for (const Field *end = field + given->reals; field < end; field++) {
        *(double *)field->at = *(const double *)(field->column + row * field->stride);
    }
    for (const Field *end = field + given->integers; field < end; field++) {
        *(int32_t *)field->at = whole(*(const int64_t *)(field->column + row * field->stride));
    }
    for (const Field *end = field + given->booleans; field < end; field++) {
        *(bool *)field->at = field->column[row * field->stride] != 0;
    }
}

static void get_outputs(const Columns *results, int64_t row)
{
    const Field *field = results->fields;
    for (const Field *end = field + results->reals; field < end; field++) {
        *(double *)(field->column + row * field->stride) = *(const double *)field->at;
    }
    for (const Field *end = field + results->integers; field < end; field++) {
        *(int64_t *)(field->column + row * field->stride) = *(const int32_t *)field->at;
    }
    for (const Field *end = field + results->booleans; field < end; field++) {
        field->column[row * field->stride] = *(const bool *)field->at;
    }
}

static void obey(const Poke *pokes, int32_t count, bool *before)
{
    for (int32_t k = 0; k < count; k++) {
        const Poke *poke = &pokes[k];
        if (poke->held != 0) {
            before[k] = *(bool *)poke->at;
            *(bool *)poke->at = poke->value != 0;
        } else {
            *(int32_t *)poke->at = poke->value;
        }
    }
}

static void put_back(const Poke *pokes, int32_t count, const bool *before)
{
    for (int32_t k = count; k-- > 0;) {
        const Poke *poke = &pokes[k];
        if (poke->held != 0 && *(bool *)poke->at == (poke->value != 0)) {
            *(bool *)poke->at = before[k];
        }
    }
}

void axcomp_run(const Run *run)
{
    const Event *event = run->events;
    const Event *end = event + run->event_count;
    bool before[POKES];
    for (int64_t row = 0; row < run->rows; row++) {
        set_inputs(&run->given, row);
        bool commanded = event < end && event->row == row;
        if (commanded) {
            obey(run->pokes + event->first, event->count, before);
        }
        axcomp_cycle(run->tables, run->pool, run->state, run->inputs, run->outputs);
        if (commanded) {
            put_back(run->pokes + event->first, event->count, before);
            event++;
        }
        get_outputs(&run->results, row);
    }
}
