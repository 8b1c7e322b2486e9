/* page_source.h - page.html, as the build embeds it. */
#ifndef RTC_STUDY_PAGE_SOURCE_H
#define RTC_STUDY_PAGE_SOURCE_H

#include <stddef.h>

extern const unsigned char page_source[];
extern const size_t page_source_size;

#endif
