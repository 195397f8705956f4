// Intersects rays with the opaque surfaces of an image: a ray is marched in screen space, against their depths, to
// where it goes behind a surface (docs/glass.md). Source: McGuire and Mara 2014, "Efficient GPU Screen-Space Ray
// Tracing": in screen space a ray is straight, and its depth-buffer value is linear along it, as on planes.
#pragma once
#include "shared/refraction.h"
#include "lib/raster/depth_step.glsl"
#include "lib/surface/camera.glsl"

#if HAS_SCENE_BEHIND
layout(binding = TEXTURE_UNIT_BEHIND) uniform sampler2D behindPicture;
#if HAS_BLURRED_SCENE_BEHIND
layout(binding = TEXTURE_UNIT_BEHIND_LEVELS) uniform sampler2D behindLevels;
#endif
layout(binding = TEXTURE_UNIT_BEHIND_DEPTH) uniform sampler2D behindDepth;
#endif
#if HAS_BACK_FACES
layout(binding = TEXTURE_UNIT_FAR_SIDES) uniform sampler2D farSides; // xyz normal, w depth
#endif

// Layers of depths that rays are marched against.
const int kOpaqueLayer = 0;
const int kFarLayer = 1; // the back faces of bodies

// Tolerance of a hit: how far a surface may lie in front of the ray where the ray goes behind it, in pixels, and in
// steps of the surface's depth from that pixel to the next. Beyond that, the ray passes behind the surface's edge.
const float kBehindPixels = 4.0;
const float kBehindSlopes = 2.0;

// Steps of the interpolation weights within a pixel. An unbent ray ends in the centre of its pixel up to rounding, and
// then shows that texel alone.
const float kBehindShares = 256.0;

ivec2 pixelBehind(vec2 place)
{
    return clamp(ivec2(floor(place)), ivec2(0), ivec2(view.sizePixels.xy) - 1);
}

// Stored depth; 0 where nothing is.
float depthBehind(int layer, ivec2 pixel)
{
    pixel = clamp(pixel, ivec2(0), ivec2(view.sizePixels.xy) - 1);
#if HAS_BACK_FACES
    if (layer == kFarLayer) return texelFetch(farSides, pixel, 0).w;
#endif
#if HAS_SCENE_BEHIND
    return texelFetch(behindDepth, pixel, 0).r;
#else
    return 0.0;
#endif
}

// Metres ahead of the origin of lighting space.
float aheadOf(float depth)
{
    vec4 lens = view.aheadFromDepth;
    precise float ahead = (lens.x + lens.y * depth) / (lens.z + lens.w * depth);
    return ahead;
}

// Whether a screen position, with its depth as z, lies behind what is drawn there.
bool isBehind(int layer, vec3 place)
{
    float depth = depthBehind(layer, pixelBehind(place.xy));
    return depth > 0.0 && place.z < depth;
}

// A screen-space ray: positions in pixels and their depths, linear from begin to begin + way. isSeen: false if it
// begins outside the view. A ray that begins beyond the far plane has length 0.
struct ScreenRay {
    vec3 begin;
    vec3 way;
    bool isSeen;
};

// Clips the points (1 - u) from + u towards, u up to `share`, at a plane of the view, by the distances of both from it.
float shareInside(float from, float towards, float share)
{
    precise float crossing = from / (from - towards);
    return share > 0.0 && towards < 0.0 ? min(share, crossing) : share;
}

