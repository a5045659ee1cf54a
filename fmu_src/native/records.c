/* Generated from axcomp/interface/declarations.py by `python -m axcomp.native`; do not edit. */
#include "records.h"

static const Part SwitchTable_parts[] = {
    {'b', 1, offsetof(SwitchTable, configured), sizeof(bool), NULL},
    {'b', 1, offsetof(SwitchTable, manual), sizeof(bool), NULL},
    {'b', 1, offsetof(SwitchTable, at_standstill), sizeof(bool), NULL},
    {'i', 1, offsetof(SwitchTable, cycles), sizeof(int32_t), NULL},
    {'i', 1, offsetof(SwitchTable, blend_cycles), sizeof(int32_t), NULL},
    {'i', 1, offsetof(SwitchTable, reserved), sizeof(int32_t), NULL},
    {'i', 1, offsetof(SwitchTable, points_error), sizeof(int32_t), NULL},
    {'i', 1, offsetof(SwitchTable, needs), sizeof(int32_t), NULL},
    {'i', 3, offsetof(SwitchTable, need), sizeof(int32_t), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part Argument_parts[] = {
    {'i', 1, offsetof(Argument, axis), sizeof(int32_t), NULL},
    {'d', 1, offsetof(Argument, start), sizeof(double), NULL},
    {'d', 1, offsetof(Argument, period), sizeof(double), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part Curve_parts[] = {
    {'i', 1, offsetof(Curve, points), sizeof(int32_t), NULL},
    {'i', 1, offsetof(Curve, x), sizeof(int32_t), NULL},
    {'i', 1, offsetof(Curve, y), sizeof(int32_t), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part CrossTable_parts[] = {
    {'r', 1, offsetof(CrossTable, master), sizeof(Argument), Argument_parts},
    {'r', 1, offsetof(CrossTable, curve), sizeof(Curve), Curve_parts},
    {0, 0, 0, 0, NULL}
};

static const Part PlaneTable_parts[] = {
    {'r', 1, offsetof(PlaneTable, master1), sizeof(Argument), Argument_parts},
    {'r', 1, offsetof(PlaneTable, master2), sizeof(Argument), Argument_parts},
    {'d', 1, offsetof(PlaneTable, start1), sizeof(double), NULL},
    {'d', 1, offsetof(PlaneTable, start2), sizeof(double), NULL},
    {'d', 1, offsetof(PlaneTable, interval1), sizeof(double), NULL},
    {'d', 1, offsetof(PlaneTable, interval2), sizeof(double), NULL},
    {'i', 1, offsetof(PlaneTable, points1), sizeof(int32_t), NULL},
    {'i', 1, offsetof(PlaneTable, points2), sizeof(int32_t), NULL},
    {'i', 1, offsetof(PlaneTable, values), sizeof(int32_t), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part CrosstalkTable_parts[] = {
    {'i', 1, offsetof(CrosstalkTable, variant), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, master), sizeof(int32_t), NULL},
    {'r', 1, offsetof(CrosstalkTable, adaptation1), sizeof(Argument), Argument_parts},
    {'r', 1, offsetof(CrosstalkTable, adaptation2), sizeof(Argument), Argument_parts},
    {'d', 1, offsetof(CrosstalkTable, acceleration), sizeof(double), NULL},
    {'d', 1, offsetof(CrosstalkTable, deceleration), sizeof(double), NULL},
    {'b', 1, offsetof(CrosstalkTable, velocity_dependent), sizeof(bool), NULL},
    {'r', 1, offsetof(CrosstalkTable, curve), sizeof(Curve), Curve_parts},
    {'i', 1, offsetof(CrosstalkTable, tests), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, values), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, points1), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, points2), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, x1), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, x2), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, triangles), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, triangle), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, edges), sizeof(int32_t), NULL},
    {'i', 1, offsetof(CrosstalkTable, edge), sizeof(int32_t), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part TemperatureTable_parts[] = {
    {'d', 1, offsetof(TemperatureTable, position), sizeof(double), NULL},
    {'d', 1, offsetof(TemperatureTable, offset), sizeof(double), NULL},
    {'d', 1, offsetof(TemperatureTable, coefficient), sizeof(double), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part LeadscrewTable_parts[] = {
    {'r', 1, offsetof(LeadscrewTable, argument), sizeof(Argument), Argument_parts},
    {'r', 1, offsetof(LeadscrewTable, positive), sizeof(Curve), Curve_parts},
    {'r', 1, offsetof(LeadscrewTable, negative), sizeof(Curve), Curve_parts},
    {'b', 1, offsetof(LeadscrewTable, bilateral), sizeof(bool), NULL},
    {'b', 1, offsetof(LeadscrewTable, without_other), sizeof(bool), NULL},
    {'d', 1, offsetof(LeadscrewTable, modulo_range), sizeof(double), NULL},
    {'i', 1, offsetof(LeadscrewTable, reversal_cycles), sizeof(int32_t), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part BacklashTable_parts[] = {
    {'d', 1, offsetof(BacklashTable, amount), sizeof(double), NULL},
    {'i', 1, offsetof(BacklashTable, direction), sizeof(int32_t), NULL},
    {'i', 1, offsetof(BacklashTable, reversal_cycles), sizeof(int32_t), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part FrictionTable_parts[] = {
    {'r', 1, offsetof(FrictionTable, curve), sizeof(Curve), Curve_parts},
    {'d', 1, offsetof(FrictionTable, scaling), sizeof(double), NULL},
    {'d', 1, offsetof(FrictionTable, position_delay), sizeof(double), NULL},
    {'i', 1, offsetof(FrictionTable, lookahead), sizeof(int32_t), NULL},
    {'i', 1, offsetof(FrictionTable, delay), sizeof(int32_t), NULL},
    {'d', 1, offsetof(FrictionTable, modulo_range), sizeof(double), NULL},
    {0, 0, 0, 0, NULL}
};

static const Part CompensationTables_parts[] = {
    {'r', 1, offsetof(CompensationTables, cross), sizeof(CrossTable), CrossTable_parts},
    {'r', 1, offsetof(CompensationTables, plane), sizeof(PlaneTable), PlaneTable_parts},
    {'r', 1, offsetof(CompensationTables, crosstalk), sizeof(CrosstalkTable), CrosstalkTable_parts},
    {'r', 1, offsetof(CompensationTables, temperature), sizeof(TemperatureTable), TemperatureTable_parts},
    {'r', 1, offsetof(CompensationTables, leadscrew), sizeof(LeadscrewTable), LeadscrewTable_parts},
    {'r', 1, offsetof(CompensationTables, backlash), sizeof(BacklashTable), BacklashTable_parts},
    {'r', 1, offsetof(CompensationTables, friction), sizeof(FrictionTable), FrictionTable_parts},
    {0, 0, 0, 0, NULL}
};

const Part axcomp_axis_parts[] = {
    {'i', 1, offsetof(AxisTable, number), sizeof(int32_t), NULL},
    {'i', 1, offsetof(AxisTable, first), sizeof(int32_t), NULL},
    {'i', 1, offsetof(AxisTable, numbers), sizeof(int32_t), NULL},
    {'d', 1, offsetof(AxisTable, modulo_range), sizeof(double), NULL},
    {'i', 1, offsetof(AxisTable, shift_cycles), sizeof(int32_t), NULL},
    {'i', 1, offsetof(AxisTable, kinds), sizeof(int32_t), NULL},
    {'i', 7, offsetof(AxisTable, kind), sizeof(int32_t), NULL},
    {'r', 7, offsetof(AxisTable, switching), sizeof(SwitchTable), SwitchTable_parts},
    {'r', 1, offsetof(AxisTable, compensation), sizeof(CompensationTables), CompensationTables_parts},
    {0, 0, 0, 0, NULL}
};

static const Part ErrorBlock_parts[] = {
    {'i', 1, offsetof(ErrorBlock, interpolation), sizeof(int32_t), NULL},
    {'i', 1, offsetof(ErrorBlock, nodes), sizeof(int32_t), NULL},
    {'i', 1, offsetof(ErrorBlock, errors), sizeof(int32_t), NULL},
    {'i', 1, offsetof(ErrorBlock, error), sizeof(int32_t), NULL},
    {'i', 1, offsetof(ErrorBlock, values), sizeof(int32_t), NULL},
    {'i', 1, offsetof(ErrorBlock, arguments), sizeof(int32_t), NULL},
    {'i', 6, offsetof(ErrorBlock, argument), sizeof(int32_t), NULL},
    {'d', 6, offsetof(ErrorBlock, start), sizeof(double), NULL},
    {'d', 6, offsetof(ErrorBlock, period), sizeof(double), NULL},
    {'i', 6, offsetof(ErrorBlock, points), sizeof(int32_t), NULL},
    {'i', 6, offsetof(ErrorBlock, knots), sizeof(int32_t), NULL},
    {'i', 6, offsetof(ErrorBlock, steps), sizeof(int32_t), NULL},
    {'d', 6, offsetof(ErrorBlock, steps_per_unit), sizeof(double), NULL},
    {0, 0, 0, 0, NULL}
};

const Part axcomp_volumetric_parts[] = {
    {'b', 1, offsetof(VolumetricTable, configured), sizeof(bool), NULL},
    {'b', 1, offsetof(VolumetricTable, manual), sizeof(bool), NULL},
    {'b', 1, offsetof(VolumetricTable, associated), sizeof(bool), NULL},
    {'i', 1, offsetof(VolumetricTable, cycles), sizeof(int32_t), NULL},
    {'i', 1, offsetof(VolumetricTable, members), sizeof(int32_t), NULL},
    {'i', 32, offsetof(VolumetricTable, member), sizeof(int32_t), NULL},
    {'i', 32, offsetof(VolumetricTable, member_letter), sizeof(int32_t), NULL},
    {'d', 32, offsetof(VolumetricTable, member_limit), sizeof(double), NULL},
    {'i', 6, offsetof(VolumetricTable, axis), sizeof(int32_t), NULL},
    {'d', 6, offsetof(VolumetricTable, offset), sizeof(double), NULL},
    {'i', 1, offsetof(VolumetricTable, chain_length), sizeof(int32_t), NULL},
    {'i', 6, offsetof(VolumetricTable, chain), sizeof(int32_t), NULL},
    {'i', 1, offsetof(VolumetricTable, workpiece_axes), sizeof(int32_t), NULL},
    {'b', 6, offsetof(VolumetricTable, exact), sizeof(bool), NULL},
    {'d', 1, offsetof(VolumetricTable, steepness), sizeof(double), NULL},
    {'d', 1, offsetof(VolumetricTable, angular_steepness), sizeof(double), NULL},
    {'d', 1, offsetof(VolumetricTable, reach), sizeof(double), NULL},
    {'d', 3, offsetof(VolumetricTable, velocity), sizeof(double), NULL},
    {'i', 3, offsetof(VolumetricTable, column), sizeof(int32_t), NULL},
    {'b', 1, offsetof(VolumetricTable, alternative), sizeof(bool), NULL},
    {'d', 3, offsetof(VolumetricTable, tool_position), sizeof(double), NULL},
    {'d', 3, offsetof(VolumetricTable, tool_orientation), sizeof(double), NULL},
    {'d', 9, offsetof(VolumetricTable, center), sizeof(double), NULL},
    {'d', 18, offsetof(VolumetricTable, direction), sizeof(double), NULL},
    {'d', 3, offsetof(VolumetricTable, sign), sizeof(double), NULL},
    {'i', 1, offsetof(VolumetricTable, constants), sizeof(int32_t), NULL},
    {'i', 1, offsetof(VolumetricTable, constant), sizeof(int32_t), NULL},
    {'i', 1, offsetof(VolumetricTable, blocks), sizeof(int32_t), NULL},
    {'r', 72, offsetof(VolumetricTable, block), sizeof(ErrorBlock), ErrorBlock_parts},
    {0, 0, 0, 0, NULL}
};
