/* byte_order_mark.c - what some editors begin a text with. */
#include <string.h>

#include "rt/field.h"

size_t rt_byte_order_mark(const void *text, size_t size)
{
    static const char mark[] = "\xef\xbb\xbf";
    const size_t length = sizeof mark - 1;
    return size >= length && memcmp(text, mark, length) == 0 ? length : 0;
}
