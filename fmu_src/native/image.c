/* Images of tables: checked, then read into the kernel's records. */
#include "image.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "memory.h"
#include "records.h"

static uint32_t read_uint(const unsigned char *from, int bytes)
{
    uint32_t value = 0;
    for (int i = 0; i < bytes; i++) {
        value |= (uint32_t)from[i] << 8 * i;
    }
    return value;
}

static double read_double(const unsigned char *from)
{
    uint64_t bits = (uint64_t)read_uint(from + 4, 4) << 32 | read_uint(from, 4);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Read the fields of a record; returns what is behind them. */
static const unsigned char *read_record(const unsigned char *from, const Part *part, void *record)
{
    for (; part->type != 0; part++) {
        for (int32_t k = 0; k < part->count; k++) {
            char *at = (char *)record + part->offset + (size_t)k * part->size;
            if (part->type == 'd') {
                double value = read_double(from);
                memcpy(at, &value, sizeof value);
                from += 8;
            } else if (part->type == 'i') {
                int32_t value = (int32_t)read_uint(from, 4);
                memcpy(at, &value, sizeof value);
                from += 4;
            } else if (part->type == 'b') {
                bool value = *from++ != 0;
                memcpy(at, &value, sizeof value);
            } else {
                from = read_record(from, part->parts, at);
            }
        }
    }
    return from;
}

void axcomp_free_lists(Lists *lists)
{
    if (lists != NULL) {
        free(lists->tables.axis);
        free(lists->tables.volumetric);
        free((void *)lists->pool);
        free(lists);
    }
}

const char *axcomp_read_image(const unsigned char *data, size_t size, Lists *lists)
{
    memset(lists, 0, sizeof *lists);
    if (size < HEADER_LENGTH) {
        return "it is truncated";
    }
    if (memcmp(data, "AXCOMPT3", 8) != 0) {
        return "it is no image of axcomp's tables";
    }
    if (read_uint(data + 8, 4) != AXCOMP_LAYOUT) {
        return "it belongs to another version of axcomp";
    }
    uint32_t axes = read_uint(data + 12, 2), volumetrics = read_uint(data + 14, 2), numbers = read_uint(data + 16, 4);
    uint64_t expected = HEADER_LENGTH + (uint64_t)axes * AXCOMP_AXIS_BYTES
        + (uint64_t)volumetrics * AXCOMP_VOLUMETRIC_BYTES + (uint64_t)numbers * 8u;
    if (axes > AXES || volumetrics > VOLUMETRICS || numbers > INT32_MAX || expected != size) {
        return "it is truncated, or has bytes too many";
    }
    if (axcomp_crc32(0, data + 24, size - 24) != read_uint(data + 20, 4)) {
        return "it has been altered: its checksum does not fit";
    }
    const unsigned char *guid = data + 24, *said = data + 76;
    if (guid[GUID_LENGTH - 1] != 0) {
        return "its guid is too long";
    }
    if (said[SAID_LENGTH - 1] != 0) {
        return "the first error of its lists is too long";
    }

    Tables *tables = &lists->tables;
    double *pool = (double *)calloc(numbers + 1u, sizeof(double));
    lists->pool = pool;
    tables->axis = (AxisTable *)calloc(axes + 1u, sizeof(AxisTable));
    tables->volumetric = (VolumetricTable *)calloc(volumetrics + 1u, sizeof(VolumetricTable));
    if (pool == NULL || tables->axis == NULL || tables->volumetric == NULL) {
        return "there is no memory for it";
    }
    const unsigned char *from = data + HEADER_LENGTH;
    for (uint32_t i = 0; i < axes; i++) {
        from = read_record(from, axcomp_axis_parts, &tables->axis[i]);
    }
    for (uint32_t k = 0; k < volumetrics; k++) {
        from = read_record(from, axcomp_volumetric_parts, &tables->volumetric[k]);
    }
    for (uint32_t n = 0; n < numbers; n++) {
        pool[n] = read_double(from + 8u * n);
    }
    tables->cycle_time = read_double(data + 64);
    tables->axis_count = (int32_t)axes;
    tables->volumetrics = (int32_t)volumetrics;
    lists->numbers = (int32_t)numbers;
    lists->identity = read_uint(data + 20, 4);
    lists->found = read_uint(data + 72, 2);
    lists->real_only = read_uint(data + 74, 2) != 0;
    memcpy(lists->guid, guid, sizeof lists->guid);
    memcpy(lists->said, said, sizeof lists->said);
    return axcomp_tables_fit(tables, pool, lists->numbers) ? NULL : "its tables contradict themselves";
}
