// How a material texture is read. `hardware` is what the sampler says (mipmaps, anisotropy). `exact` is bilinear at level 0
// computed in fp32 from fetched texels, the definition that the double-precision reference shares: hardware bilinear of
// 8-bit textures may be off by 3.5e-3, and the choice of level is the implementation's.
#pragma once

// A texel index brought into 0 .. size-1; mode is the Wrap of scenes::Sampler.
int wrapTexel(int index, int size, int mode)
{
    if (mode == 1) return clamp(index, 0, size - 1);
    int period = mode == 2 ? 2 * size : size;
    int inside = index % period;
    if (inside < 0) inside += period;
    return inside < size ? inside : period - 1 - inside;
}

vec4 sampleFiltered(sampler2D image, vec2 uv, int wrapModes)
{
#if FILTER_EXACT
    ivec2 size = textureSize(image, 0);
    precise vec2 place = uv * vec2(size) - 0.5;
    precise vec2 corner = floor(place);
    precise vec2 weight = place - corner;
    int modeU = wrapModes & 3;
    int modeV = wrapModes >> 2;
    int x0 = wrapTexel(int(corner.x), size.x, modeU);
    int x1 = wrapTexel(int(corner.x) + 1, size.x, modeU);
    int y0 = wrapTexel(int(corner.y), size.y, modeV);
    int y1 = wrapTexel(int(corner.y) + 1, size.y, modeV);
    precise vec4 upper = texelFetch(image, ivec2(x0, y0), 0) * (1.0 - weight.x) + texelFetch(image, ivec2(x1, y0), 0) * weight.x;
    precise vec4 lower = texelFetch(image, ivec2(x0, y1), 0) * (1.0 - weight.x) + texelFetch(image, ivec2(x1, y1), 0) * weight.x;
    precise vec4 texel = upper * (1.0 - weight.y) + lower * weight.y;
    return texel;
#else
    return texture(image, uv);
#endif
}
