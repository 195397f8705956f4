// The image that bodies of glass look up: rgb radiance times the coverage a. The background, where nothing was drawn,
// is left out.
#include "shared/slots.h"
#include "lib/raster/depth_step.glsl"

#if SAMPLES > 1
layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2DMS radianceImage;
layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2DMS depthImage;
layout(location = 1) out float behindDepth;
#else
layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2D radianceImage;
#endif
layout(location = 0) out vec4 behind;

vec4 covered(vec4 radiance)
{
    return radiance.a > 0.0 ? vec4(radiance.rgb * radiance.a, radiance.a) : vec4(0.0);
}

#if SAMPLES > 1
float firstDepth(ivec2 pixel)
{
    return texelFetch(depthImage, clamp(pixel, ivec2(0), textureSize(depthImage) - 1), 0).r;
}

// Depth of the first sample's surface at the pixel's centre, where rays are compared with it; within the depths of the
// samples.
float depthAtCentre(ivec2 pixel)
{
    const vec2 kPlaces[SAMPLES] = vec2[](SAMPLE_PLACES); // from the pixel's lower left corner
    float first = firstDepth(pixel), least = first, most = first;
    if (!(first > 0.0)) return first;
    for (int i = 1; i < SAMPLES; ++i) {
        float depth = texelFetch(depthImage, pixel, i).r;
        least = depth > 0.0 ? min(least, depth) : least;
        most = max(most, depth);
    }
    vec2 slope = vec2(stepOnSurface(firstDepth(pixel - ivec2(1, 0)), first, firstDepth(pixel + ivec2(1, 0))),
                      stepOnSurface(firstDepth(pixel - ivec2(0, 1)), first, firstDepth(pixel + ivec2(0, 1))));
    precise float centre = first - dot(slope, kPlaces[0] - 0.5);
    return clamp(centre, least, most);
}
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if SAMPLES > 1
    precise vec4 sum = covered(texelFetch(radianceImage, pixel, 0));
    for (int i = 1; i < SAMPLES; ++i) sum += covered(texelFetch(radianceImage, pixel, i));
    precise vec4 mean = sum * (1.0 / float(SAMPLES));
    behind = mean;
    behindDepth = depthAtCentre(pixel);
#else
    behind = covered(texelFetch(radianceImage, pixel, 0));
#endif
}
