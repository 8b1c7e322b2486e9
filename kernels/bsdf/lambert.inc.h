/* lambert.inc.h - the density of Lambert's lobe, width-generic (see math/width1.inc.h). */

/*
 * The density of wi: the cosine to the shading normal over pi, and 0 below the geometric surface.
 * fr |n.wi| is kd times it.
 */
static inline REAL W(lambert_density)(VEC3 normal, VEC3 shading, VEC3 wi)
{
    return W(cosine_pdf_w)(DOT3(wi, normal) > 0.0f ? DOT3(wi, shading) : (REAL)(0.0f));
}
