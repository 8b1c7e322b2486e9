/* metals.c - complex indices of refraction, measured spectra weighted to linear sRGB. */
#include "metals.h"

#include <string.h>

int metals_find(const char *name, double eta[3], double k[3])
{
    static const struct {
        const char *name;
        double eta[3], k[3];
    } metals[] = {
        {"Ag", {0.155276, 0.116728, 0.138388}, {4.828354, 3.122222, 2.146901}},
        {"Al", {1.657501, 0.880405, 0.521244}, {9.223811, 6.269502, 4.837004}},
        {"Au", {0.143036, 0.375307, 1.442045}, {3.982997, 2.385557, 1.603359}},
        {"Cr", {4.369668, 2.916503, 1.654905}, {5.206547, 4.231306, 3.754699}},
        {"Cu", {0.201005, 0.923750, 1.102215}, {3.913262, 2.453045, 2.142090}},
        {"Mo", {4.483974, 3.525131, 2.776310}, {4.111437, 3.420827, 3.150607}},
        {"W", {4.370817, 3.300246, 2.998407}, {3.500641, 2.604874, 2.273233}},
    };
    for (size_t i = 0; i < sizeof metals / sizeof *metals; i++)
        if (strcmp(name, metals[i].name) == 0) {
            memcpy(eta, metals[i].eta, sizeof metals[i].eta);
            memcpy(k, metals[i].k, sizeof metals[i].k);
            return 1;
        }
    return 0;
}
