/* spectrum.h - spectra by wavelength, as colours in linear sRGB. */
#ifndef RT_DSL_IMPORT_SPECTRUM_H
#define RT_DSL_IMPORT_SPECTRUM_H

#include "dsl/import/import.h"

/* Values at wavelengths, which rise, in nanometres; all zero is empty. */
typedef struct spectrum {
    double *wavelengths, *values; /* [count] */
    size_t count;
} spectrum;

/* A reflectance, seen under D65, is from 0 to 1; an index likewise, but not bounded above. */
typedef enum spectrum_use { SPECTRUM_REFLECTANCE, SPECTRUM_INDEX, SPECTRUM_EMISSION } spectrum_use;

/* Each returns 0 after a failure; rt_spectrum_free is called in any case. */
int rt_spectrum_add(importer *import, int line, spectrum *out, double wavelength, double value);

/* From pairs, as in "400:0.1, 500:0.2", or in lines of two numbers; '#' begins a comment. */
int rt_spectrum_read(importer *import, int line, spectrum *out, const char *text);
int rt_spectrum_read_file(importer *import, int line, spectrum *out, const char *name);
void rt_spectrum_free(spectrum *s);

/*
 * The colour of a spectrum that has a value. That of an emission is by the mean over the luminous
 * efficiency: what is 1 at all wavelengths has Y = 1. Colours that sRGB lacks are told.
 */
void rt_spectrum_colour(importer *import, int line, const spectrum *s, spectrum_use use,
                        double out[3]);

/* The same of the radiance of a black body, W/(m^2 sr nm). */
void rt_spectrum_black_body(double kelvin, double out[3]);

/* The Y of a colour in linear sRGB. */
double rt_spectrum_luminance(const double rgb[3]);

#endif
