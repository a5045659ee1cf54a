/* Images of tables: checked, then copied into the kernel's records. */
#include "image.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"

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

/* Whether the header promises exactly the bytes that are there. */
static bool size_fits(const ImageHeader *header, size_t size)
{
    if (header->axes > AXES || header->volumetrics > VOLUMETRICS || header->numbers > INT32_MAX) {
        return false;
    }
    uint64_t expected = sizeof *header + (uint64_t)header->axes * sizeof(AxisTable)
        + (uint64_t)header->volumetrics * sizeof(VolumetricTable) + (uint64_t)header->numbers * sizeof(double);
    return expected == size;
}

const char *axcomp_read_image(const unsigned char *data, size_t size, Lists *lists)
{
    ImageHeader header;
    memset(lists, 0, sizeof *lists);
    if (size < sizeof header) {
        return "it is truncated";
    }
    memcpy(&header, data, sizeof header);
    if (memcmp(header.magic, "AXCOMPT2", sizeof header.magic) != 0) {
        return "it is no image of axcomp's tables";
    }
    if (header.layout != AXCOMP_LAYOUT) {
        return "it belongs to another version of axcomp, or to another kind of processor";
    }
    if (!size_fits(&header, size)) {
        return "it is truncated, or has bytes too many";
    }
    size_t checked = offsetof(ImageHeader, check) + sizeof header.check;
    if (axcomp_crc32(0, data + checked, size - checked) != header.check) {
        return "it has been altered: its checksum does not fit";
    }
    if (header.guid[GUID_LENGTH - 1] != 0) {
        return "its guid is too long";
    }
    if (header.said[SAID_LENGTH - 1] != 0) {
        return "the first error of its lists is too long";
    }

    Tables *tables = &lists->tables;
    const unsigned char *from = data + sizeof header;
    memcpy(tables->axis, from, header.axes * sizeof(AxisTable));
    from += header.axes * sizeof(AxisTable);
    memcpy(tables->volumetric, from, header.volumetrics * sizeof(VolumetricTable));
    from += header.volumetrics * sizeof(VolumetricTable);
    lists->pool = (double *)calloc(header.numbers + 1u, sizeof(double));
    if (lists->pool == NULL) {
        return "there is no memory for it";
    }
    memcpy(lists->pool, from, header.numbers * sizeof(double));
    lists->cycle_time = tables->cycle_time = header.cycle_time;
    tables->axis_count = header.axes;
    tables->volumetrics = header.volumetrics;
    lists->numbers = (int32_t)header.numbers;
    lists->identity = header.check;
    memcpy(lists->guid, header.guid, sizeof lists->guid);
    lists->found = header.errors;
    memcpy(lists->said, header.said, sizeof lists->said);
    return axcomp_tables_fit(tables, lists->pool, lists->numbers) ? NULL : "its tables contradict themselves";
}
