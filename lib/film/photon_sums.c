/* photon_sums.c - sums of photon layers, added. */
#include "film/photon_sums.h"

void rt_photon_sums_join(rt_photon_sums *sums, const rt_photon_sums *others, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++) {
        rt_photon_sums *sum = sums + i;
        const rt_photon_sums *other = others + i;
        sum->asked += other->asked;
        sum->photons += other->photons;
        sum->samples += other->samples;
        rt_exact_sum_join(&sum->radius, &other->radius);
        rt_exact_sum_join(&sum->density, &other->density);
        rt_exact_sum_join(&sum->value, &other->value);
        rt_exact_sum_join(&sum->square, &other->square);
        rt_exact_sum_join(&sum->bias, &other->bias);
    }
}
