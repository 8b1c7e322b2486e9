/* scratch.h - a temporary directory for a test, the current one while it lasts. */
#ifndef RT_TESTS_IMAGE_SCRATCH_H
#define RT_TESTS_IMAGE_SCRATCH_H

#include <stddef.h>

/* cmocka setup and teardown: makes an empty directory and enters it; leaves and removes it. */
int scratch_enter(void **state);
int scratch_leave(void **state);

/*
 * Gives up the superuser's rights, if the test has them, until scratch_take_rights or
 * scratch_leave. A test that writes to a device does so first: code that is wrong could replace the
 * device. Where the rights cannot be given up, the test counts as skipped.
 */
void scratch_drop_rights(void);
void scratch_take_rights(void);

/* How many entries the current directory has, hidden ones too. */
size_t scratch_count(void);

/* The text of a file, to be freed. Fails the test where there is none. */
char *scratch_read(const char *name);

/* Makes a file of these bytes, or of this text; scratch_expect: checks that it has this text. */
void scratch_write_bytes(const char *name, const void *bytes, size_t size);
void scratch_write(const char *name, const char *text);
void scratch_expect(const char *name, const char *text);

#endif
