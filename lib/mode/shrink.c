/* shrink.c - the product of what each pass takes off the square of the radius. */
#include "mode/shrink.h"

double rt_shrink_after(rt_shrink *shrink, uint32_t passes, uint32_t pilot, double alpha)
{
    if (passes < shrink->passes || shrink->passes == 0)
        *shrink = (rt_shrink){0, 1};
    while (shrink->passes < passes) {
        shrink->passes++;
        shrink->factor *= (pilot + shrink->passes + alpha) / (pilot + shrink->passes + 1.0);
    }
    return shrink->factor;
}
