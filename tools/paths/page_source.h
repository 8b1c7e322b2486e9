/* page_source.h - page.html, as the build embeds it. */
#ifndef RTC_PATHS_PAGE_SOURCE_H
#define RTC_PATHS_PAGE_SOURCE_H

#include <stddef.h>

extern const unsigned char paths_page[];
extern const size_t paths_page_size;

#endif