// Ray to a point in homogeneous coordinates, which may be at infinity.
ScreenRay screenRayTo(vec3 originLS, vec4 endLS)
{
    precise vec4 from = view.clipFromLS * vec4(originLS, 1.0);
    precise vec4 towards = view.clipFromLS * endLS;
    ScreenRay ray = ScreenRay(vec3(0.0), vec3(0.0), false);
    precise vec3 lowFrom = vec3(from.w + from.x, from.w + from.y, from.z);
    precise vec3 highFrom = vec3(from.w - from.x, from.w - from.y, from.w - from.z);
    if (!(from.w > 0.0) || min(lowFrom.x, lowFrom.y) < 0.0 || min(min(highFrom.x, highFrom.y), highFrom.z) < 0.0)
        return ray;
    precise vec3 lowTowards = vec3(towards.w + towards.x, towards.w + towards.y, towards.z);
    precise vec3 highTowards = vec3(towards.w - towards.x, towards.w - towards.y, towards.w - towards.z);
    float share = lowFrom.z < 0.0 ? 0.0 : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        share = shareInside(lowFrom[axis], lowTowards[axis], share);
        share = shareInside(highFrom[axis], highTowards[axis], share);
    }
    precise vec4 to = (1.0 - share) * from + share * towards;
    if (!(to.w > 0.0)) return ray;
    precise vec3 begin = from.xyz / from.w, end = to.xyz / to.w;
    vec2 halfSize = 0.5 * vec2(view.sizePixels.xy);
    begin.xy = (begin.xy + 1.0) * halfSize;
    end.xy = (end.xy + 1.0) * halfSize;
    ray.begin = begin;
    ray.way = end - begin;
    ray.isSeen = true;
    return ray;
}

ScreenRay screenRay(vec3 originLS, vec3 directionLS)
{
    return screenRayTo(originLS, vec4(directionLS, 0.0));
}

// Whether a ray that goes behind a pixel's surface hits it there, instead of passing behind its edge.
bool isMet(int layer, ScreenRay ray, vec3 before, vec3 after)
{
    ivec2 pixel = pixelBehind(after.xy);
    if (pixelBehind(before.xy) == pixel) return true; // it crosses the depth of one pixel
    float depth = depthBehind(layer, pixel), ahead = aheadOf(depth);
    precise float gap = aheadOf(max(after.z, 0.0)) - ahead;
    bool isWide = abs(ray.way.x) >= abs(ray.way.y);
    ivec2 next = isWide ? ivec2(ray.way.x < 0.0 ? -1 : 1, 0) : ivec2(0, ray.way.y < 0.0 ? -1 : 1);
    // A continuous surface slopes the same way on both sides; an object that is one pixel wide does not. At an edge one
    // step leaves the surface.
    float nextDepth = depthBehind(layer, pixel + next), lastDepth = depthBehind(layer, pixel - next);
    bool goesOn = nextDepth > 0.0 && (nextDepth > depth) == (depth > lastDepth);
    precise float slope = goesOn ? abs(stepOnSurface(aheadOf(lastDepth), ahead, aheadOf(nextDepth))) : 0.0;
    vec2 spread = raySpread();
    precise float pixelMetres = (spread.x + spread.y * ahead) * length(view.rayDxLS.xyz);
    return gap <= kBehindPixels * pixelMetres + kBehindSlopes * slope;
}

// Depth change along an axis, on a pixel's surface.
float depthStep(int layer, ivec2 pixel, ivec2 axis, float depth)
{
    return stepOnSurface(depthBehind(layer, pixel - axis), depth, depthBehind(layer, pixel + axis));
}

// Change of a surface's depth per pixel, to the right and up.
vec2 slopeBehind(int layer, ivec2 pixel, float depth)
{
    return vec2(depthStep(layer, pixel, ivec2(1, 0), depth), depthStep(layer, pixel, ivec2(0, 1), depth));
}

// Whether a ray enters the plane of a pixel's surface. Where a body stands on a surface at a grazing angle, a ray that
// leaves the plane may also be behind the centre of a pixel.
bool leadsInto(int layer, ScreenRay ray, ivec2 pixel)
{
    precise float rate = ray.way.z - dot(slopeBehind(layer, pixel, depthBehind(layer, pixel)), ray.way.xy);
    return rate < 0.0;
}

