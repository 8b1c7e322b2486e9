/*
 * daylight.c - sun and sky as an image of an environment.
 *
 * The sky is that of Hosek and Wilkie: radiance by the angles from straight above and from the sun,
 * with coefficients that turbidity and albedo interpolate and the elevation of the sun by a Bezier
 * curve of its cube root. The disc of the sun is even, and its pixels have the part of it that they
 * cover.
 */
#include "dsl/import/daylight.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/spectrum.h"

enum {
    ROWS_OF_SKY = 512,
    ROWS_OF_SUN = 1024,
    TURBIDITIES = 10,
    CONTROLS = 6,
    CONTROL = 30, /* numbers of a control point, of an albedo and of a turbidity */
    ALBEDO = CONTROLS * CONTROL,
    SKY = 2 * ALBEDO,
    ELEVATIONS = 30,
    POINTS = 8 /* of a pixel, along each side, where the disc of the sun may end */
};

static const double pi = IMPORT_PI, degree = IMPORT_PI / 180;

/* The aperture of the sun that the irradiances are of. */
static const double half_aperture = 0.5 * 0.5358 * IMPORT_PI / 180;

/* ---- Where the sun stands ---------------------------------------------------- */

void rt_daylight_sun_place(const daylight_time *when, double *zenith, double *azimuth)
{
    const double hours = when->hour - when->timezone + (when->minute + when->second / 60) / 60;
    const long shift = (when->month - 14) / 12;
    const long noon = 1461 * (when->year + 4800 + shift) / 4 +
                      367 * (when->month - 2 - 12 * shift) / 12 -
                      3 * ((when->year + 4900 + shift) / 100) / 4 + when->day - 32075;
    const double days = (double)noon - 0.5 + hours / 24 - 2451545; /* since noon, 1 January 2000 */
    const double omega = 2.1429 - 0.0010394594 * days,
                 longitude = 4.8950630 + 0.017202791698 * days,
                 anomaly = 6.2400600 + 0.0172019699 * days;
    const double ecliptic = longitude + 0.03341607 * sin(anomaly) + 0.00034894 * sin(2 * anomaly) -
                            0.0001134 - 0.0000203 * sin(omega),
                 obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * cos(omega);
    const double ascension = atan2(cos(obliquity) * sin(ecliptic), cos(ecliptic)),
                 declination = asin(sin(obliquity) * sin(ecliptic));
    const double sidereal = 6.6974243242 + 0.0657098283 * days + hours; /* at Greenwich, hours */
    const double angle = (sidereal * 15 + when->longitude) * degree - ascension,
                 latitude = when->latitude * degree;
    const double above =
        cos(latitude) * cos(angle) * cos(declination) + sin(declination) * sin(latitude);
    *zenith = acos(fmin(fmax(above, -1), 1));
    *azimuth = atan2(-sin(angle), tan(declination) * cos(latitude) - sin(latitude) * cos(angle));
    *zenith +=
        6371.01 / 149597890 * sin(*zenith); /* parallax: radius of the earth by the orbit's */
}

/* ---- The sun ----------------------------------------------------------------- */

/* The two rows of a table around a value, by the first of them and the share of the second. */
static int split(double value, int count, double *share)
{
    const double at = fmin(fmax(value, 0), count - 1);
    const int first = at < count - 2 ? (int)at : count - 2;
    *share = at - first;
    return first;
}

void rt_daylight_sun_irradiance(double turbidity, double zenith, double out[3])
{
    double s, t;
    const int i = split(turbidity - 1, TURBIDITIES, &s),
              k = split((90 - zenith / degree - 2) / 3, ELEVATIONS, &t);
    const double *const low = rt_daylight_sun + 3 * (ELEVATIONS * i + k), *const high =
                                                                              low + 3 * ELEVATIONS;
    for (int c = 0; c < 3; c++)
        out[c] = fmax((1 - s) * ((1 - t) * low[c] + t * low[3 + c]) +
                          s * ((1 - t) * high[c] + t * high[3 + c]),
                      0);
}

