/* Tables as an image: what the table compiler made, as a file in resources/ or as an array in the sources.
 *
 * Header (304 bytes), AxisTable[axes], VolumetricTable[volumetrics], double[numbers]; little-endian, as the compilers of
 * all supported platforms lay the records out: there is no pointer in them. Nothing of an image is used before all of it has been checked. */
#ifndef AXCOMP_IMAGE_H
#define AXCOMP_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "config.h"
#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { GUID_LENGTH = 40, SAID_LENGTH = 228 };

typedef struct {
    char magic[8];          /* "AXCOMPT2" */
    uint32_t layout;        /* of the records: AXCOMP_LAYOUT in layout.h */
    uint16_t axes;
    uint16_t volumetrics;
    uint32_t numbers;       /* in the pool */
    uint32_t check;         /* CRC-32 of everything behind it */
    char guid[GUID_LENGTH]; /* of the modelDescription.xml that belongs to it; 0 to its end */
    double cycle_time;      /* s */
    uint32_t errors;        /* that were found in the lists: `reload` refuses them then */
    char said[SAID_LENGTH]; /* the first of them; 0 to its end */
} ImageHeader;

/* Tables in memory. They stay as long as the instance uses them or a state in memory does; of all others the last few. */
typedef struct Lists {
    Tables tables;
    uint32_t identity;  /* equal for equal tables */
    double cycle_time;   /* s; that of the tables may be set by the host */
    char guid[GUID_LENGTH];
    uint32_t found;        /* errors in the lists these were made from */
    char said[SAID_LENGTH]; /* the first of them */
    int32_t errors[AXES];  /* of an axis that keeps its old tables when these are taken: why; else 0 */
    double *pool;          /* that the tables point into; owned */
    int32_t numbers;       /* in the pool */
    int held;              /* by so many states in memory */
    struct Lists *next;
} Lists;

#if defined(AXCOMP_EMBEDDED)
/* The image in the sources: tables.c. */
extern const unsigned long long axcomp_image[];
extern const unsigned int axcomp_image_size;
#endif

/* CRC-32 (IEEE 802.3) of some bytes, going on from `check` (0 to begin with). */
uint32_t axcomp_crc32(uint32_t check, const void *data, size_t size);

/* Read an image into `lists`, whose pool is to be freed in any case. Returns NULL, or what is wrong with the image. */
const char *axcomp_read_image(const unsigned char *data, size_t size, Lists *lists);

#ifdef __cplusplus
}
#endif

#endif
