/* tga.h - pictures from Truevision TGA files in memory. */
#ifndef RT_LIB_IMAGE_TGA_H
#define RT_LIB_IMAGE_TGA_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Whether a file begins as a TGA does. The format has no magic number: its header is plausible
 * where every field has one of the few values that are possible beside the others.
 */
int rt_tga_is_plausible(const rt_bytes *file);

#endif