// Intersection of a ray with the plane of the surface in the pixel of `after`; `after` itself if it lies elsewhere.
vec3 placeMet(int layer, ScreenRay ray, vec3 after)
{
    ivec2 pixel = pixelBehind(after.xy);
    float depth = depthBehind(layer, pixel);
    vec2 slope = slopeBehind(layer, pixel, depth);
    vec2 middle = vec2(pixel) + 0.5;
    precise float above = after.z - (depth + dot(slope, after.xy - middle));
    precise float rate = ray.way.z - dot(slope, ray.way.xy);
    if (rate == 0.0) return after;
    precise float back = above / rate;
    precise vec3 met = after - back * ray.way;
    vec2 aside = abs(met.xy - middle);
    return max(aside.x, aside.y) <= 1.0 && met.z > 0.0 ? met : after;
}

// Hit of a screen-space ray on a surface of a layer, and the pixel of that surface.
struct ScreenHit {
    vec3 place;
    ivec2 pixel;
    bool isMet;
};

// `bodyDepth`: depth of the near side of the body that the ray comes from.
ScreenHit screenHit(int layer, ScreenRay ray, float bodyDepth)
{
    ScreenHit hit = ScreenHit(ray.begin, pixelBehind(ray.begin.xy), false);
    if (!ray.isSeen) return hit;
    bool wasBehind = isBehind(layer, ray.begin);
    precise float pixels = max(abs(ray.way.x), abs(ray.way.y));
    int steps = int(clamp(ceil(pixels), 1.0, float(REFRACTION_STEPS)));
    // A body thicker than its distance to an opaque surface ends there: a ray that begins behind the surface hits it,
    // unless it comes out at once, reflected where the body stands on it. Surfaces nearer than the body are not hit.
    hit.isMet = layer == kOpaqueLayer && wasBehind && depthBehind(layer, hit.pixel) <= bodyDepth
                && isBehind(layer, ray.begin + ray.way / float(steps)) && leadsInto(layer, ray, hit.pixel);
    for (int i = 1; i <= steps && !hit.isMet; ++i) {
        precise float after = float(i) / float(steps);
        bool goesBehind = isBehind(layer, ray.begin + after * ray.way);
        if (goesBehind && !wasBehind) {
            precise float before = float(i - 1) / float(steps);
            for (int k = 0; k < REFRACTION_HALVINGS; ++k) {
                precise float middle = 0.5 * (before + after);
                if (isBehind(layer, ray.begin + middle * ray.way))
                    after = middle;
                else
                    before = middle;
            }
            precise vec3 lastBefore = ray.begin + before * ray.way, firstBehind = ray.begin + after * ray.way;
            hit.isMet = isMet(layer, ray, lastBefore, firstBehind)
                        && (layer != kOpaqueLayer || leadsInto(layer, ray, pixelBehind(firstBehind.xy)));
            if (hit.isMet) {
                hit.place = placeMet(layer, ray, firstBehind);
                hit.pixel = pixelBehind(firstBehind.xy);
            }
        }
        wasBehind = goesBehind;
    }
    return hit;
}

#if HAS_SCENE_BEHIND
// Image at a position, interpolated between texels that are not in front of both the position and the near side of the
// body, at `bodyDepth`.
vec4 sharpBehind(vec3 place, float bodyDepth)
{
    precise vec2 corner = place.xy - 0.5;
    precise vec2 snapped = floor(corner * kBehindShares + 0.5) / kBehindShares;
    ivec2 low = ivec2(floor(snapped));
    precise vec2 share = snapped - vec2(low);
    // A surface that slopes towards the viewer is nearer at the next pixel.
    precise float nearest = 1.001 * max(bodyDepth, place.z);
    precise vec4 sum = vec4(0.0);
    precise float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 pixel = clamp(low + offset, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        precise float weight = (offset.x == 1 ? share.x : 1.0 - share.x) * (offset.y == 1 ? share.y : 1.0 - share.y);
        if (weight == 0.0 || depthBehind(kOpaqueLayer, pixel) > nearest) continue;
        sum += weight * texelFetch(behindPicture, pixel, 0);
        weights += weight;
    }
    if (!(weights > 0.0)) return texelFetch(behindPicture, pixelBehind(place.xy), 0);
    precise vec4 mean = sum / weights;
    return mean;
}

