/* Files that belong to an FMU: where the host says they are. */
#ifndef AXCOMP_RESOURCE_H
#define AXCOMP_RESOURCE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { PATH_LENGTH = 4096 };

/* Turn a file URI (percent-encoded, any number of slashes) or a plain path into a path in UTF-8, with `file` behind it
 * unless that is NULL. Returns 0 if it does not fit into PATH_LENGTH bytes. */
int axcomp_path_of(const char *location, const char *file, char *path);

/* Put the path of a file in the resources into `path` for a library that lies in binaries/<platform> beside them.
 * Returns 0 if the system does not tell where the library is. */
int axcomp_path_beside_library(const char *file, char *path);

/* Read a whole file; its bytes are to be freed. Returns NULL if it cannot be read. */
unsigned char *axcomp_read_file(const char *path, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
