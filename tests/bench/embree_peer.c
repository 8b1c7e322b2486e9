/* embree_peer.c - builds and traces by Embree, or does nothing without it. */
#include "bench/embree_peer.h"

#ifdef RT_HAVE_EMBREE

#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"

enum { CHUNK = 1024 };

struct embree_peer {
    RTCDevice device;
    RTCGeometry geometry;
    RTCScene scene;
    uint32_t threads;
};

typedef struct trace_job {
    const embree_peer *peer;
    const rt_ray *rays;
    size_t count;
    rt_hit *hits;
} trace_job;

embree_peer *embree_peer_create(const float *positions, uint32_t vertices, const uint32_t *indices,
                                uint32_t triangles, uint32_t threads)
{
    char config[64];
    embree_peer *peer = calloc(1, sizeof *peer);
    if (peer == NULL)
        return NULL;
    snprintf(config, sizeof config, "threads=%u,set_affinity=0", (unsigned)threads);
    peer->device = rtcNewDevice(config);
    if (peer->device == NULL) {
        free(peer);
        return NULL;
    }
    peer->threads = threads;
    peer->geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(peer->geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               positions, 0, 3 * sizeof *positions, vertices);
    rtcSetSharedGeometryBuffer(peer->geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices,
                               0, 3 * sizeof *indices, triangles);
    rtcCommitGeometry(peer->geometry);
    return peer;
}

void embree_peer_destroy(embree_peer *peer)
{
    if (peer == NULL)
        return;
    if (peer->scene)
        rtcReleaseScene(peer->scene);
    rtcReleaseGeometry(peer->geometry);
    rtcReleaseDevice(peer->device);
    free(peer);
}

void embree_peer_build(embree_peer *peer)
{
    if (peer->scene)
        rtcReleaseScene(peer->scene);
    peer->scene = rtcNewScene(peer->device);
    rtcSetSceneBuildQuality(peer->scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcAttachGeometry(peer->scene, peer->geometry);
    rtcCommitScene(peer->scene);
}

static void trace_one(RTCScene scene, struct RTCIntersectContext *context, const rt_ray *ray,
                      rt_hit *hit)
{
    struct RTCRayHit work;
    memset(&work, 0, sizeof work);
    work.ray.org_x = ray->origin[0];
    work.ray.org_y = ray->origin[1];
    work.ray.org_z = ray->origin[2];
    work.ray.tnear = ray->t_min;
    work.ray.dir_x = ray->direction[0];
    work.ray.dir_y = ray->direction[1];
    work.ray.dir_z = ray->direction[2];
    work.ray.tfar = ray->t_max;
    work.ray.mask = 0xffffffffu;
    work.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    work.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, context, &work);
    const int met = work.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    const float x = work.hit.Ng_x, y = work.hit.Ng_y, z = work.hit.Ng_z;
    const float scale = met ? 1.0f / sqrtf(x * x + y * y + z * z) : 0.0f;
    *hit = (rt_hit){met ? work.ray.tfar : INFINITY,
                    work.hit.u,
                    work.hit.v,
                    met ? work.hit.primID : RT_NONE,
                    {x * scale, y * scale, z * scale},
                    met ? 0 : RT_NONE};
}

static void trace_chunk(void *user, uint32_t index)
{
    const trace_job *job = user;
    const size_t first = (size_t)index * CHUNK;
    const size_t end = first + CHUNK < job->count ? first + CHUNK : job->count;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = first; i < end; i++)
        trace_one(job->peer->scene, &context, &job->rays[i], &job->hits[i]);
}

void embree_peer_trace(embree_peer *peer, const rt_ray *rays, size_t count, rt_hit *hits)
{
    trace_job job = {peer, rays, count, hits};
    rt_parallel(peer->threads, (uint32_t)((count + CHUNK - 1) / CHUNK), trace_chunk, &job);
}

#else

embree_peer *embree_peer_create(const float *positions, uint32_t vertices, const uint32_t *indices,
                                uint32_t triangles, uint32_t threads)
{
    (void)positions;
    (void)vertices;
    (void)indices;
    (void)triangles;
    (void)threads;
    return NULL;
}

void embree_peer_destroy(embree_peer *peer)
{
    (void)peer;
}

void embree_peer_build(embree_peer *peer)
{
    (void)peer;
}

void embree_peer_trace(embree_peer *peer, const rt_ray *rays, size_t count, rt_hit *hits)
{
    (void)peer;
    (void)rays;
    (void)count;
    (void)hits;
}

#endif
