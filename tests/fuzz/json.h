/* json.h - whether a text is JSON. */
#ifndef RT_TESTS_FUZZ_JSON_H
#define RT_TESTS_FUZZ_JSON_H

/* Whether every line of a text that is not empty is one JSON object (RFC 8259). */
int fuzz_is_json_lines(const char *text);

#endif
