/* rehearsal.h - the folder in which an import is tried before it replaces an earlier one. */
#ifndef RT_DSL_IMPORT_REHEARSAL_H
#define RT_DSL_IMPORT_REHEARSAL_H

#include "rt.h"

/* room.rts: the folder .room.rts.import beside it; of a long name its first 200 bytes. */
typedef struct import_rehearsal {
    char *folder;
    char *scene, *files; /* .room.rts.import/room.rts and .room.rts.import/room_files */
} import_rehearsal;

/* Whether there is a scene `out`, or a folder of its meshes and images. */
int rt_import_is_there(const char *out);

/* Makes the folder, or empties the one that a killed import left. */
rt_status rt_import_rehearsal_begin(import_rehearsal *out, const char *scene, rt_error *error);

/* Makes one in this folder; NULL: in /tmp. */
rt_status rt_import_rehearsal_elsewhere(import_rehearsal *out, const char *folder, rt_error *error);

/* Removes the folder. */
void rt_import_rehearsal_end(import_rehearsal *rehearsal);

#endif