/* ---- The sun of Mitsuba 0.x -------------------------------------------------- */

/* Pairs of a wavelength in nanometres and a value there. */
typedef double pairs[][2];

/* Straight between the wavelengths, nothing outside of them. */
static double at_wavelength(const double (*table)[2], size_t count, double wavelength)
{
    for (size_t i = 1; i < count; i++)
        if (wavelength >= table[i - 1][0] && wavelength <= table[i][0]) {
            const double t = (wavelength - table[i - 1][0]) / (table[i][0] - table[i - 1][0]);
            return table[i - 1][1] + t * (table[i][1] - table[i - 1][1]);
        }
    return 0;
}

#define AT(table, wavelength) at_wavelength(table, sizeof table / sizeof *table, wavelength)

/*
 * What passes an air mass: Rayleigh scattering, aerosols of this turbidity, ozone of 0.35 cm, mixed
 * gases and 2 cm of water vapour. Appendix 1 of the paper, with its tables of absorption, per cm.
 */
static double transmittance(double wavelength, double mass, double turbidity)
{
    static const pairs ozone = {
        {300, 10},    {305, 4.8},   {310, 2.7},   {315, 1.35},  {320, 0.8},   {325, 0.38},
        {330, 0.16},  {335, 0.075}, {340, 0.04},  {345, 0.019}, {350, 0.007}, {355, 0},
        {445, 0.003}, {450, 0.003}, {455, 0.004}, {460, 0.006}, {465, 0.008}, {470, 0.009},
        {475, 0.012}, {480, 0.014}, {485, 0.017}, {490, 0.021}, {495, 0.025}, {500, 0.03},
        {505, 0.035}, {510, 0.04},  {515, 0.045}, {520, 0.048}, {525, 0.057}, {530, 0.063},
        {535, 0.07},  {540, 0.075}, {545, 0.08},  {550, 0.085}, {555, 0.095}, {560, 0.103},
        {565, 0.11},  {570, 0.12},  {575, 0.122}, {580, 0.12},  {585, 0.118}, {590, 0.115},
        {595, 0.12},  {600, 0.125}, {605, 0.13},  {610, 0.12},  {620, 0.105}, {630, 0.09},
        {640, 0.079}, {650, 0.067}, {660, 0.057}, {670, 0.048}, {680, 0.036}, {690, 0.028},
        {700, 0.023}, {710, 0.018}, {720, 0.014}, {730, 0.011}, {740, 0.01},  {750, 0.009},
        {760, 0.007}, {770, 0.004}, {780, 0},     {790, 0}};
    static const pairs gas = {{759, 0}, {760, 3}, {770, 0.21}, {771, 0}};
    static const pairs water = {{689, 0},     {690, 0.016}, {700, 0.024},  {710, 0.0125},
                                {720, 1},     {730, 0.87},  {740, 0.061},  {750, 0.001},
                                {760, 1e-05}, {770, 1e-05}, {780, 0.0006}, {790, 0.0175},
                                {800, 0.036}};
    const double micrometres = wavelength / 1000,
                 beta = 0.04608365822050 * turbidity - 0.04586025928522;
    const double gases = AT(gas, wavelength) * mass, vapour = AT(water, wavelength) * 2 * mass;
    const double depth =
        mass * 0.008735 * pow(micrometres, -4.08) + mass * beta * pow(micrometres, -1.3) +
        mass * 0.35 * AT(ozone, wavelength) + 1.41 * gases / pow(1 + 118.93 * gases, 0.45) +
        0.2385 * vapour / pow(1 + 20.07 * vapour, 0.45);
    return exp(-depth);
}