#if HAS_BLURRED_SCENE_BEHIND
// A level of the image at a position, interpolated.
vec4 levelBehind(vec2 place, int level)
{
    ivec2 size = ivec2(view.sizePixels.xy);
    ivec2 texels = ivec2(behindTexels(size.x, level), behindTexels(size.y, level));
    precise vec2 corner = place / float(1 << level) - 0.5;
    ivec2 low = ivec2(floor(corner));
    precise vec2 share = corner - vec2(low);
    ivec2 a = clamp(low, ivec2(0), texels - 1), b = clamp(low + 1, ivec2(0), texels - 1);
    int row = level > 0 ? behindRow(size.y, level) : 0;
    vec4 corners[4];
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = ivec2((i & 1) == 1 ? b.x : a.x, (i >> 1) == 1 ? b.y : a.y);
        corners[i] = level > 0 ? texelFetch(behindLevels, texel + ivec2(0, row), 0) : texelFetch(behindPicture, texel, 0);
    }
    precise vec4 below = corners[0] + share.x * (corners[1] - corners[0]);
    precise vec4 above = corners[2] + share.x * (corners[3] - corners[2]);
    precise vec4 mean = below + share.y * (above - below);
    return mean;
}

// Mean of the image over a square around a position, interpolated between levels.
vec4 meanBehind(vec2 place, float widthPixels)
{
    precise float level = clamp(0.5 * log2(1.0 + widthPixels * widthPixels), 0.0, float(BEHIND_COARSEST));
    int fine = min(int(level), BEHIND_COARSEST - 1);
    vec4 finer = levelBehind(place, fine), coarser = levelBehind(place, fine + 1);
    precise vec4 mean = finer + (level - float(fine)) * (coarser - finer);
    return mean;
}

// The image around a position, blurred by the lobe of a rough body. Half of a GGX lobe lies within a slope of alpha of
// its half vectors, which turns light by twice that angle: a disk of radius 2 alpha l at the distance l. One square has
// no tails, so the lobe is the sum of a narrow and a wide one, fitted to Walter's integral (docs/glass.md). Lobes
// narrower than a pixel still blur a little.
vec4 blurredBehind(vec3 place, float alpha, vec3 originLS)
{
    vec3 metLS = viewpointFromDepth(place.xy, place.z).positionLS;
    vec2 spread = raySpread();
    precise float pixelMetres =
        (spread.x + spread.y * dot(view.forwardLS.xyz, metLS)) * length(view.rayDxLS.xyz);
    precise float slopePixels = alpha * length(metLS - originLS) / pixelMetres;
    precise vec4 sum = 0.6 * meanBehind(place.xy, 2.6 * slopePixels) + 0.4 * meanBehind(place.xy, 5.8 * slopePixels);
    return sum;
}
#endif

// Surfaces hit by a ray from a body: rgb radiance times a, the covered fraction; 0 if it leaves the screen or hits
// none. `bodyDepth`: depth of the body's near side. The result is blurred around the ray by a GGX lobe of `alpha`.
vec4 sceneBehind(vec3 originLS, vec3 directionLS, float bodyDepth, float alpha)
{
    ScreenHit hit = screenHit(kOpaqueLayer, screenRay(originLS, directionLS), bodyDepth);
    if (!hit.isMet) return vec4(0.0);
#if HAS_BLURRED_SCENE_BEHIND
    if (alpha > ALPHA_MIN) return blurredBehind(hit.place, alpha, originLS);
#endif
    return sharpBehind(hit.place, bodyDepth);
}
#endif
