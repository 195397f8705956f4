// Area lights by Monte Carlo sampling per pixel: of the light's surface, the cosine, the lobe and the coat
// (docs/area-lights.md). Each sample is weighted by the densities of all of them in its direction (multiple importance
// sampling, the balance heuristic), so that none is needed for the others to converge. Source: Veach and Guibas 1995,
// "Optimally Combining Sampling Techniques for Monte Carlo Rendering".
#pragma once
#include "lib/light/area_places.glsl"
#include "lib/light/light_store.glsl"
#include "lib/maths/cut_loop.glsl"
#include "lib/maths/random.glsl"
#include "lib/reflectance/lobe_samples.glsl"
#include "shared/light_pictures.h"
#if HAS_LIGHT_PICTURES
#include "lib/light/light_picture.glsl"
#endif
#if HAS_POLYGON_LIGHTS
#define HAS_CORNERS 1
vec2 cornerOf(int light, int corner)
{
    return lightCorner(light, corner);
}
#endif
#include "lib/light/area_hits.glsl"

// ---- A light relative to a point ------------------------------------------------------------------------------------

// An area light relative to the shaded point, in lighting space and metres.
struct AreaSource {
    int light, type;
    bool isSeen, isTwoSided;
    vec3 middle;
    vec3 front;     // unit; flat: normal on the surface's side; sphere: to its centre; tube: its axis
    vec3 right, up; // flat: its axes; sphere, tube: unit vectors perpendicular to `front`, of a tube the first to the
                    // point
    float size;     // flat: area in square metres; sphere: 1 - cos of its angular radius; tube: radius
    float height;   // flat: how far the point is behind it
    // Tube: half length, distance of the point from its axis, the point's foot along the axis, and the half angle of
    // the visible lateral surface.
    float halfMetres, away, foot, seenHalf;
    float endSign; // tube: sign of the visible end; 0 if none is
};

// `normal`: shading normal of the surface.
AreaSource areaSource(int index, int kind, vec3 middle, vec3 normal)
{
    vec4 first = lightShapeTexel(index, 0), second = lightShapeTexel(index, 1);
    AreaSource source;
    source.light = index;
    source.type = kind & LIGHT_TYPE_MASK;
    source.middle = middle;
    source.isTwoSided = false;
    source.height = source.halfMetres = source.away = source.foot = source.seenHalf = source.endSign = 0.0;
#if HAS_SPHERE_LIGHTS
    if (source.type == LIGHT_SPHERE) {
        precise float distance2 = dot(middle, middle);
        precise float sine2 = first.w * first.w / distance2;
        source.isSeen = sine2 < 1.0;
        precise float capHeight = sine2 / (1.0 + sqrt(max(1.0 - sine2, 0.0)));
        source.size = capHeight;
        source.front = safeNormalize(middle, vec3(0.0, 0.0, 1.0));
        source.right = anyPerpendicular(source.front);
        source.up = cross(source.front, source.right);
        return source;
    }
#endif
#if HAS_TUBE_LIGHTS
    if (source.type == LIGHT_TUBE) {
        source.size = first.w;
        source.halfMetres = max(length(first.xyz), 1e-18);
        precise vec3 axis = first.xyz / source.halfMetres;
        source.front = axis;
        precise float foot = -dot(middle, axis);
        source.foot = foot;
        precise vec3 outwards = -middle - foot * axis;
        source.away = length(outwards);
        vec3 radial = safeNormalize(outwards, anyPerpendicular(axis));
        precise vec3 across = radial - dot(radial, axis) * axis; // twice, since near the axis only rounding is left
        source.right = dot(across, across) > 0.25 ? normalize(across) : anyPerpendicular(axis);
        source.up = cross(axis, source.right);
        source.endSign = foot > source.halfMetres ? 1.0 : foot < -source.halfMetres ? -1.0 : 0.0;
        bool seesSide = source.away > source.size;
        precise float cosHalf = min(source.size / max(source.away, 1e-18), 1.0);
        precise float sinHalf = sqrt((1.0 - cosHalf) * (1.0 + cosHalf));
        if (seesSide) source.seenHalf = atan(sinHalf, cosHalf);
        source.isSeen = source.seenHalf > 0.0 || source.endSign != 0.0;
        return source;
    }
#endif
    precise vec3 faces = cross(first.xyz, second.xyz);
    source.isTwoSided = shinesFromBothSides(second.w);
    source.isSeen = source.isTwoSided || dot(faces, middle) < 0.0;
    source.front = safeNormalize(faces, vec3(0.0, 0.0, 1.0));
    if (dot(source.front, normal) < 0.0) source.front = -source.front;
    precise float height = dot(source.front, middle);
    source.height = height;
    source.right = first.xyz;
    source.up = second.xyz;
    float share = source.type == LIGHT_DISK ? kPi : 4.0;
#if HAS_POLYGON_LIGHTS
    if (source.type == LIGHT_POLYGON) share = first.w;
#endif
    precise float squareMetres = share * length(faces);
    source.size = squareMetres;
    return source;
}

