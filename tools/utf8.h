/* utf8.h - text of unknown origin, such as names of files. */
#ifndef RTC_UTF8_H
#define RTC_UTF8_H

#include <stddef.h>

/* Bytes of the character at text, where `length` bytes are left; 0: it is none of UTF-8. */
size_t utf8_size(const char *text, size_t length);

#endif
