/*
 * findings.h - inputs that once broke a promise, kept as text in tests/fuzz/findings/TARGET/.
 *
 * A file NAME.txt is the input itself. A file NAME.hex holds its bytes as pairs of hexadecimal
 * digits; white space means nothing, and # begins a comment.
 */
#ifndef RT_TESTS_FUZZ_FINDINGS_H
#define RT_TESTS_FUZZ_FINDINGS_H

#include "fuzz/fuzz.h"

/* Adds all findings of a target; called in the top directory of the sources. */
void fuzz_findings_read(fuzz_inputs *out, const char *target);

#endif