void rt_daylight_old_sun_irradiance(importer *import, int line, double turbidity, double zenith,
                                    double out[3])
{
    /* Outside of the air, W/(m^2 nm sr). */
    static const pairs radiance = {
        {380, 16559},   {390, 16233.7}, {400, 21127.5}, {410, 25888.2}, {420, 25829.1},
        {430, 24232.3}, {440, 26760.5}, {450, 29658.3}, {460, 30545.4}, {470, 30057.5},
        {480, 30663.7}, {490, 28830.4}, {500, 28712.1}, {510, 27825},   {520, 27100.6},
        {530, 27233.6}, {540, 26361.3}, {550, 25503.8}, {560, 25060.2}, {570, 25311.6},
        {580, 25355.9}, {590, 25134.2}, {600, 24631.5}, {610, 24173.2}, {620, 23685.3},
        {630, 23212.1}, {640, 22827.7}, {650, 22339.8}, {660, 21970.2}, {670, 21526.7},
        {680, 21097.9}, {690, 20728.3}, {700, 20240.4}, {710, 19870.8}, {720, 19427.2},
        {730, 19072.4}, {740, 18628.9}, {750, 18259.2}};
    const double solid_angle = 2 * pi * (1 - cos(half_aperture)), most = 0.4999 * pi,
                 angle = fmin(zenith, most);
    const double mass = 1 / (cos(angle) + 0.15 * pow(93.885 - angle / degree, -1.253));
    spectrum s = {NULL, NULL, 0};
    int is_read = 1;
    for (int w = 380; w <= 750 && is_read; w += 5)
        is_read = rt_spectrum_add(
            import, line, &s, w, AT(radiance, w) * transmittance(w, mass, turbidity) * solid_angle);
    out[0] = out[1] = out[2] = 0;
    if (is_read)
        rt_spectrum_colour(import, line, &s, SPECTRUM_EMISSION, out);
    rt_spectrum_free(&s);
}

/* ---- The sky ----------------------------------------------------------------- */

/* The coefficients of one sky, and its mean radiance. */
static void mix_coefficients(double out[3][10], const daylight *light)
{
    static const double binomial[CONTROLS] = {1, 5, 10, 10, 5, 1};
    double s;
    const int i = split(light->turbidity - 1, TURBIDITIES, &s);
    const double x = cbrt(1 - light->zenith / (pi / 2));
    memset(out, 0, 30 * sizeof(double));
    for (int k = 0; k < CONTROLS; k++) {
        const double weight = binomial[k] * pow(x, k) * pow(1 - x, CONTROLS - 1 - k);
        const double *const low = rt_daylight_sky + i * SKY + k * CONTROL, *const high = low + SKY;
        for (int n = 0; n < CONTROL; n++) {
            const double a = light->albedo[n / 10];
            out[n / 10][n % 10] += weight * ((1 - s) * ((1 - a) * low[n] + a * low[ALBEDO + n]) +
                                             s * ((1 - a) * high[n] + a * high[ALBEDO + n]));
        }
    }
}

/* Equation 8 of the paper, times the mean. */
static double sky_radiance(const double p[10], double cos_theta, double gamma)
{
    const double cos_gamma = cos(gamma), square = cos_gamma * cos_gamma;
    const double base = 1 + p[8] * p[8] - 2 * p[8] * cos_gamma,
                 chi = (1 + square) / (base * sqrt(base));
    return (1 + p[0] * exp(p[1] / (cos_theta + 0.01))) *
           (p[2] + p[3] * exp(p[4] * gamma) + p[5] * square + p[6] * chi + p[7] * sqrt(cos_theta)) *
           p[9];
}

/* At an angle from straight above and one from the sun's azimuth. */
static void sky_pixel(float rgb[3], const daylight *light, double p[3][10], double theta,
                      double azimuth)
{
    double angle = theta / light->stretch, fade = 1;
    if (light->extends) {
        const double t = fmin(fmax(2 - 2 * theta / pi, 0), 1);
        fade = t * t * (3 - 2 * t);
        angle = fmin(angle, pi / 2);
    }
    const double cos_theta = cos(angle);
    const double cos_gamma =
        cos_theta * cos(light->zenith) + sin(angle) * sin(light->zenith) * cos(azimuth);
    for (int c = 0; c < 3; c++)
        rgb[c] = angle > pi / 2 ? 0
                                : (float)fmax(light->sky_scale * fade *
                                                  sky_radiance(p[c], fmax(cos_theta, 0),
                                                               acos(fmin(fmax(cos_gamma, -1), 1))),
                                              0);
}

