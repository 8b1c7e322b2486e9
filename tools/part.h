/* part.h - which part of a picture or of a photon map a run is to do. */
#ifndef RTC_PART_H
#define RTC_PART_H

#include <stdint.h>

/*
 * Reads the value of --part: "I/N", 1 <= I <= N, or "auto", which takes I and N from the
 * environment of Slurm (an array job or the tasks of a job), Open MPI, MPICH or an indexed job.
 * Returns an exit status.
 */
int part_read(uint32_t *part, uint32_t *parts, const char *text);

#endif
