// Spheres in Embree: one scene, one geometry, one thread.
#include <embree3/rtcore.h>
#include <stdlib.h>
#include <string.h>

struct spheres {
    RTCDevice device;
    RTCScene scene;
};

void spheres_free(struct spheres *spheres) {
    if (spheres) {
        if (spheres->scene) rtcReleaseScene(spheres->scene);
        if (spheres->device) rtcReleaseDevice(spheres->device);
        free(spheres);
    }
}

struct spheres *spheres_new(void) {
    struct spheres *spheres = calloc(1, sizeof *spheres);
    if (spheres && !(spheres->device = rtcNewDevice("threads=1,set_affinity=0"))) {
        spheres_free(spheres);
        return NULL;
    }
    return spheres;
}

// `numbers`: x, y, z and radius of each.
int spheres_build(struct spheres *spheres, const float *numbers, size_t count) {
    RTCGeometry geometry = rtcNewGeometry(spheres->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    void *vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), count);
    if (!vertices) return 0;
    memcpy(vertices, numbers, count * 4 * sizeof(float));
    rtcCommitGeometry(geometry);
    spheres->scene = rtcNewScene(spheres->device);
    rtcAttachGeometry(spheres->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(spheres->scene);
    return rtcGetDeviceError(spheres->device) == RTC_ERROR_NONE;
}

// The index of the sphere that is met first, or UINT_MAX. `t` is where its range ends, and then where it is met.
unsigned spheres_nearest(const struct spheres *spheres, const float *origin, const float *direction, float *t) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    struct RTCRayHit ray;
    ray.ray.org_x = origin[0];
    ray.ray.org_y = origin[1];
    ray.ray.org_z = origin[2];
    ray.ray.tnear = 0;
    ray.ray.dir_x = direction[0];
    ray.ray.dir_y = direction[1];
    ray.ray.dir_z = direction[2];
    ray.ray.time = 0;
    ray.ray.tfar = *t;
    ray.ray.mask = -1;
    ray.ray.id = 0;
    ray.ray.flags = 0;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(spheres->scene, &context, &ray);
    *t = ray.ray.tfar;
    return ray.hit.primID;
}

// Whether any sphere is met before `t`.
int spheres_occluded(const struct spheres *spheres, const float *origin, const float *direction, float t) {
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    struct RTCRay ray;
    ray.org_x = origin[0];
    ray.org_y = origin[1];
    ray.org_z = origin[2];
    ray.tnear = 0;
    ray.dir_x = direction[0];
    ray.dir_y = direction[1];
    ray.dir_z = direction[2];
    ray.time = 0;
    ray.tfar = t;
    ray.mask = -1;
    ray.id = 0;
    ray.flags = 0;
    rtcOccluded1(spheres->scene, &context, &ray);
    return ray.tfar < 0;
}

// 16 rays at a time, which lie together: `numbers` are their origins' x, y and z and their directions', 16 of each.
// `found` has the indices of the spheres that are met first, or UINT_MAX, and `t` where.
void spheres_nearest_16(const struct spheres *spheres, const float *numbers, unsigned *found, float *t) {
    static const int valid[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    struct RTCRayHit16 rays;
    memcpy(rays.ray.org_x, numbers, 16 * sizeof(float));
    memcpy(rays.ray.org_y, numbers + 16, 16 * sizeof(float));
    memcpy(rays.ray.org_z, numbers + 32, 16 * sizeof(float));
    memcpy(rays.ray.dir_x, numbers + 48, 16 * sizeof(float));
    memcpy(rays.ray.dir_y, numbers + 64, 16 * sizeof(float));
    memcpy(rays.ray.dir_z, numbers + 80, 16 * sizeof(float));
    for (int i = 0; i < 16; i++) {
        rays.ray.tnear[i] = 0;
        rays.ray.time[i] = 0;
        rays.ray.tfar[i] = t[i];
        rays.ray.mask[i] = -1;
        rays.ray.id[i] = 0;
        rays.ray.flags[i] = 0;
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, spheres->scene, &context, &rays);
    memcpy(found, rays.hit.primID, 16 * sizeof(unsigned));
    memcpy(t, rays.ray.tfar, 16 * sizeof(float));
}

// Likewise, whether any sphere is met before `t`, which is negative where one is.
void spheres_occluded_16(const struct spheres *spheres, const float *numbers, float *t) {
    static const int valid[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    struct RTCRay16 rays;
    memcpy(rays.org_x, numbers, 16 * sizeof(float));
    memcpy(rays.org_y, numbers + 16, 16 * sizeof(float));
    memcpy(rays.org_z, numbers + 32, 16 * sizeof(float));
    memcpy(rays.dir_x, numbers + 48, 16 * sizeof(float));
    memcpy(rays.dir_y, numbers + 64, 16 * sizeof(float));
    memcpy(rays.dir_z, numbers + 80, 16 * sizeof(float));
    for (int i = 0; i < 16; i++) {
        rays.tnear[i] = 0;
        rays.time[i] = 0;
        rays.tfar[i] = t[i];
        rays.mask[i] = -1;
        rays.id[i] = 0;
        rays.flags[i] = 0;
    }
    rtcOccluded16(valid, spheres->scene, &context, &rays);
    memcpy(t, rays.tfar, 16 * sizeof(float));
}