/* ---- The picture ------------------------------------------------------------- */

/* The part of a pixel that the disc of the sun covers. */
static double covered(double radius, double zenith, uint32_t x, uint32_t y, uint32_t rows)
{
    const double middle = pi * (y + 0.5) / rows, aside = pi * (x + 0.5) / rows - pi;
    const double cosine = cos(middle) * cos(zenith) + sin(middle) * sin(zenith) * cos(aside),
                 off = acos(fmin(fmax(cosine, -1), 1)) - radius, edge = cos(radius);
    int count = 0;
    if (fabs(off) > pi / rows)
        return off < 0;
    for (int k = 0; k < POINTS * POINTS; k++) {
        const double theta = pi * (y + (k / POINTS + 0.5) / POINTS) / rows,
                     azimuth = pi * (x + (k % POINTS + 0.5) / POINTS) / rows - pi;
        count += cos(theta) * cos(zenith) + sin(theta) * sin(zenith) * cos(azimuth) >= edge;
    }
    return (double)count / (POINTS * POINTS);
}

/*
 * Adds the disc, which has a radius of a pixel at least. The radiance is such that the irradiance
 * of all its pixels is the sun's, whatever their sizes; what is below the horizon is left out.
 */
static void add_sun(float *rgb, const daylight *light, uint32_t rows)
{
    const double zenith = fmin(light->zenith * light->stretch, pi), reach = pi / rows,
                 radius = fmax(light->sun_half_aperture, reach);
    const uint32_t width = 2 * rows;
    double solid = 0;
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t y = 0; y < rows; y++) {
            const double top = pi * y / rows;
            const int is_below = top >= pi / 2 && light->stretch <= 1;
            if (fabs(top + reach / 2 - zenith) > radius + reach || (pass == 1 && is_below))
                continue;
            const double pixel = reach * (cos(top) - cos(top + reach));
            for (uint32_t x = 0; x < width; x++) {
                const double part = covered(radius, zenith, x, y, rows);
                solid += pass == 0 ? part * pixel : 0;
                for (int c = 0; c < 3 && pass == 1 && part > 0; c++)
                    rgb[3 * ((size_t)y * width + x) + (size_t)c] +=
                        (float)(light->sun_irradiance[c] * part / solid);
            }
        }
}

int rt_import_daylight(importer *import, char out[512], const daylight *light)
{
    const double *const sun = light->sun_irradiance;
    const int has_sun = sun[0] > 0 || sun[1] > 0 || sun[2] > 0;
    const uint32_t rows = has_sun ? ROWS_OF_SUN : ROWS_OF_SKY;
    double coefficients[3][10];
    float *const rgb = calloc((size_t)6 * rows * rows, sizeof *rgb);
    if (!rgb)
        return rt_import_fail_memory(import);
    mix_coefficients(coefficients, light);
    for (uint32_t y = 0; y < rows && light->sky_scale > 0; y++) {
        float *const row = rgb + 3 * (size_t)y * 2 * rows;
        for (uint32_t x = 0; x < rows; x++) {
            sky_pixel(row + 3 * x, light, coefficients, pi * (y + 0.5) / rows,
                      pi * (x + 0.5) / rows - pi);
            memcpy(row + 3 * (2 * rows - 1 - x), row + 3 * x, 3 * sizeof *row);
        }
    }
    if (has_sun)
        add_sun(rgb, light, rows);
    const int is_there = rt_import_write_picture(import, out, "sky", rgb, 2 * rows, rows);
    free(rgb);
    return is_there;
}