// ---- Points on it ---------------------------------------------------------------------------------------------------

// Where a ray in a direction meets a light.
struct SeenPlace {
    vec3 toLight;  // unit
    float density; // of samples of the light's surface, 1/sr; below 0 if the light is not met
    vec2 within;   // flat: coordinates along its axes
};
const SeenPlace kNothingSeen = SeenPlace(vec3(0.0), -1.0, vec2(0.0));

SeenPlace flatPlace(AreaSource source, vec3 toLight, float distance, vec2 within)
{
    precise float facing = abs(source.height) / distance;
    precise float density = distance * distance / (source.size * facing);
    return SeenPlace(toLight, density, within);
}

SeenPlace flatSample(AreaSource source, vec2 point)
{
    precise vec2 within = 2.0 * point - 1.0;
#if HAS_DISK_LIGHTS
    if (source.type == LIGHT_DISK) {
        precise float radius = sqrt(point.x), angle = 2.0 * kPi * point.y;
        within = radius * vec2(cos(angle), sin(angle));
    }
#endif
#if HAS_POLYGON_LIGHTS
    if (source.type == LIGHT_POLYGON) within = polygonPlace(source.light, point);
#endif
    precise vec3 to = source.middle + within.x * source.right + within.y * source.up;
    precise float distance = length(to);
    // From within its plane the light is seen edge-on.
    if (!(distance > 0.0 && source.height != 0.0)) return kNothingSeen;
    precise vec3 toLight = to / distance;
    return flatPlace(source, toLight, distance, within);
}

SeenPlace flatSeen(AreaSource source, vec3 toLight)
{
    precise float facing = dot(toLight, source.front);
    if (facing == 0.0) return kNothingSeen;
    precise float distance = source.height / facing;
    if (!(distance >= 0.0)) return kNothingSeen;
    precise vec3 place = distance * toLight - source.middle;
    precise vec2 within = vec2(dot(place, source.right) / max(dot(source.right, source.right), 1e-36),
                               dot(place, source.up) / max(dot(source.up, source.up), 1e-36));
    bool isWithin = abs(within.x) <= 1.0 && abs(within.y) <= 1.0;
#if HAS_DISK_LIGHTS
    if (source.type == LIGHT_DISK) isWithin = dot(within, within) <= 1.0;
#endif
#if HAS_POLYGON_LIGHTS
    if (source.type == LIGHT_POLYGON)
        isWithin = isWithinPolygon(within, source.light, int(lightShapeTexel(source.light, LIGHT_SHAPE_TEXELS).z));
#endif
    if (!isWithin) return kNothingSeen;
    // A point within the light's plane and outline counts as on the side where the normal points, so that a light in
    // the surface's own plane does not light it. No sample of the light's surface finds such directions.
    if (source.height == 0.0) return facing < 0.0 ? SeenPlace(toLight, 0.0, within) : kNothingSeen;
    return flatPlace(source, toLight, distance, within);
}

#if HAS_SPHERE_LIGHTS
// Uniform in solid angle.
SeenPlace sphereSample(AreaSource source, vec2 point)
{
    precise float beside = point.x * source.size, angle = 2.0 * kPi * point.y;
    precise float sine = sqrt(max(beside * (2.0 - beside), 0.0));
    precise vec3 toLight = sine * cos(angle) * source.right + sine * sin(angle) * source.up + (1.0 - beside) * source.front;
    precise float density = 1.0 / (2.0 * kPi * source.size);
    return SeenPlace(toLight, density, vec2(0.0));
}

