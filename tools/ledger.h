/* ledger.h - the energy ledger as text. */
#ifndef RTC_LEDGER_H
#define RTC_LEDGER_H

#include "rt.h"

/* Prints the rows of a ledger and their sum on stdout: means of the three channels, in W. */
void ledger_print(const rt_light_ledger *rows, size_t count);

#endif
