/* The arrays of state, inputs and outputs one behind the other, those with doubles first. */
#include "memory.h"

#include <string.h>

uint32_t axcomp_crc32(uint32_t check, const void *data, size_t size)
{
    static const uint32_t NIBBLES[16] = {
        0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu, 0x76dc4190u, 0x6b6b51f4u, 0x4db26158u, 0x5005713cu,
        0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu, 0x9b64c2b0u, 0x86d3d2d4u, 0xa00ae278u, 0xbdbdf21cu,
    };
    const unsigned char *bytes = (const unsigned char *)data;
    check = ~check;
    for (size_t i = 0; i < size; i++) {
        check ^= bytes[i];
        check = (check >> 4) ^ NIBBLES[check & 15u];
        check = (check >> 4) ^ NIBBLES[check & 15u];
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
