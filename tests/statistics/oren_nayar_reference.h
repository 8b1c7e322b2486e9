/*
 * oren_nayar_reference.h - the energy-preserving Oren-Nayar lobe in double precision, by its
 * definition: Fujii's lobe, its albedo by quadrature, and what that lacks given back.
 */
#ifndef RT_TESTS_STATISTICS_OREN_NAYAR_REFERENCE_H
#define RT_TESTS_STATISTICS_OREN_NAYAR_REFERENCE_H

/* fr of albedo kd and roughness r, for cosines to the normal and between the directions. */
double oren_nayar_fr(double kd, double r, double cos_o, double cos_i, double cos_between);

#endif
