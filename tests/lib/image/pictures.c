/* pictures.c - a texture, and copies of it with changes. */
#include "lib/image/pictures.h"

#include <math.h>

#include "support.h"

void expect_measure(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance))
        fail_msg("%.9g instead of %.9g", found, expected);
}

void picture_texture(float *rgb)
{
    for (size_t i = 0; i < VALUES; i++) {
        double x = (double)(i / 3 % WIDTH), y = (double)(i / 3 / WIDTH);
        rgb[i] = (float)(0.5 + 0.3 * sin(0.7 * x) * cos(0.4 * y) + 0.005 * x);
    }
}

void picture_changed(float *tint, float *dot, float *step)
{
    static const float factors[3] = {1.0f, 0.9f, 0.8f};
    picture_texture(tint);
    picture_texture(dot);
    picture_texture(step);
    for (size_t i = 0; i < VALUES; i++) {
        tint[i] *= factors[i % 3];
        dot[i] = i / 3 == 12 * WIDTH + 20 ? 1.0f : dot[i];
        step[i] *= i / 3 % WIDTH >= 25 ? 0.5f : 1.0f;
    }
}
