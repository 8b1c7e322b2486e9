/* function.c - the functions of arithmetic, by name. */
#include "dsl/function.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

double rt_sine(double degrees)
{
    double x = fmod(degrees, 360);
    if (fmod(x, 90) == 0) {
        static const double quarters[] = {0, 1, 0, -1};
        return quarters[((int)(x / 90) + 4) % 4];
    }
    return sin(x * pi / 180);
}

double rt_cosine(double degrees)
{
    return rt_sine(fmod(degrees, 360) + 90);
}

static double sine(const double *a)
{
    return rt_sine(a[0]);
}

static double cosine(const double *a)
{
    return rt_cosine(a[0]);
}

static double tangent(const double *a)
{
    return rt_sine(a[0]) / rt_cosine(a[0]);
}

static double arc_sine(const double *a)
{
    return asin(a[0]) * 180 / pi;
}

static double arc_cosine(const double *a)
{
    return acos(a[0]) * 180 / pi;
}

static double arc_tangent(const double *a)
{
    return atan(a[0]) * 180 / pi;
}

static double angle_of(const double *a)
{
    return atan2(a[0], a[1]) * 180 / pi;
}

static double root(const double *a)
{
    return sqrt(a[0]);
}

static double magnitude(const double *a)
{
    return fabs(a[0]);
}

static double least(const double *a)
{
    return fmin(a[0], a[1]);
}

static double greatest(const double *a)
{
    return fmax(a[0], a[1]);
}

static double down(const double *a)
{
    return floor(a[0]);
}

static double up(const double *a)
{
    return ceil(a[0]);
}

static double nearest(const double *a)
{
    return floor(a[0] + 0.5);
}

static double sign(const double *a)
{
    return a[0] > 0 ? 1 : a[0] < 0 ? -1 : 0;
}

/* What is left of a when the largest whole multiple of b is taken away; on the side of b. */
static double remainder_of(const double *a)
{
    return a[0] - a[1] * floor(a[0] / a[1]);
}

static double power(const double *a)
{
    return pow(a[0], a[1]);
}

static double exponential(const double *a)
{
    return exp(a[0]);
}

static double logarithm(const double *a)
{
    return log(a[0]);
}

/*
 * A number in [0, 1) that looks random but is the same for the same a: the mixer of SplitMix64
 * (Steele et al. 2014).
 */
static double scatter(const double *a)
{
    uint64_t x;
    double number = a[0] + 0.0; /* -0 is 0 */
    memcpy(&x, &number, sizeof x);
    x += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
    return (double)((x ^ x >> 31) >> 11) * 0x1p-53;
}

const rt_function rt_functions[RT_FUNCTION_COUNT] = {
    {"sin", 1, sine},         {"cos", 1, cosine},      {"tan", 1, tangent},
    {"asin", 1, arc_sine},    {"acos", 1, arc_cosine}, {"atan", 1, arc_tangent},
    {"atan2", 2, angle_of},   {"sqrt", 1, root},       {"abs", 1, magnitude},
    {"sign", 1, sign},        {"min", 2, least},       {"max", 2, greatest},
    {"floor", 1, down},       {"ceil", 1, up},         {"round", 1, nearest},
    {"mod", 2, remainder_of}, {"pow", 2, power},       {"exp", 1, exponential},
    {"log", 1, logarithm},    {"random", 1, scatter},
};

int rt_function_find(rt_text name)
{
    for (int i = 0; i < RT_FUNCTION_COUNT; i++)
        if (rt_text_equal(name, rt_functions[i].name))
            return i;
    return -1;
}

void rt_suggestion_offer_functions(rt_suggestion *suggestion)
{
    for (int i = 0; i < RT_FUNCTION_COUNT; i++)
        rt_suggestion_offer_word(suggestion, rt_functions[i].name);
}
