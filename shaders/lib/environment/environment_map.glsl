// Environment map in latitude and longitude (scenes/Environment.h), interpolated in full precision.
#pragma once
#include "lib/environment/environment_constants.glsl"
#include "lib/maths/math.glsl"

// rgb radiance; a, if samples are taken, their density in 1/sr.
layout(binding = TEXTURE_UNIT_ENVIRONMENT) uniform sampler2D environmentMap;

// Position of a map direction, in texels from the left and from the top.
vec2 mapPlace(vec3 direction, ivec2 size)
{
    precise float level = sqrt(dot(direction.xz, direction.xz));
    precise float longitude = level > 0.0 ? atan(direction.x, -direction.z) : 0.0;
    precise float fromTop = atan(level, direction.y);
    precise vec2 place = vec2(0.5 + longitude * (0.5 * kInversePi), fromTop * kInversePi) * vec2(size);
    return place;
}

// rgb radiance in a direction of the map; a sample density of the texel that contains it.
vec4 mapRadiance(vec3 direction)
{
    ivec2 size = textureSize(environmentMap, 0);
    precise vec2 place = mapPlace(direction, size) - 0.5;
    ivec2 corner = ivec2(floor(place));
    precise vec2 share = place - vec2(corner);
    int left = corner.x < 0 ? size.x - 1 : min(corner.x, size.x - 1), right = left + 1 < size.x ? left + 1 : 0;
    int top = clamp(corner.y, 0, size.y - 1), bottom = clamp(corner.y + 1, 0, size.y - 1);
    vec4 a = texelFetch(environmentMap, ivec2(left, top), 0), b = texelFetch(environmentMap, ivec2(right, top), 0);
    vec4 c = texelFetch(environmentMap, ivec2(left, bottom), 0), d = texelFetch(environmentMap, ivec2(right, bottom), 0);
    precise vec3 above = a.rgb + share.x * (b.rgb - a.rgb), below = c.rgb + share.x * (d.rgb - c.rgb);
    precise vec3 radiance = above + share.y * (below - above);
    vec2 column = share.y < 0.5 ? vec2(a.a, b.a) : vec2(c.a, d.a);
    return vec4(radiance, share.x < 0.5 ? column.x : column.y);
}
