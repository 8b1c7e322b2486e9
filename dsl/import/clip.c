/* clip.c - the planes between which the cameras of other programs see. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "dsl/import/import.h"

void rt_import_keep_clip(importer *import, int line, const import_plane planes[2],
                         const import_camera *camera)
{
    import_clip *const clip = &import->clip;
    memcpy(clip->planes, planes, sizeof clip->planes);
    memcpy(clip->eye, camera->eye, sizeof clip->eye);
    memcpy(clip->forward, camera->direction, sizeof clip->forward);
    rt_vector_normalize(clip->forward);
    clip->place = import->place;
    clip->line = line;
}

/*
 * Near planes that are close beside the size of the scene hardly cut a shape, less so where the
 * camera is amid them.
 */
void rt_import_note_clip(importer *import)
{
    const import_clip *const clip = &import->clip;
    const import_plane *const near = &clip->planes[0], *const far = &clip->planes[1];
    const double *const lo = import->lo, *const hi = import->hi;
    double nearest = DBL_MAX, farthest = -DBL_MAX, size = 0;
    if (!near->word || lo[0] > hi[0])
        return;
    for (int corner = 0; corner < 8; corner++) {
        double off[3];
        for (int c = 0; c < 3; c++)
            off[c] = (corner >> c & 1 ? hi[c] : lo[c]) - clip->eye[c];
        const double depth = rt_vector_dot(off, clip->forward);
        nearest = fmin(nearest, depth);
        farthest = fmax(farthest, depth);
    }
    for (int c = 0; c < 3; c++)
        size = hypot(size, hi[c] - lo[c]);
    const import_place around = import->place;
    import->place = clip->place;
    if (near->depth > nearest && near->depth > (nearest > 0 ? 0.01 : 0.1) * size)
        rt_import_note_at(import, clip->line, "%s %.9g is left out: what is nearer is seen",
                          near->word, near->depth);
    if (far->depth < farthest)
        rt_import_note_at(import, clip->line, "%s %.9g is left out: what is farther is seen",
                          far->word, far->depth);
    import->place = around;
}
