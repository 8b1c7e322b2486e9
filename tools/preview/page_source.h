/* page_source.h - page.html, as the build embeds it. */
#ifndef RTC_PREVIEW_PAGE_SOURCE_H
#define RTC_PREVIEW_PAGE_SOURCE_H

#include <stddef.h>

extern const unsigned char preview_page_source[];
extern const size_t preview_page_source_size;

#endif
