/*
 * exr_core.h - includes OpenEXRCore, and collects its error messages, which it would print
 * otherwise.
 */
#ifndef RT_LIB_IMAGE_EXR_CORE_H
#define RT_LIB_IMAGE_EXR_CORE_H

/* The header uses unnamed members, which C99 does not know and every compiler accepts. */
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#include <openexr.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

/* The first error message, or empty. */
typedef struct rt_exr_message {
    char text[256];
} rt_exr_message;

/* An error handler for a context whose user data begins with an rt_exr_message. */
void rt_exr_on_error(exr_const_context_t context, exr_result_t code, const char *text);

/* The error message, or else the meaning of the code. */
const char *rt_exr_reason(const rt_exr_message *message, exr_result_t code);

#endif
