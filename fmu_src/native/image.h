/* The tables of a machine: in the sources as initialized records (tables.c), or read from an image, a file in resources/.
 *
 * Image: header (304 bytes), AxisTable[axes], VolumetricTable[volumetrics], double[numbers]; little-endian, the fields of
 * the records one behind the other without gaps, a bool in one byte. It is read field by field (records.c), so that byte
 * order, pointer size and alignment of the processor do not matter. Nothing of it is used before all of it has been
 * checked. */
#ifndef AXCOMP_IMAGE_H
#define AXCOMP_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "config.h"
#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { GUID_LENGTH = 40, SAID_LENGTH = 228, HEADER_LENGTH = 304 };

/* Tables in memory. Nothing in them changes any more once an instance uses them. */
typedef struct Lists {
    Tables tables;          /* with the cycle time of the lists */
    const double *pool;     /* that the tables point into */
    int32_t numbers;        /* in the pool */
    uint32_t identity;      /* equal for equal tables */
    char guid[GUID_LENGTH]; /* of the modelDescription.xml that belongs to them */
    bool real_only;         /* it calls Booleans and Integers Real */
    bool tuned;             /* the host has changed numbers in them */
    bool saved;             /* of such ones: a state refers to them */
#if !defined(AXCOMP_EMBEDDED)
    uint32_t found;         /* errors in the lists these were made from: `reload` refuses them then */
    char said[SAID_LENGTH]; /* the first of them */
    int32_t errors[AXES];   /* of an axis that keeps its old tables when these are taken: why; else 0 */
    unsigned users;         /* instances that share them; 0: they belong to one */
    unsigned held;          /* by so many states in memory */
    struct Lists *next;
#endif
} Lists;

#if defined(AXCOMP_EMBEDDED)
extern const Lists axcomp_tables;
#else
/* Read an image into `lists`, which are to be freed in any case. Returns NULL, or what is wrong with the image. */
const char *axcomp_read_image(const unsigned char *data, size_t size, Lists *lists);

/* Free lists that no instance uses. */
void axcomp_free_lists(Lists *lists);
#endif

#ifdef __cplusplus
}
#endif

#endif
