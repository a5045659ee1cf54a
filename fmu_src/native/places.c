/* Generated from axcomp/interface/variables.py by `python -m axcomp.native`; do not edit. */
#include "places.h"

#include <stddef.h>

#include "instance.h"

const Place axcomp_machine_places[PLACES] = {
    AT(0) {'b', 'i', offsetof(Memory, inputs.reset)},
    AT(1) {'b', 'i', offsetof(Memory, inputs.program_end)},
    AT(2) {'b', 'i', offsetof(Memory, controls.reload)},
    AT(3) {'s', 't', offsetof(Memory, controls.update_path)},
    AT(4) {'r', 'p', offsetof(Memory, controls.cycle_time)},
    AT(5) {'r', 'i', offsetof(Memory, inputs.tool_length)},
    AT(6) {'b', 'p', offsetof(Memory, inputs.derive_motion)},
    AT(7) {'i', 'p', offsetof(Memory, controls.largest_step)}
};

const Place axcomp_axis_places[PLACES] = {
    AT(0) {'r', 'i', offsetof(AxisInputs, setpoint)},
    AT(1) {'r', 'i', offsetof(AxisInputs, velocity)},
    AT(2) {'r', 'i', offsetof(AxisInputs, acceleration)},
    AT(3) {'r', 'i', offsetof(AxisInputs, actual_position)},
    AT(4) {'b', 'i', offsetof(AxisInputs, referenced)},
    AT(5) {'b', 'i', offsetof(AxisInputs, fault)},
    AT(6) {'b', 'i', offsetof(AxisInputs, no_move)},
    AT(7) {'b', 'i', offsetof(AxisInputs, released)},
    AT(8) {'r', 'o', offsetof(AxisOutputs, corrected_setpoint)},
    AT(9) {'r', 'o', offsetof(AxisOutputs, display_position)},
    AT(10) {'r', 'o', offsetof(AxisOutputs, correction)},
    AT(11) {'r', 'o', offsetof(AxisOutputs, setpoint_shift)},
    AT(12) {'i', 'o', offsetof(AxisOutputs, error)},
    AT(13) {'r', 'o', offsetof(AxisOutputs, contribution[FRICTION])},
    AT(14) {'b', 'o', offsetof(AxisOutputs, stop_request)},
    AT(15) {'r', 'o', offsetof(AxisOutputs, volumetric_correction)},
    AT(16) {'b', 'i', offsetof(AxisInputs, enable[CROSS])},
    AT(17) {'b', 'o', offsetof(AxisOutputs, active[CROSS])},
    AT(18) {'r', 'o', offsetof(AxisOutputs, contribution[CROSS])},
    AT(19) {0, 0, 0},
    AT(20) {'b', 'i', offsetof(AxisInputs, enable[PLANE])},
    AT(21) {'b', 'o', offsetof(AxisOutputs, active[PLANE])},
    AT(22) {'r', 'o', offsetof(AxisOutputs, contribution[PLANE])},
    AT(23) {0, 0, 0},
    AT(24) {'b', 'i', offsetof(AxisInputs, enable[CROSSTALK])},
    AT(25) {'b', 'o', offsetof(AxisOutputs, active[CROSSTALK])},
    AT(26) {'r', 'o', offsetof(AxisOutputs, contribution[CROSSTALK])},
    AT(27) {0, 0, 0},
    AT(28) {'b', 'i', offsetof(AxisInputs, enable[LEADSCREW])},
    AT(29) {'b', 'o', offsetof(AxisOutputs, active[LEADSCREW])},
    AT(30) {'r', 'o', offsetof(AxisOutputs, contribution[LEADSCREW])},
    AT(31) {0, 0, 0},
    AT(32) {'b', 'i', offsetof(AxisInputs, enable[FRICTION])},
    AT(33) {'b', 'o', offsetof(AxisOutputs, active[FRICTION])},
    AT(34) {0, 0, 0},
    AT(35) {0, 0, 0},
    AT(36) {'b', 'i', offsetof(AxisInputs, enable[TEMPERATURE])},
    AT(37) {'b', 'o', offsetof(AxisOutputs, active[TEMPERATURE])},
    AT(38) {'r', 'o', offsetof(AxisOutputs, contribution[TEMPERATURE])},
    AT(39) {'r', 'i', offsetof(AxisInputs, compensation.temperature.offset)},
    AT(40) {'r', 'i', offsetof(AxisInputs, compensation.temperature.coefficient)},
    AT(41) {0, 0, 0},
    AT(42) {0, 0, 0},
    AT(43) {0, 0, 0},
    AT(44) {'b', 'i', offsetof(AxisInputs, enable[BACKLASH])},
    AT(45) {'b', 'o', offsetof(AxisOutputs, active[BACKLASH])},
    AT(46) {'r', 'o', offsetof(AxisOutputs, contribution[BACKLASH])},
    AT(47) {0, 0, 0},
    AT(48) {'b', 'i', offsetof(AxisInputs, compensation.friction.ahead_known)},
    AT(49) {'r', 'i', offsetof(AxisInputs, compensation.friction.velocity_ahead[0])},
    AT(50) {'r', 'i', offsetof(AxisInputs, compensation.friction.velocity_ahead[1])},
    AT(51) {'r', 'i', offsetof(AxisInputs, compensation.friction.velocity_ahead[2])},
    AT(52) {'r', 'i', offsetof(AxisInputs, compensation.friction.velocity_ahead[3])}
};

const Place axcomp_volumetric_places[PLACES] = {
    AT(0) {'b', 'i', offsetof(VolumetricInputs, enable)},
    AT(1) {'b', 'i', offsetof(VolumetricInputs, no_move)},
    AT(2) {'r', 'i', offsetof(VolumetricInputs, factor_x)},
    AT(3) {'r', 'i', offsetof(VolumetricInputs, factor_y)},
    AT(4) {'r', 'i', offsetof(VolumetricInputs, factor_z)},
    AT(5) {'b', 'o', offsetof(VolumetricOutputs, active)}
};

const char *const axcomp_notices[KINDS] = {
    AT(CROSS) NULL,
    AT(PLANE) NULL,
    AT(CROSSTALK) "the adaptation axes of its crosstalk compensation have left the tests' positions",
    AT(TEMPERATURE) NULL,
    AT(LEADSCREW) NULL,
    AT(BACKLASH) NULL,
    AT(FRICTION) "its friction compensation predicts reversals: nothing gives it velocity_ahead, as its look-ahead needs"
};
