/* daylight.h - the radiance of sun and sky, and where the sun stands. */
#ifndef RT_DSL_IMPORT_DAYLIGHT_H
#define RT_DSL_IMPORT_DAYLIGHT_H

#include "dsl/import/import.h"

/*
 * [turbidity][albedo][control][channel][10]: by turbidity 1 to 10, albedo of the ground 0 and 1,
 * and control point of the elevation of the sun, the model's coefficients A to I and its mean
 * radiance.
 */
extern const double rt_daylight_sky[10 * 2 * 6 * 3 * 10];

/* [turbidity][elevation][channel]: across the rays, at 2 to 89 degrees, 3 apart. */
extern const double rt_daylight_sun[10 * 30 * 3];

/* Angles in radians; zenith: of the sun, from straight above, up to pi / 2. */
typedef struct daylight {
    double turbidity, albedo[3]; /* 1 to 10; of the ground, 0 to 1 */
    double zenith;
    double sky_scale;
    double stretch;           /* of the sky's angles from above, 1 to 2: as if they were smaller */
    int extends;              /* below the horizon, where it fades out */
    double sun_irradiance[3]; /* across the rays; 0: the sun is not in the picture */
    double sun_half_aperture; /* above 0 */
} daylight;

/* A place and a local time there: degrees, north and east of 0; hours east of Greenwich. */
typedef struct daylight_time {
    double latitude, longitude, timezone;
    int year, month, day;
    double hour, minute, second;
} daylight_time;

/*
 * The sun's angle from straight above and its azimuth, from north by east, radians. Blanco-Muriel,
 * Alarcon-Padilla, Lopez-Moratalla and Lara-Coira, "Computing the Solar Vector", Solar Energy 70,
 * 2001.
 */
void rt_daylight_sun_place(const daylight_time *when, double *zenith, double *azimuth);

/*
 * Irradiance by the sun: by Hosek and Wilkie, and as Mitsuba 0.x has it, by Preetham, Shirley and
 * Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999.
 */
void rt_daylight_sun_irradiance(double turbidity, double zenith, double out[3]);
void rt_daylight_old_sun_irradiance(importer *import, int line, double turbidity, double zenith,
                                    double out[3]);

/*
 * Writes the image of an environment whose top is straight above and whose middle column has the
 * sun; `out` receives its name. Returns 0 after a failure.
 */
int rt_import_daylight(importer *import, char out[512], const daylight *light);

#endif
