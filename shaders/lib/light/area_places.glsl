// Uniform sampling of polygons.
#pragma once
#include "lib/light/light_store.glsl"

#if HAS_POLYGON_LIGHTS
// Maps a point of the unit square to the polygon; its column selects the triangle.
vec2 polygonPlace(int light, vec2 place)
{
    vec4 first = lightShapeTexel(light, LIGHT_SHAPE_TEXELS + 5), second = lightShapeTexel(light, LIGHT_SHAPE_TEXELS + 6);
    int triangle = int(place.x >= first.x) + int(place.x >= first.y) + int(place.x >= first.z) + int(place.x >= first.w)
                   + int(place.x >= second.x);
    float begin = triangle == 0 ? 0.0 : first[clamp(triangle, 1, 4) - 1];
    if (triangle == 5) begin = second.x;
    float end = triangle < 4 ? first[triangle] : triangle == 4 ? second.x : 1.0;
    int numbers = int(triangle < 2 ? second.y : triangle < 4 ? second.z : second.w);
    if ((triangle & 1) == 1) numbers >>= 9;
    vec2 a = lightCorner(light, numbers & 7), b = lightCorner(light, (numbers >> 3) & 7),
         c = lightCorner(light, (numbers >> 6) & 7);
    precise float root = sqrt(clamp((place.x - begin) / max(end - begin, 1e-18), 0.0, 1.0));
    precise vec2 opposite = b + place.y * (c - b);
    precise vec2 inTriangle = a + root * (opposite - a);
    return inTriangle;
}
#endif
