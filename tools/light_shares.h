/* light_shares.h - the option --light-shares: what part of the photon paths each light gets. */
#ifndef RTC_LIGHT_SHARES_H
#define RTC_LIGHT_SHARES_H

#include <stddef.h>

#include "options.h"

/*
 * Reads "A,B,..."; *out stays NULL when the option is not given. Says what is wrong with it and
 * returns the exit status. The caller frees *out.
 */
int light_shares_read(float **out, size_t *count, const command_line *arguments);

#endif
