/* ledger.h - the energy ledger as text. */
#ifndef RTC_LEDGER_H
#define RTC_LEDGER_H

#include "rt.h"

/* Prints the rows of a ledger and their sum on stdout: means of the three channels, in W. */
void ledger_print(const rt_light_ledger *rows, size_t count);

/* Prints ,"ledger":[...] with all rows. */
void ledger_print_json(const rt_light_ledger *rows, size_t count);

/* Prints for each light where two ledgers differ how they do, as means of the three channels. */
void ledger_print_difference(const rt_light_ledger *a, const rt_light_ledger *b, size_t count);

#endif
