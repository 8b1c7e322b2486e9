/* folder.h - the folder that a file is in. */
#ifndef RTC_FOLDER_H
#define RTC_FOLDER_H

/*
 * The folder of a file, the current one for "-", in a string to be freed; NULL, with a message,
 * without memory.
 */
char *folder_of(const char *path);

#endif
