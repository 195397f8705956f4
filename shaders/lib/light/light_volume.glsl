// Light volumes: triangles over the part of the image that a light can change; outside of it the light is exactly 0.
//
// Every triangle is wound as a back face and lies at one depth, that of the farthest point in the light's range, so a
// depth test that passes where the stored depth is nearer keeps the surfaces in front of it.
//   sphere   a pyramid from the eye: an octagon around the visible circle, 1.055 times its area
//   cone     for cones up to 84 degrees: a hull around cone and spherical cap, 1.055 (narrow) to 1.39 (84 degrees)
//            times their volume; its back faces are drawn, so that they are also visible from inside
//   screen   lights without position or range, spheres that contain the eye, and lights far larger than the image of
//            an orthographic camera
#pragma once
#include "lib/surface/camera.glsl"
#include "lib/light/light_store.glsl"
#include "shared/culling.h"
#include "shared/light_volumes.h"

// Cones wider than this are drawn as their spheres.
const float kWidestConeCosine = 0.1;

// Margin in metres by which a volume is larger than its light, so that rounding loses no pixel: the rounding of
// positions and depths, and an eighth of a pixel (vertices snap to at least 1/16, OpenGL 4.5, table 23.65). At the
// silhouette, snapping may flip a triangle; there the light is 0 already, so that changes nothing.
float volumeMargin(vec3 positionLS, float reachMetres)
{
    bool orthographic = view.forwardLS.w != 0.0;
    float farthestFromEye = length(positionLS - view.eyeLS.xyz) + reachMetres;
    float pixel = max(view.rayFromPixel.x, view.rayFromPixel.y) * (orthographic ? 1.0 : farthestFromEye);
    return roundingMargin(length(positionLS) + reachMetres, view.depthKey) + 0.125 * pixel;
}

// Depth-buffer value at a distance ahead. Points behind the eye count as nearest.
float depthAt(float ahead)
{
    if (view.forwardLS.w == 0.0 && !(view.eyeLS.w + ahead > 0.0)) return 1.0;
    return clamp(depthFromAhead(ahead), 0.0, 1.0);
}

