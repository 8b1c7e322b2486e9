/*
 * record.h - RECORD, for what is written down of a path at each vertex in the program that is built
 * for it (paths.cl); elsewhere it is nothing, and paths keep no vertex.
 */
#ifndef RT_RECORD_H
#define RT_RECORD_H

#ifdef RT_RECORD_PATHS
#define RECORD(statement) statement
#define RECORDED /* of a path: its vertex is written to */
#else
#define RECORD(statement)
#define RECORDED const
#endif

#endif
