/* ledger_file.h - rows of the energy ledger in files; photon/map_file.h describes their bytes. */
#ifndef RT_LIB_PHOTON_LEDGER_FILE_H
#define RT_LIB_PHOTON_LEDGER_FILE_H

#include "base/wire.h"
#include "photon/ledger.h"

enum { RT_LEDGER_ROW_BYTES = 168 };

void rt_ledger_put(rt_writer *w, const rt_ledger_row *row);

/* Whether the row is in range. */
int rt_ledger_get(rt_reader *r, rt_ledger_row *row);

#endif
