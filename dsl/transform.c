/* transform.c - multiplies the steps of a transform. */
#include "dsl/transform.h"

#include <math.h>
#include <string.h>

#include "dsl/function.h"

void rt_steps_begin(rt_steps *steps)
{
    memset(steps, 0, sizeof *steps);
    for (int i = 0; i < 3; i++)
        steps->m[i][i] = 1;
}

/* Rotation by the right hand about an axis through the origin (Rodrigues). */
static void rotation(double out[3][4], const double axis[3], double degrees)
{
    double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    double s = rt_sine(degrees), c = rt_cosine(degrees), n[3];
    for (int i = 0; i < 3; i++)
        n[i] = axis[i] / length;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = (1 - c) * n[i] * n[j] + (i == j ? c : 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[k][j] += s * n[i];
        out[j][k] -= s * n[i];
    }
}

/* The map of one step. */
static void step(double out[3][4], rt_field_type type, const double *numbers)
{
    memset(out, 0, 12 * sizeof **out);
    for (int i = 0; i < 3; i++)
        out[i][i] = type == RT_FIELD_SCALE ? numbers[i] : 1;
    if (type == RT_FIELD_ROTATE)
        rotation(out, numbers, numbers[3]);
    else if (type == RT_FIELD_MATRIX)
        memcpy(out, numbers, 12 * sizeof **out);
    for (int i = 0; i < 3 && type == RT_FIELD_TRANSLATE; i++)
        out[i][3] = numbers[i];
}

void rt_steps_add(rt_steps *steps, rt_field_type type, const double *numbers)
{
    double a[3][4], before[3][4];
    step(a, type, numbers);
    memcpy(before, steps->m, sizeof before);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            steps->m[i][j] = j == 3 ? a[i][3] : 0;
            for (int k = 0; k < 3; k++)
                steps->m[i][j] += a[i][k] * before[k][j];
        }
    steps->count++;
}
