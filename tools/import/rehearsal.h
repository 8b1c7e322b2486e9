/* rehearsal.h - the folder in which an import is tried before it replaces an earlier one. */
#ifndef RTC_IMPORT_REHEARSAL_H
#define RTC_IMPORT_REHEARSAL_H

/* room.rts: the folder .room.rts.import beside it; of a long name its first 200 bytes. */
typedef struct import_rehearsal {
    char *folder;
    char *scene, *files; /* .room.rts.import/room.rts and .room.rts.import/room_files */
} import_rehearsal;

/* Whether there is a scene `out`, or a folder of its meshes and images. */
int import_is_there(const char *out);

/* Makes the folder, or empties the one that a killed import left. Returns a status. */
int import_rehearsal_begin(import_rehearsal *out, const char *scene);

/* Makes one in the folder for temporary files. Returns a status; it is there on STATUS_DONE. */
int import_rehearsal_elsewhere(import_rehearsal *out);

/* Removes the folder. */
void import_rehearsal_end(import_rehearsal *rehearsal);

#endif
