/*
 * spectrum.c - spectra by wavelength as colours in linear sRGB.
 *
 * X = sum S(w) x(w) and so on, with the observer x, y, z of CIE 1931 (2 degrees), and from there to
 * the primaries of IEC 61966-2-1. A reflectance is seen under D65, the white of sRGB, so that an
 * even one is grey. An emission is seen as it is; an even one has the colour of X = Y = Z.
 */
#include "dsl/import/spectrum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST = 360, STEP = 5, ROWS = 95, PARTS = 10, POINTS_MAX = 1000000 };

/* x, y and z of the observer, and the illuminant D65 (CIE 15:2004, tables T.4 and T.1). */
static const double table[ROWS][4] = {{0.0001299, 3.917e-06, 0.0006061, 46.6383},
                                      {0.0002321, 6.965e-06, 0.001086, 49.3637},
                                      {0.0004149, 1.239e-05, 0.001946, 52.0891},
                                      {0.0007416, 2.202e-05, 0.003486, 51.0323},
                                      {0.001368, 3.9e-05, 0.006450001, 49.9755},
                                      {0.002236, 6.4e-05, 0.01054999, 52.3118},
                                      {0.004243, 0.00012, 0.02005001, 54.6482},
                                      {0.00765, 0.000217, 0.03621, 68.7015},
                                      {0.01431, 0.000396, 0.06785001, 82.7549},
                                      {0.02319, 0.00064, 0.1102, 87.1204},
                                      {0.04351, 0.00121, 0.2074, 91.486},
                                      {0.07763, 0.00218, 0.3713, 92.4589},
                                      {0.13438, 0.004, 0.6456, 93.4318},
                                      {0.21477, 0.0073, 1.0390501, 90.057},
                                      {0.2839, 0.0116, 1.3856, 86.6823},
                                      {0.3285, 0.01684, 1.62296, 95.7736},
                                      {0.34828, 0.023, 1.74706, 104.865},
                                      {0.34806, 0.0298, 1.7826, 110.936},
                                      {0.3362, 0.038, 1.77211, 117.008},
                                      {0.3187, 0.048, 1.7441, 117.41},
                                      {0.2908, 0.06, 1.6692, 117.812},
                                      {0.2511, 0.0739, 1.5281, 116.336},
                                      {0.19536, 0.09098, 1.28764, 114.861},
                                      {0.1421, 0.1126, 1.0419, 115.392},
                                      {0.09564, 0.13902, 0.8129501, 115.923},
                                      {0.05795001, 0.1693, 0.6162, 112.367},
                                      {0.03201, 0.20802, 0.46518, 108.811},
                                      {0.0147, 0.2586, 0.3533, 109.082},
                                      {0.0049, 0.323, 0.272, 109.354},
                                      {0.0024, 0.4073, 0.2123, 108.578},
                                      {0.0093, 0.503, 0.1582, 107.802},
                                      {0.0291, 0.6082, 0.1117, 106.296},
                                      {0.06327, 0.71, 0.07824999, 104.79},
                                      {0.1096, 0.7932, 0.05725001, 106.239},
                                      {0.1655, 0.862, 0.04216, 107.689},
                                      {0.2257499, 0.9148501, 0.02984, 106.047},
                                      {0.2904, 0.954, 0.0203, 104.405},
                                      {0.3597, 0.9803, 0.0134, 104.225},
                                      {0.4334499, 0.9949501, 0.008749999, 104.046},
                                      {0.5120501, 1, 0.005749999, 102.023},
                                      {0.5945, 0.995, 0.0039, 100},
                                      {0.6784, 0.9786, 0.002749999, 98.1671},
                                      {0.7621, 0.952, 0.0021, 96.3342},
                                      {0.8425, 0.9154, 0.0018, 96.0611},
                                      {0.9163, 0.87, 0.001650001, 95.788},
                                      {0.9786, 0.8163, 0.0014, 92.2368},
                                      {1.0263, 0.757, 0.0011, 88.6856},
                                      {1.0567, 0.6949, 0.001, 89.3459},
                                      {1.0622, 0.631, 0.0008, 90.0062},
                                      {1.0456, 0.5668, 0.0006, 89.8026},
                                      {1.0026, 0.503, 0.00034, 89.5991},
                                      {0.9384, 0.4412, 0.00024, 88.6489},
                                      {0.8544499, 0.381, 0.00019, 87.6987},
                                      {0.7514, 0.321, 0.0001, 85.4936},
                                      {0.6424, 0.265, 4.999999e-05, 83.2886},
                                      {0.5419, 0.217, 3e-05, 83.4939},
                                      {0.4479, 0.175, 2e-05, 83.6992},
                                      {0.3608, 0.1382, 1e-05, 81.863},
                                      {0.2835, 0.107, 0, 80.0268},
                                      {0.2187, 0.0816, 0, 80.1207},
                                      {0.1649, 0.061, 0, 80.2146},
                                      {0.1212, 0.04458, 0, 81.2462},
                                      {0.0874, 0.032, 0, 82.2778},
                                      {0.0636, 0.0232, 0, 80.281},
                                      {0.04677, 0.017, 0, 78.2842},
                                      {0.0329, 0.01192, 0, 74.0027},
                                      {0.0227, 0.00821, 0, 69.7213},
                                      {0.01584, 0.005723, 0, 70.6652},
                                      {0.01135916, 0.004102, 0, 71.6091},
                                      {0.008110916, 0.002929, 0, 72.979},
                                      {0.005790346, 0.002091, 0, 74.349},
                                      {0.004109457, 0.001484, 0, 67.9765},
                                      {0.002899327, 0.001047, 0, 61.604},
                                      {0.00204919, 0.00074, 0, 65.7448},
                                      {0.001439971, 0.00052, 0, 69.8856},
                                      {0.0009999493, 0.0003611, 0, 72.4863},
                                      {0.0006900786, 0.0002492, 0, 75.087},
                                      {0.0004760213, 0.0001719, 0, 69.3398},
                                      {0.0003323011, 0.00012, 0, 63.5927},
                                      {0.0002348261, 8.48e-05, 0, 55.0054},
                                      {0.0001661505, 6e-05, 0, 46.4182},
                                      {0.000117413, 4.24e-05, 0, 56.6118},
                                      {8.307527e-05, 3e-05, 0, 66.8054},
                                      {5.870652e-05, 2.12e-05, 0, 65.0941},
                                      {4.150994e-05, 1.499e-05, 0, 63.3828},
                                      {2.935326e-05, 1.06e-05, 0, 63.8434},
                                      {2.067383e-05, 7.4657e-06, 0, 64.304},
                                      {1.455977e-05, 5.2578e-06, 0, 61.8779},
                                      {1.025398e-05, 3.7029e-06, 0, 59.4519},
                                      {7.221456e-06, 2.6078e-06, 0, 55.7054},
                                      {5.085868e-06, 1.8366e-06, 0, 51.959},
                                      {3.581652e-06, 1.2934e-06, 0, 54.6998},
                                      {2.522525e-06, 9.1093e-07, 0, 57.4406},
                                      {1.776509e-06, 6.4153e-07, 0, 58.8765},
                                      {1.251141e-06, 4.5181e-07, 0, 60.3125}};

