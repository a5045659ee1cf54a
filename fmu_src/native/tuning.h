/* Tables as arrays that a host reads and calibrates while the machine runs (FMI 3.0). */
#ifndef AXCOMP_TUNING_H
#define AXCOMP_TUNING_H

#include "instance.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How many numbers the array of a value reference has, as the model description says; 0: there is none. */
size_t axcomp_array_size(const Instance *instance, uint32_t reference);

/* The numbers of an array; NULL after telling the host that there are none, or another number of them by now. */
const double *axcomp_array(const Instance *instance, const Lists *lists, uint32_t reference);

/* Put numbers into an array of a copy of the lists in force, NULL: there is no memory for one. Numbers that make no
 * table are refused: fmi2Discard, after telling the host why. */
fmi2Status axcomp_put_array(const Instance *instance, Lists *copy, uint32_t reference, const double *values);

/* Let a copy of the lists in force, whose numbers have changed, be in force: the new ones blend in as an update does. */
void axcomp_tune(Instance *instance, Lists *copy);

#ifdef __cplusplus
}
#endif

#endif
