/*
 * fuzz_reference.h - cloth in double precision, by its definition: the lobe of Estevez and Kulla,
 * its albedo by quadrature, and a Lambert surface that takes what it leaves.
 */
#ifndef RT_TESTS_STATISTICS_FUZZ_REFERENCE_H
#define RT_TESTS_STATISTICS_FUZZ_REFERENCE_H

/*
 * fr in a channel of albedo kd below fuzz of this colour, whose largest channel is `most`, of
 * roughness r, for cosines to the normal and between the directions.
 */
double fuzz_fr(double kd, double fuzz, double most, double r, double cos_o, double cos_i,
               double cos_between);

/* E: what white fuzz reflects of even light, seen at this cosine. */
double fuzz_reflectance(double r, double cosine);

#endif
