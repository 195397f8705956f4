// Draws the surface of an area light: its radiance and depth where the ray of the pixel, or of the sample, meets it.
#include "shared/slots.h"
#include "shared/seen_lights.h"
#include "shared/light_pictures.h"
#if SEEN_PICTURES
#include "lib/light/light_picture.glsl"
#endif
#include "lib/surface/camera.glsl"

layout(binding = TEXTURE_UNIT_SEEN_LIGHTS) uniform samplerBuffer seenLightTexels;
layout(location = 0) flat in int light;
layout(location = 0) out vec4 radiance;

vec2 cornerOf(int texel, int corner)
{
    vec4 two = texelFetch(seenLightTexels, texel + 5 + corner / 2);
    return (corner & 1) == 0 ? two.xy : two.zw;
}
#define HAS_CORNERS 1
#include "lib/light/area_hits.glsl"

// Intersection with a rectangle, a disk or a polygon, from an emitting side.
bool meetsFlat(Ray ray, int type, int texel, vec4 along, vec4 across, bool isTwoSided, out float ahead, out vec2 within)
{
    within = vec2(0.0);
    precise vec3 front = cross(along.xyz, across.xyz);
    precise float facing = -dot(ray.direction, front);
    if (isTwoSided ? facing == 0.0 : !(facing > 0.0)) return false;
    precise float met = dot(ray.start, front) / facing;
    ahead = met;
    precise vec3 place = ray.start + met * ray.direction;
    precise vec2 metres = vec2(dot(place, along.xyz), dot(place, across.xyz));
    within = metres;
    if (type == LIGHT_POLYGON) return isWithinPolygon(within, texel, int(along.w));
    return type == LIGHT_DISK ? dot(within, within) <= along.w * along.w
                              : abs(within.x) <= along.w && abs(within.y) <= across.w;
}

void main()
{
#if SAMPLES > 1
    precise vec2 pixel = floor(gl_FragCoord.xy) + gl_SamplePosition;
#else
    precise vec2 pixel = gl_FragCoord.xy;
#endif
    int texel = light * SEEN_LIGHT_TEXELS;
    vec4 shown = texelFetch(seenLightTexels, texel + 1), middle = texelFetch(seenLightTexels, texel + 2);
    vec4 along = texelFetch(seenLightTexels, texel + 3), across = texelFetch(seenLightTexels, texel + 4);

    vec2 spread = raySpread();
    precise vec3 acrossView = acrossOfPixel(pixel);
    // A point of the ray at `ahead` lies `ahead` metres ahead of the origin of lighting space.
    precise vec3 start = spread.x * acrossView - middle.xyz;
    precise vec3 direction = spread.y * acrossView + view.forwardLS.xyz;
    Ray ray = Ray(start, direction);

    int type = int(middle.w);
    float ahead;
    vec2 within = vec2(0.0);
    bool meets, isEnd;
    if (type == LIGHT_SPHERE)
        meets = meetsRound(ray, across.w, ahead);
    else if (type == LIGHT_TUBE)
        meets = meetsTube(ray, along, across.w, ahead, isEnd);
    else
        meets = meetsFlat(ray, type, texel, along, across, shinesFromBothSides(shown.w), ahead, within);
    if (!meets) discard;
    // Nothing is drawn in front of the near plane or behind the far plane. A surface that is entered behind the eye is
    // seen from inside, where it emits nothing.
    float depth = depthFromAhead(ahead);
    if (!(depth >= 0.0 && depth <= 1.0)) discard;
    gl_FragDepth = depth;
    radiance = vec4(shown.rgb, 1.0);
#if SEEN_PICTURES
    int picture = lightPictureOf(shown.w);
    if (picture >= 0) {
        precise vec2 place = within / vec2(type == LIGHT_POLYGON ? across.w : along.w, across.w);
        radiance.rgb *= lightPictureLevel(picture, 0, vec2(0.5 + 0.5 * place.x, 0.5 - 0.5 * place.y));
    }
#endif
}
