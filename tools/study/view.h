/*
 * view.h - what the pictures of a study are compared with: a reference for each view. Pictures of
 * one scene with the same constants and the same size are of one view.
 */
#ifndef RTC_STUDY_VIEW_H
#define RTC_STUDY_VIEW_H

#include "cell.h"
#include "page.h"

typedef struct study_view {
    rt_image *reference; /* NULL: none yet */
    float *rgb;          /* its pixels, [height][width][3] */
    uint32_t width, height;
    double mean; /* of all pixels and channels */
} study_view;

/*
 * The axes of a sweep that decide the view; shares their memory, so that it is not to be freed.
 */
sweep views_of(const sweep *all);

/* Whether --reference is a word, by which references are rendered, and not files. */
int views_are_rendered(const char *reference);

/*
 * Whether --reference, FILE,FILE,... or a word, has a file for each view, in the
 * order of the values that are swept. Returns an exit status.
 */
int views_check_files(const sweep *views, const char *reference);

/* The file of a view; the text is that of --reference as a whole where there is one view. */
const char *views_file(char *out, size_t size, const sweep *views, size_t view,
                       const char *reference);

/* The view of a combination of the whole sweep. */
size_t view_of_cell(const sweep *all, size_t cell);

/*
 * Reads the reference of a view, or renders it by the mode of its word, and describes it in *shown.
 * For `auto` that is path, or vcm where path leaves out light of the scene and vcm does not.
 * Returns an exit status; free in either case.
 */
int study_view_open(study_view *out, study_cell *shown, study_renderer *renderer,
                    const command_line *arguments, const sweep *views, size_t view,
                    const char *scene);
void study_view_free(study_view *view);

#endif