/* ---- The points of a spectrum ------------------------------------------------ */

int rt_spectrum_add(importer *import, int line, spectrum *out, double wavelength, double value)
{
    if (out->count > 0 && !(wavelength > out->wavelengths[out->count - 1]))
        return rt_import_fail(import, line, "the wavelengths of a spectrum do not rise at %g",
                              wavelength);
    if (out->count == POINTS_MAX)
        return rt_import_fail(import, line, "a spectrum of more than %d values", POINTS_MAX);
    if ((out->count & (out->count - 1)) == 0) {
        const size_t room = out->count ? 2 * out->count : 1;
        double *wavelengths = realloc(out->wavelengths, room * sizeof *wavelengths);
        out->wavelengths = wavelengths ? wavelengths : out->wavelengths;
        double *values = realloc(out->values, room * sizeof *values);
        out->values = values ? values : out->values;
        if (!wavelengths || !values)
            return rt_import_fail_memory(import);
    }
    out->wavelengths[out->count] = wavelength;
    out->values[out->count++] = value;
    return 1;
}

int rt_spectrum_read(importer *import, int line, spectrum *out, const char *text)
{
    double wavelength, value;
    for (const char *at = text;;) {
        while (*(at += strspn(at, " \t\r\n,")) == '#')
            at += strcspn(at, "\n");
        if (!*at)
            break;
        int is_pair = rt_import_number(&wavelength, &at);
        at += strspn(at, " \t:");
        is_pair = is_pair && rt_import_number(&value, &at);
        if (!is_pair)
            return rt_import_fail(import, line, "'%.60s': expected wavelength:value pairs", at);
        if (!rt_spectrum_add(import, line, out, wavelength, value))
            return 0;
    }
    return out->count > 0 || rt_import_fail(import, line, "a spectrum without values");
}

