/* Images of tables: checked, then copied into the kernel's records. */
#include "image.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"

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
    lists->real_only = header.real_only != 0;
    memcpy(lists->said, header.said, sizeof lists->said);
    return axcomp_tables_fit(tables, lists->pool, lists->numbers) ? NULL : "its tables contradict themselves";
}
