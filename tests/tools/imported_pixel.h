/* imported_pixel.h - what an imported scene of one pixel shows, and images to show. */
#ifndef RT_TESTS_TOOLS_IMPORTED_PIXEL_H
#define RT_TESTS_TOOLS_IMPORTED_PIXEL_H

/* A black image but for one white pixel, in a .ppm. */
void write_one_pixel(const char *name, int width, int height, int column, int row);

/* Writes t.rts from a scene of another program, and renders its one pixel; and its red alone. */
void imported_colour(const char *file, double rgb[3]);
double imported_pixel(const char *file);

#endif
