/* light_shares.c - reads the option --light-shares. */
#include "light_shares.h"

#include <stdlib.h>
#include <string.h>

#include "message.h"
#include "number.h"
#include "status.h"

#define SHARE_MAX 1e15

/* Whether text is such a list; then its numbers, of which there are no more than characters. */
static int read_list(float *shares, size_t *count, char *text)
{
    for (char *at = text, *comma; at; at = comma ? comma + 1 : NULL) {
        double share = 0;
        comma = strchr(at, ',');
        if (comma)
            *comma = '\0';
        if (number_real(&share, at) != 0 || share < 0 || share > SHARE_MAX)
            return 0;
        shares[(*count)++] = (float)share;
    }
    return 1;
}

int light_shares_read(float **out, size_t *count, const command_line *arguments)
{
    const option_value *value = &arguments->options[OPTION_LIGHT_SHARES];
    int status = STATUS_DONE;
    *count = 0;
    if (!value->given)
        return STATUS_DONE;
    size_t size = strlen(value->text) + 1;
    char *text = malloc(size);
    float *shares = calloc(size, sizeof *shares);
    if (!text || !shares) {
        message_error("out of memory");
        status = STATUS_DEVICE;
    } else if (!read_list(shares, count, memcpy(text, value->text, size))) {
        message_error("--light-shares takes a number from 0 to %g for each light, with commas "
                      "between them, as in "
                      "1,0.5,2; not '%s'",
                      SHARE_MAX, value->text);
        status = STATUS_USAGE;
    }
    if (status == STATUS_DONE)
        *out = shares;
    else
        free(shares);
    free(text);
    return status;
}
