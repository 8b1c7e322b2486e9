/*
 * large_pages.h - asks the system for large pages.
 *
 * A page is cleared when it is first written to, which costs about a microsecond however small it
 * is; and a page of 2 MiB needs one entry of the translation cache.
 */
#ifndef RT_LIB_BASE_LARGE_PAGES_H
#define RT_LIB_BASE_LARGE_PAGES_H

#include <stddef.h>

/* Asks for them in a new block if it is large, before anything is written there; else nothing. */
void rt_prefer_large_pages(void *block, size_t bytes);

#endif
