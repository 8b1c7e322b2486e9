/* scratch.c - makes, fills and removes a temporary directory. */
#include "scratch.h"

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#define NOBODY 65534

/* What scratch_leave needs to go back. */
typedef struct scratch {
    char path[PATH_MAX];
    int previous; /* descriptor of the directory before */
} scratch;

int scratch_enter(void **state)
{
    const char *base = getenv("TMPDIR");
    scratch *s = calloc(1, sizeof *s);
    if (!s)
        return -1;
    s->previous = open(".", O_RDONLY);
    snprintf(s->path, sizeof s->path, "%s/rt-test-XXXXXX", base && base[0] ? base : "/tmp");
    /* Open to all, so that a test without rights can still name files in it. */
    if (s->previous < 0 || !mkdtemp(s->path) || chdir(s->path) != 0 || chmod(".", 0755) != 0) {
        free(s);
        return -1;
    }
    *state = s;
    return 0;
}

void scratch_drop_rights(void)
{
    /* A container may know no other user. */
    if (geteuid() == 0 && seteuid(NOBODY) != 0)
        skip();
}

void scratch_take_rights(void)
{
    assert_int_equal(seteuid(getuid()), 0);
}

static int is_entry(const struct dirent *entry)
{
    return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
}

/* Removes what a directory holds, folders too, but follows no link; -1 where it is none. */
static int empty(int at, const char *name)
{
    const int descriptor = openat(at, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW);
    DIR *directory = descriptor >= 0 ? fdopendir(descriptor) : NULL;
    if (!directory)
        return -1;
    for (struct dirent *entry; (entry = readdir(directory));)
        if (is_entry(entry) && unlinkat(descriptor, entry->d_name, 0) != 0 &&
            empty(descriptor, entry->d_name) == 0)
            unlinkat(descriptor, entry->d_name, AT_REMOVEDIR);
    closedir(directory);
    return 0;
}

int scratch_leave(void **state)
{
    scratch *s = *state;
    scratch_take_rights();
    if (empty(AT_FDCWD, ".") != 0)
        return -1;
    int code = fchdir(s->previous) == 0 && rmdir(s->path) == 0 ? 0 : -1;
    close(s->previous);
    free(s);
    return code;
}

size_t scratch_count(void)
{
    size_t count = 0;
    DIR *directory = opendir(".");
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));)
        count += is_entry(entry) ? 1 : 0;
    closedir(directory);
    return count;
}

char *scratch_read(const char *name)
{
    FILE *file = fopen(name, "rb");
    if (!file)
        fail_msg("there is no %s", name);
    char *text = NULL;
    size_t size = 0;
    if (getdelim(&text, &size, '\0', file) < 0) {
        assert_true(feof(file));
        free(text);
        text = calloc(1, 1); /* an empty file */
    }
    fclose(file);
    assert_non_null(text);
    return text;
}

void scratch_write_bytes(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void scratch_write(const char *name, const char *text)
{
    scratch_write_bytes(name, text, strlen(text));
}

void scratch_expect(const char *name, const char *text)
{
    char *found = scratch_read(name);
    assert_string_equal(found, text);
    free(found);
}