SeenPlace sphereSeen(AreaSource source, vec3 toLight)
{
    precise vec3 apart = toLight - source.front;
    // |a - b|^2 = 2 (1 - cos), which keeps its digits.
    if (!(dot(apart, apart) <= 2.0 * source.size)) return kNothingSeen;
    precise float density = 1.0 / (2.0 * kPi * source.size);
    return SeenPlace(toLight, density, vec2(0.0));
}
#endif

#if HAS_TUBE_LIGHTS
// Fraction of samples on the lateral surface: half if an end is visible too.
float mantleShare(AreaSource source)
{
    return !(source.seenHalf > 0.0) ? 0.0 : source.endSign != 0.0 ? 0.5 : 1.0;
}

// Angle that a tube's axis subtends. Samples along the axis are uniform in this angle, measured from the end that is
// farther from the foot: long and near tubes need it.
float tubeAngle(AreaSource source)
{
    float a = -source.halfMetres - source.foot, b = source.halfMetres - source.foot;
    precise float angle = atan(2.0 * source.halfMetres * source.away, source.away * source.away + a * b);
    return angle;
}

SeenPlace tubePlace(AreaSource source, vec3 to, vec3 normal, bool isEnd)
{
    precise float distance = length(to);
    if (!(distance > 0.0)) return kNothingSeen;
    precise vec3 toLight = to / distance;
    precise float facing = -dot(toLight, normal);
    if (!(facing > 0.0)) return kNothingSeen;
    float mantle = mantleShare(source);
    precise float perSquareMetre;
    if (isEnd) {
        perSquareMetre = (1.0 - mantle) / (kPi * source.size * source.size);
    } else {
        precise float height = dot(to - source.middle, source.front) - source.foot;
        precise float perMetre = source.away / ((source.away * source.away + height * height) * tubeAngle(source));
        perSquareMetre = mantle * perMetre / (2.0 * source.seenHalf * source.size);
    }
    precise float density = perSquareMetre * (distance * distance) / facing;
    return SeenPlace(toLight, density, vec2(0.0));
}

SeenPlace tubeSample(AreaSource source, vec2 point)
{
    float mantle = mantleShare(source);
    bool isEnd = !(point.x < mantle);
    vec3 normal, place;
    if (isEnd) {
        precise float radius = source.size * sqrt(clamp((point.x - mantle) / (1.0 - mantle), 0.0, 1.0));
        precise float angle = 2.0 * kPi * point.y;
        precise vec3 onEnd = source.endSign * source.halfMetres * source.front
                             + radius * (cos(angle) * source.right + sin(angle) * source.up);
        place = onEnd;
        normal = source.endSign * source.front;
    } else {
        precise float angle = (2.0 * point.x / mantle - 1.0) * source.seenHalf;
        precise vec3 out_ = cos(angle) * source.right + sin(angle) * source.up;
        normal = out_;
        float a = -source.halfMetres - source.foot, b = source.halfMetres - source.foot;
        // Measured from the farther end, whose sign keeps the divisor from cancelling.
        float end = abs(a) > abs(b) ? a : b;
        precise float turned = tan(point.y * tubeAngle(source)), slope = abs(end) / source.away;
        precise float back = turned >= 0.0 ? (abs(end) - source.away * turned) / (1.0 + slope * turned)
                                           : (abs(end) / turned - source.away) / (1.0 / turned + slope);
        precise float height = sign(end) * back;
        precise vec3 onMantle = (clamp(height + source.foot, -source.halfMetres, source.halfMetres)) * source.front
                                + source.size * out_;
        place = onMantle;
    }
    precise vec3 to = source.middle + place;
    return tubePlace(source, to, normal, isEnd);
}

SeenPlace tubeSeen(AreaSource source, vec3 toLight)
{
    float ahead;
    bool isEnd;
    bool meets = meetsTube(Ray(-source.middle, toLight), vec4(source.front, source.halfMetres), source.size, ahead, isEnd);
    if (!meets || !(ahead > 0.0)) return kNothingSeen;
    precise vec3 to = ahead * toLight;
    precise vec3 place = to - source.middle;
    precise vec3 across = place - dot(place, source.front) * source.front;
    vec3 normal = isEnd ? source.endSign * source.front : across / max(length(across), 1e-18);
    return tubePlace(source, to, normal, isEnd);
}
#endif

