/* ledger_file.c - a row of the energy ledger, written and read. */
#include "photon/ledger_file.h"

#include <math.h>

void rt_ledger_put(rt_writer *w, const rt_ledger_row *row)
{
    rt_put32(w, row->shape);
    rt_put32(w, (uint32_t)row->exponent);
    rt_put64(w, row->paths);
    for (int c = 0; c < 3; c++)
        rt_put_double(w, row->power[c]);
    rt_put_double(w, row->share);
    for (int column = 0; column < RT_LEDGER_COLUMNS; column++)
        for (int c = 0; c < 3; c++)
            rt_put64(w, (uint64_t)row->sums[column][c]);
}

int rt_ledger_get(rt_reader *r, rt_ledger_row *row)
{
    row->shape = rt_get32(r);
    row->exponent = rt_get_signed32(r);
    row->paths = rt_get64(r);
    int sound = row->exponent >= -400 && row->exponent <= 400;
    for (int c = 0; c < 3; c++) {
        row->power[c] = rt_get_double(r);
        sound = sound && row->power[c] >= 0 && isfinite(row->power[c]);
    }
    row->share = rt_get_double(r);
    sound = sound && row->share >= 0 && row->share <= 1;
    for (int column = 0; column < RT_LEDGER_COLUMNS; column++)
        for (int c = 0; c < 3; c++)
            row->sums[column][c] = rt_get_signed64(r);
    return sound;
}