int rt_spectrum_read_file(importer *import, int line, spectrum *out, const char *name)
{
    size_t size;
    char *text = rt_import_read_text(import, line, name, &size);
    const int is_read = text && rt_spectrum_read(import, line, out, text);
    free(text);
    return is_read;
}

void rt_spectrum_free(spectrum *s)
{
    free(s->wavelengths);
    free(s->values);
}

/* ---- Colours ----------------------------------------------------------------- */

/* Straight between the points, nothing outside of them; *i: the point before, to go on from. */
static double value_at(const spectrum *s, double wavelength, size_t *i)
{
    const double *w = s->wavelengths;
    if (wavelength < w[0] || wavelength > w[s->count - 1])
        return 0;
    while (*i + 2 < s->count && w[*i + 1] < wavelength)
        ++*i;
    if (s->count == 1)
        return s->values[0];
    const double t = (wavelength - w[*i]) / (w[*i + 1] - w[*i]);
    return s->values[*i] + t * (s->values[*i + 1] - s->values[*i]);
}

/* X, Y and Z, of a spectrum or a black body, by the sum over the visible wavelengths. */
static void add_up(double xyz[3], const spectrum *s, double kelvin, spectrum_use use)
{
    /* c1 and c2 of Planck's law for W/(m^2 sr nm), 2 h c^2 and h c / k with wavelengths in nm */
    const double c1 = 1.1910429724e20, c2 = 1.438776877e7;
    double white = 0;
    size_t from = 0;
    xyz[0] = xyz[1] = xyz[2] = 0;
    for (int i = 0; i <= (ROWS - 1) * PARTS; i++) {
        const int row = i / PARTS < ROWS - 1 ? i / PARTS : ROWS - 2;
        const double t = (double)i / PARTS - row, w = FIRST + (double)i * STEP / PARTS;
        double at[4], value;
        for (int c = 0; c < 4; c++)
            at[c] = table[row][c] + t * (table[row + 1][c] - table[row][c]);
        value = s ? value_at(s, w, &from) : c1 / (pow(w, 5) * expm1(c2 / (w * kelvin)));
        const double light = use == SPECTRUM_EMISSION ? 1 : at[3];
        white += light * at[1];
        for (int c = 0; c < 3; c++)
            xyz[c] += light * value * at[c];
    }
    for (int c = 0; c < 3; c++)
        xyz[c] /= white;
}

static void to_rgb(double out[3], const double xyz[3])
{
    static const double m[3][3] = {{3.2404541621, -1.5371385128, -0.4985314096},
                                   {-0.9692660305, 1.8760108454, 0.0415560175},
                                   {0.0556434310, -0.2040259135, 1.0572251882}};
    for (int c = 0; c < 3; c++)
        out[c] = rt_vector_dot(m[c], xyz);
}

double rt_spectrum_luminance(const double rgb[3])
{
    static const double weights[3] = {0.2126729, 0.7151522, 0.0721750};
    return rt_vector_dot(weights, rgb);
}

void rt_spectrum_colour(importer *import, int line, const spectrum *s, spectrum_use use,
                        double out[3])
{
    double xyz[3];
    int is_outside = 0;
    if (s->count == 1)
        rt_import_note_at(import, line,
                          "a spectrum of one wavelength, %g nm, is all but black: two or more are "
                          "expected",
                          s->wavelengths[0]);
    if (s->wavelengths[s->count - 1] < FIRST || s->wavelengths[0] > FIRST + (ROWS - 1) * STEP)
        rt_import_note_at(
            import, line,
            "a spectrum from %g to %g nm has no light that is seen, which is of %d to "
            "%d nm: it is black",
            s->wavelengths[0], s->wavelengths[s->count - 1], (int)FIRST,
            (int)(FIRST + (ROWS - 1) * STEP));
    add_up(xyz, s, 0, use);
    to_rgb(out, xyz);
    for (int c = 0; c < 3; c++) {
        const double most = use == SPECTRUM_REFLECTANCE ? 1 : HUGE_VAL,
                     made = fmin(fmax(out[c], 0), most);
        is_outside |= fabs(made - out[c]) > 0.005 * fmax(1, xyz[1]);
        out[c] = made;
    }
    if (is_outside)
        rt_import_note_at(import, line,
                          "a spectrum has a colour that sRGB lacks: the nearest is taken");
}

void rt_spectrum_black_body(double kelvin, double out[3])
{
    double xyz[3];
    add_up(xyz, NULL, kelvin, SPECTRUM_EMISSION);
    to_rgb(out, xyz);
    for (int c = 0; c < 3; c++)
        out[c] = fmax(out[c], 0);
}

double rt_import_decode_srgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

double rt_import_encode_srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}
