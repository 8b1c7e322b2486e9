/* outputs.h - the image files of a render: which, and whether they can be written. */
#ifndef RTC_OUTPUTS_H
#define RTC_OUTPUTS_H

#include "options.h"
#include "rt.h"

/* Longest path of an output. */
enum { OUTPUT_PATH = 4096 };

typedef struct output_list {
    char (*paths)[OUTPUT_PATH];
    size_t count;
} output_list;

/*
 * The files of --out, or NAME.png and NAME.exr in the current directory for the scene NAME.rts,
 * NAME.IofN.rtpart for one of its parts; none for NULL. parts 0: the whole picture. Fails, before
 * any time is spent on rendering, when an extension is unknown, a name is given twice, a part is to
 * become an image or a file cannot be written. Returns an exit status. Free *out with outputs_free
 * in either case.
 */
int outputs_plan(output_list *out, const command_line *arguments, const char *scene, uint32_t part,
                 uint32_t parts);
void outputs_free(output_list *outputs);

/* The extension of a path with its dot, or ""; a name that is an extension alone has none. */
const char *outputs_extension(const char *path);

/*
 * Whether a file can be written, without writing it. Returns an exit status, with a message when it
 * is not STATUS_DONE.
 */
int outputs_check_writable(const char *path);

/* Whether a file is a film, whose sums are kept; how many of them are. */
int outputs_is_film(const char *path);
size_t outputs_films(const output_list *outputs);

/* Whether any of them has 8 bits a channel, so that exposure and tone curve matter. */
int outputs_have_8bit(const output_list *outputs);

/* Whether any of them is an .exr, the only format with layers. */
int outputs_have_layers(const output_list *outputs);

/* Writes the film to all of them, also after one has failed. Returns an exit status. */
int outputs_write(const output_list *outputs, const rt_film *film, const rt_image_options *options);

#endif
