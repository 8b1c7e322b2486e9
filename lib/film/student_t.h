/* student_t.h - quantiles of Student's t distribution. */
#ifndef RT_LIB_FILM_STUDENT_T_H
#define RT_LIB_FILM_STUDENT_T_H

/* The 95 % quantiles of the standard normal distribution, two-sided and one-sided. */
#define RT_NORMAL_BOTH_SIDES 1.959963984540054
#define RT_NORMAL_ONE_SIDE 1.6448536269514722

/*
 * The quantile of Student's t with so many degrees of freedom, at least 1, at the probability at
 * which the normal distribution has the quantile z, between 0 and 2. Within 0.2 %.
 */
double rt_student_t_quantile(double z, double freedom);

#endif
