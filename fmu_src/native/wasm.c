/* The kernel in WebAssembly: a machine is made of an image, and its variables are columns of numbers. */
#include <stdlib.h>

#include "spot.h"

#define EXPORTED __attribute__((visibility("default")))

typedef struct {
    const char *complaint; /* what is wrong with the image; NULL: nothing */
    Lists lists;
    Memory memory;
    void *block; /* of the arrays */
} Machine;

/* Where a variable is, and 'r' double, 'i' int32_t or 'b' bool; 0: there is none. */
typedef struct {
    void *at;
    int32_t type;
} Field;

EXPORTED void *axcomp_allocate(size_t size)
{
    return malloc(size);
}

EXPORTED void axcomp_free(void *block)
{
    free(block);
}

EXPORTED void axcomp_close(Machine *machine)
{
    free(machine->lists.tables.axis);
    free(machine->lists.tables.volumetric);
    free((void *)machine->lists.pool);
    free(machine->block);
    free(machine);
}

/* Make a machine of an image, all inputs 0; NULL: there is no memory. */
EXPORTED Machine *axcomp_open(const unsigned char *image, size_t size)
{
    Machine *machine = (Machine *)calloc(1, sizeof *machine);
    if (machine == NULL) {
        return NULL;
    }
    machine->complaint = axcomp_read_image(image, size, &machine->lists);
    if (machine->complaint != NULL) {
        return machine;
    }
    Shape shape;
    axcomp_shape_of(&machine->lists.tables, &shape);
    size_t state = axcomp_state_size(&shape), inputs = axcomp_inputs_size(&shape);
    char *block = (char *)calloc(1, state + inputs + axcomp_outputs_size(&shape));
    machine->block = block;
    if (block == NULL) {
        machine->complaint = "there is no memory for it";
        return machine;
    }
    axcomp_place_state(&machine->memory.state, block, &shape);
    axcomp_place_inputs(&machine->memory.inputs, block + state, &shape);
    axcomp_place_outputs(&machine->memory.outputs, block + state + inputs, &shape);
    return machine;
}

/* Find the variable of a value reference. */
EXPORTED void axcomp_find(Machine *machine, uint32_t reference, Field *field)
{
    const Spot spot = axcomp_spot_of(&machine->memory, &machine->lists.tables, reference / PLACES);
    const Place *place = &spot.places[reference % PLACES];
    field->at = axcomp_at(&spot, place);
    field->type = place->type;
}

static void set(const Field *field, double value)
{
    if (field->type == 'r') {
        *(double *)field->at = value;
    } else if (field->type == 'b') {
        *(bool *)field->at = value != 0.0;
    } else {
        *(int32_t *)field->at = (int32_t)value;
    }
}

static double get(const Field *field)
{
    return field->type == 'r' ? *(const double *)field->at
        : field->type == 'b'  ? (double)*(const bool *)field->at
                              : (double)*(const int32_t *)field->at;
}

/* Run a cycle for each row of `from`, which are so many inputs; the outputs go into the rows of `to`. */
EXPORTED void axcomp_run_rows(Machine *machine, int32_t rows, const Field *inputs, int32_t input_count,
                              const double *from, const Field *outputs, int32_t output_count, double *to)
{
    Memory *memory = &machine->memory;
    for (int32_t row = 0; row < rows; row++) {
        for (int32_t k = 0; k < input_count; k++) {
            set(&inputs[k], *from++);
        }
        axcomp_cycle(&machine->lists.tables, machine->lists.pool, &memory->state, &memory->inputs, &memory->outputs);
        for (int32_t k = 0; k < output_count; k++) {
            *to++ = get(&outputs[k]);
        }
    }
}