SeenPlace sampleOf(AreaSource source, vec2 point)
{
#if HAS_SPHERE_LIGHTS
    if (source.type == LIGHT_SPHERE) return sphereSample(source, point);
#endif
#if HAS_TUBE_LIGHTS
    if (source.type == LIGHT_TUBE) return tubeSample(source, point);
#endif
    return flatSample(source, point);
}

SeenPlace seenIn(AreaSource source, vec3 toLight)
{
    if (toLight == vec3(0.0)) return kNothingSeen; // no direction was found
#if HAS_SPHERE_LIGHTS
    if (source.type == LIGHT_SPHERE) return sphereSeen(source, toLight);
#endif
#if HAS_TUBE_LIGHTS
    if (source.type == LIGHT_TUBE) return tubeSeen(source, toLight);
#endif
    return flatSeen(source, toLight);
}

// ---- Surfaces -------------------------------------------------------------------------------------------------------

// Point k of AREA_SAMPLES in the unit square: one per column, with rows spaced by the golden ratio, all shifted by the
// same random numbers.
vec2 stratifiedPoint(int k, vec2 random)
{
    precise float column = (float(k) + random.x) * (1.0 / float(AREA_SAMPLES));
    precise float row = fract(random.y + 0.61803399 * float(k));
    return vec2(min(column, 0.99999994), row);
}

// Weighted contribution of the light in a direction, for unit radiance; callers divide by the samples of each kind.
vec3 worthOf(SeenPlace place, AreaSource source, SeenSurface seen)
{
    if (!(place.density >= 0.0)) return vec3(0.0);
    precise float density = place.density + surfaceDensity(seen, place.toLight);
    if (!(density > 0.0)) return vec3(0.0);
    precise vec3 light = layeredBrdfCosine(seen, place.toLight) / density;
#if HAS_LIGHT_PICTURES
    int picture = lightPictureOf(lightShapeTexel(source.light, 1).w);
    if (picture >= 0)
        light *= lightPictureLevel(picture, 0, vec2(0.5 + 0.5 * place.within.x, 0.5 - 0.5 * place.within.y));
#endif
    return light;
}

// Radiance towards the viewer from area light `index`, reflected by a surface. `toLightLS` and `smallIrradiance`, which
// belong to the light's centre, are unused.
vec3 areaLightOnSurface(int index, int kind, SeenSurface seen, Viewpoint viewpoint, vec3 toLightLS, vec3 smallIrradiance)
{
    vec4 place = lightTexel(index, 0);
    precise vec3 middle = place.xyz - viewpoint.positionLS;
    precise float reach = dot(middle, middle) * place.w;
    precise float window = 1.0 - reach * reach;
    AreaSource source = areaSource(index, kind, middle, seen.surface.normalLS);
    if (!source.isSeen) return vec3(0.0);
    // Independent of the random numbers of shadows, so that the mean of their product is the product of the means.
    vec2 random = unitOf(hashOf(uvec3(uvec2(viewpoint.pixel), uint(index) + 0x7f4a7c15u)).xy);
    vec3 normal = seen.surface.normalLS;
    vec3 tangent = sampledTangent(seen);
    bool samplesLobe = hasLobe(seen);
    precise vec3 sum = vec3(0.0);
    int k = 0;
    for (; k < AREA_SAMPLES; ++k) {
        vec2 point = stratifiedPoint(k, random);
        sum += worthOf(sampleOf(source, point), source, seen);
        sum += worthOf(seenIn(source, cosineDirection(point, normal, tangent)), source, seen);
        if (samplesLobe) sum += worthOf(seenIn(source, lobeDirection(point, seen, tangent)), source, seen);
#if HAS_CLEARCOAT && !SPECULAR_OFF
        if (seen.surface.coatFactor > 0.0 && seen.coatNv > 0.0)
            sum += worthOf(seenIn(source, coatDirection(point, seen)), source, seen);
#endif
    }
    if (k < AREA_SAMPLES) return vec3(CUT_LOOP);
    precise vec3 light = sum * (window * window / float(AREA_SAMPLES)) * lightTexel(index, 1).rgb;
    return light;
}
