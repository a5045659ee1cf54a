/* Tables read from images, which instances share. */
#ifndef AXCOMP_LISTS_H
#define AXCOMP_LISTS_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Share lists that have just been read: returns the equal ones that another instance uses already, or these. */
const Lists *axcomp_share_lists(Lists *lists);

/* An instance does not use shared lists any more, NULL: it never has. */
void axcomp_release_lists(const Lists *lists);

#ifdef __cplusplus
}
#endif

#endif