vec3 perpendicularTo(vec3 direction)
{
    return normalize(cross(direction, abs(direction.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
}

// Offset of a corner around an axis, counter-clockwise seen against it; the regular outline encloses the circle.
vec3 cornerAround(vec3 axis, int side, float radius)
{
    const float kPiBySides = 3.14159265 / float(LIGHT_VOLUME_SIDES);
    vec3 first = perpendicularTo(axis);
    vec3 second = cross(axis, first);
    float angle = 2.0 * kPiBySides * float(side % LIGHT_VOLUME_SIDES);
    return (cos(angle) * first + sin(angle) * second) * (radius / cos(kPiBySides));
}

vec4 screenVertex(int vertex, float depth)
{
    return vec4(vertex == 2 ? 3.0 : -1.0, vertex == 1 ? 3.0 : -1.0, depth, 1.0);
}

// Clip-space position with its depth replaced.
vec4 vertexAtDepth(vec3 positionLS, float depth)
{
    vec4 clip = view.clipFromLS * vec4(positionLS, 1.0);
    return vec4(clip.xy, depth * clip.w, clip.w);
}

vec4 sphereVertex(int vertex, vec3 centerLS, float radius)
{
    bool orthographic = view.forwardLS.w != 0.0;
    float depth = depthAt(dot(view.forwardLS.xyz, centerLS) + radius);
    vec3 toCenter = centerLS - view.eyeLS.xyz;
    float distance = length(toCenter);
    // 0.999: close to the sphere the pyramid opens to a half space.
    if (!orthographic && !(radius < 0.999 * distance)) return screenVertex(vertex, depth);
    // The circle where the eye's rays touch the sphere.
    float sine = orthographic ? 0.0 : radius / distance;
    float cosine2 = 1.0 - sine * sine;
    vec3 sight = orthographic ? view.forwardLS.xyz : toCenter / distance;
    int fan = vertex < LIGHT_VOLUME_SPHERE_VERTICES ? vertex / 3 : 0;
    int side = vertex < LIGHT_VOLUME_SPHERE_VERTICES && vertex % 3 > 0 ? fan + vertex % 3 : 0;
    return vertexAtDepth(centerLS - toCenter * (sine * sine) + cornerAround(sight, side, radius * sqrt(cosine2)), depth);
}

#if HAS_CONE_LIGHTS
// Vertex of a hull of revolution around a cone of half-angle a and range r, and everything within `margin` of it. Its
// profile has a ring behind the apex, one where the cone's side meets the plane that touches the cap at a / 2, and one
// where that plane meets the plane that touches the cap at its pole.
vec4 coneVertex(int vertex, vec3 apexLS, vec3 axisLS, float cosOuter, float reachMetres, float margin)
{
    int triangle = vertex / 3;
    int corner = vertex % 3;
    const int kCap = LIGHT_VOLUME_SIDES - 2;
    int ring, side;
    if (triangle < kCap) {
        ring = 0;
        side = corner == 0 ? 0 : triangle + 3 - corner;
    } else if (triangle < kCap + 4 * LIGHT_VOLUME_SIDES) {
        int strip = triangle - kCap;
        bool second = strip % 2 == 1;
        ring = strip / (2 * LIGHT_VOLUME_SIDES) + int(second ? corner > 0 : corner == 2);
        side = strip % (2 * LIGHT_VOLUME_SIDES) / 2 + int(second ? corner == 1 : corner > 0);
    } else {
        ring = 2;
        side = corner == 0 ? 0 : triangle - kCap - 4 * LIGHT_VOLUME_SIDES + corner;
    }

    float sinOuter = sqrt((1.0 - cosOuter) * (1.0 + cosOuter));
    float cosHalf = sqrt(0.5 * (1.0 + cosOuter));
    float sinHalf = sqrt(0.5 * (1.0 - cosOuter));
    float reach = reachMetres + margin;
    float along, radius;
    if (ring == 0) {
        along = -margin;
        radius = margin * (1.0 - sinOuter) / cosOuter;
    } else if (ring == 1) {
        float up = (reach + margin * sinHalf) / cosHalf;
        along = up * cosOuter - margin * sinOuter;
        radius = up * sinOuter + margin * cosOuter;
    } else {
        along = reach;
        radius = reach * sinHalf / (1.0 + cosHalf);
    }

    // The farthest point: on the cap if the view axis lies within the cone's angle, else on its rim, else the apex.
    float cosForward = dot(axisLS, view.forwardLS.xyz);
    float sinForward = sqrt(max(0.0, 1.0 - cosForward * cosForward));
    float share = cosForward >= cosOuter ? 1.0 : max(0.0, cosForward * cosOuter + sinForward * sinOuter);
    float depth = depthAt(dot(view.forwardLS.xyz, apexLS) + reachMetres * share + margin);
    return vertexAtDepth(apexLS + along * axisLS + cornerAround(axisLS, side, radius), depth);
}
#endif

// Whether an outline of this size would have clip coordinates so large that its edges are inaccurate. Only under an
// orthographic camera: a perspective one is inside a vast sphere, or sees it as a circle of ordinary size.
bool isVastInPicture(float reach)
{
    float clipPerMetre = max(length(vec3(view.clipFromLS[0].x, view.clipFromLS[1].x, view.clipFromLS[2].x)),
                             length(vec3(view.clipFromLS[0].y, view.clipFromLS[1].y, view.clipFromLS[2].y)));
    return view.forwardLS.w != 0.0 && reach * clipPerMetre > 256.0;
}

// Corner `vertex` of the volume of light `index`.
vec4 lightVolumeVertex(int index, int vertex)
{
    vec4 place = lightTexel(index, 0);
    if (place.w == 0.0) return screenVertex(vertex, 0.0);
    float reach = inversesqrt(place.w);
    float margin = volumeMargin(place.xyz, reach);
    if (isVastInPicture(reach + margin)) return screenVertex(vertex, 0.0);
#if HAS_CONE_LIGHTS
    int kind = int(lightTexel(index, 1).w);
    if (IS_CONE_LIGHT(kind & LIGHT_TYPE_MASK)) {
        LightShapeTexels shape = LightShapeTexels(lightShapeTexel(index, 0), lightShapeTexel(index, 1));
        float cosOuter = coneCosOuter(kind, shape) - CONE_COSINE_MARGIN;
        if (cosOuter > kWidestConeCosine)
            return coneVertex(vertex, place.xyz, coneTravel(shape), cosOuter, reach, margin);
    }
#endif
    return sphereVertex(vertex, place.xyz, reach + margin);
}
