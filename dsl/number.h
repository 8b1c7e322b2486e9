/* number.h - from the spelling of a number to its value, whatever the locale. */
#ifndef RT_DSL_NUMBER_H
#define RT_DSL_NUMBER_H

#include "dsl/source.h"

typedef enum rt_number_result {
    RT_NUMBER_OK,
    RT_NUMBER_MALFORMED, /* the text is no number of the language */
    RT_NUMBER_TOO_LARGE  /* its size is beyond double precision */
} rt_number_result;

/* Reads digits [. digits] [e [+-] digits], with at least one digit before the exponent. */
rt_number_result rt_number_read(double *out, rt_text text);

#endif
