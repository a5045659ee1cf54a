/* The arrays of state, inputs and outputs one behind the other, those with doubles first. */
#include "memory.h"

#include <string.h>

enum { SLICES = 8, BYTES = 256 };

/* The check of one byte after so many bytes of 0 behind it, for each byte. */
static void fill_slices(uint32_t slices[SLICES][BYTES])
{
    for (uint32_t byte = 0; byte < BYTES; byte++) {
        uint32_t check = byte;
        for (int bit = 0; bit < 8; bit++) {
            check = (check >> 1) ^ ((check & 1u) != 0 ? 0xedb88320u : 0u);
        }
        slices[0][byte] = check;
    }
    for (int slice = 1; slice < SLICES; slice++) {
        for (uint32_t byte = 0; byte < BYTES; byte++) {
            uint32_t before = slices[slice - 1][byte];
            slices[slice][byte] = (before >> 8) ^ slices[0][before & 255u];
        }
    }
}

uint32_t axcomp_crc32(uint32_t check, const void *data, size_t size)
{
    /* Made anew in every call, in a few µs: nothing is shared between threads. */
    uint32_t slices[SLICES][BYTES];
    const unsigned char *at = (const unsigned char *)data;
    fill_slices(slices);
    check = ~check;
    for (; size >= SLICES; size -= SLICES, at += SLICES) {
        check ^= (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
        check = slices[7][check & 255u] ^ slices[6][check >> 8 & 255u] ^ slices[5][check >> 16 & 255u]
            ^ slices[4][check >> 24] ^ slices[3][at[4]] ^ slices[2][at[5]] ^ slices[1][at[6]] ^ slices[0][at[7]];
    }
    for (; size > 0; size--) {
        check = (check >> 8) ^ slices[0][(check ^ *at++) & 255u];
    }
    return ~check;
}

void axcomp_shape_of(const Tables *tables, Shape *shape)
{
    memset(shape, 0, sizeof *shape);
    shape->axes = tables->axis_count;
    shape->volumetrics = tables->volumetrics;
    for (int32_t i = 0; i < shape->axes; i++) {
        shape->lines[i] = tables->axis[i].compensation.friction.delay + 1;
    }
}

size_t axcomp_state_size(const Shape *shape)
{
    size_t size = (size_t)shape->axes * (sizeof(AxisMotion) + sizeof(AxisState))
        + (size_t)shape->volumetrics * sizeof(VolumetricState);
    for (int32_t i = 0; i < shape->axes; i++) {
        size += (size_t)shape->lines[i] * sizeof(double);
    }
    return size;
}

size_t axcomp_inputs_size(const Shape *shape)
{
    return (size_t)shape->axes * sizeof(AxisInputs) + (size_t)shape->volumetrics * sizeof(VolumetricInputs);
}

size_t axcomp_outputs_size(const Shape *shape)
{
    size_t size = (size_t)shape->axes * sizeof(AxisOutputs) + (size_t)shape->volumetrics * sizeof(VolumetricOutputs);
    return (size + sizeof(double) - 1u) / sizeof(double) * sizeof(double);
}

void axcomp_place_state(State *state, void *at, const Shape *shape)
{
    state->motion.axis = (AxisMotion *)at;
    state->axis = (AxisState *)(state->motion.axis + shape->axes);
    state->volumetric = (VolumetricState *)(state->axis + shape->axes);
    double *line = (double *)(state->volumetric + shape->volumetrics);
    for (int32_t i = 0; i < shape->axes; i++) {
        state->axis[i].compensation.friction.line = line;
        line += shape->lines[i];
    }
}

void axcomp_place_inputs(Inputs *inputs, void *at, const Shape *shape)
{
    inputs->axis = (AxisInputs *)at;
    inputs->volumetric = (VolumetricInputs *)(inputs->axis + shape->axes);
}

void axcomp_place_outputs(Outputs *outputs, void *at, const Shape *shape)
{
    outputs->axis = (AxisOutputs *)at;
    outputs->volumetric = (VolumetricOutputs *)(outputs->axis + shape->axes);
}

/* Copy an array; there may be none. */
static void copy(void *to, const void *from, int32_t count, size_t size)
{
    if (count > 0) {
        memcpy(to, from, (size_t)count * size);
    }
}

void axcomp_copy_state(State *to, const State *from, const Shape *shape)
{
    to->tool_length = from->tool_length;
    copy(to->motion.axis, from->motion.axis, shape->axes, sizeof(AxisMotion));
    copy(to->volumetric, from->volumetric, shape->volumetrics, sizeof(VolumetricState));
    for (int32_t i = 0; i < shape->axes; i++) {
        double *line = to->axis[i].compensation.friction.line;
        to->axis[i] = from->axis[i];
        to->axis[i].compensation.friction.line = line;
        copy(line, from->axis[i].compensation.friction.line, shape->lines[i], sizeof(double));
    }
}

void axcomp_copy_inputs(Inputs *to, const Inputs *from, const Shape *shape)
{
    Inputs head = *from;
    head.axis = to->axis;
    head.volumetric = to->volumetric;
    *to = head;
    copy(to->axis, from->axis, shape->axes, sizeof *to->axis);
    copy(to->volumetric, from->volumetric, shape->volumetrics, sizeof *to->volumetric);
}

void axcomp_copy_outputs(Outputs *to, const Outputs *from, const Shape *shape)
{
    copy(to->axis, from->axis, shape->axes, sizeof *to->axis);
    copy(to->volumetric, from->volumetric, shape->volumetrics, sizeof *to->volumetric);
}
