/* write.h - the paths of a pixel, and the files that they are written to. */
#ifndef RTC_PATHS_WRITE_H
#define RTC_PATHS_WRITE_H

#include <stdio.h>

#include "rt.h"

/* The paths of a pixel, and what they are of. */
typedef struct pixel_paths {
    const char *scene; /* its path */
    uint32_t x, y, width, height;
    uint32_t first, count; /* samples */
    const rt_camera_path *paths;
    size_t path_count;
    const rt_path_vertex *vertices;
    size_t vertex_count;
    rt_film *film; /* the picture; of a page alone */
} pixel_paths;

/* A text that is made in memory, and then becomes a file as a whole, or goes to stdout. */
typedef struct text_file {
    FILE *stream;
    char *data;
    size_t size;
} text_file;

/* False, after saying so, without memory. */
int text_file_begin(text_file *out);

/* Ends the text; with `keep`, writes it to the file, or to stdout for NULL. Returns exit status. */
int text_file_end(text_file *out, int keep, const char *path);

/* Each returns an exit status. */
int paths_write_json(const pixel_paths *pixel, text_file *out);

/*
 * Lines: each path is a chain of edges, and so is each sampled light. A path that escapes ends at
 * the distance of the farthest vertex.
 */
int paths_write_ply(const pixel_paths *pixel, text_file *out);

/* A page that needs no other file: the paths over the picture. */
int paths_write_page(const pixel_paths *pixel, text_file *out);

/* The mean of the paths: the pixel, where they are all of its samples. */
void paths_mean(double mean[3], const pixel_paths *pixel);

#endif
