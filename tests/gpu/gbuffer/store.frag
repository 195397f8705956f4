// Stores one surface per pixel, read from a list.
#define GBUFFER_WRITE
#include "lib/gbuffer/gbuffer.glsl"

// Nine vec4 a surface: (albedo, metallic), (normal, alpha), (specular, ior or F90), (emission, model), (normal texel, exponent),
// (tangent, alpha along the bitangent), (octahedral normal of the coat, factor, alpha), (sheen colour, alpha), (masking, 0, 0, 0).
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };

void main()
{
    int i = (int(gl_FragCoord.y) * WIDTH + int(gl_FragCoord.x)) * 9;
    Surface surface;
    surface.albedo = inputs[i].rgb;
    surface.metallic = inputs[i].w;
    surface.normalLS = inputs[i + 1].xyz;
    surface.alpha = inputs[i + 1].w;
    surface.specular = inputs[i + 2].rgb;
    surface.iorOrF90 = inputs[i + 2].w;
    surface.emission = inputs[i + 3].rgb;
    surface.model = uint(inputs[i + 3].w);
    surface.normalTexel = inputs[i + 4].rgb;
    surface.parameter = inputs[i + 4].w;
    surface.tangentLS = inputs[i + 5].xyz;
    surface.alphaBitangent = inputs[i + 5].w;
    surface.coatNormalCode = inputs[i + 6].xy;
    surface.coatFactor = inputs[i + 6].z;
    surface.coatAlpha = inputs[i + 6].w;
    surface.sheenColor = inputs[i + 7].rgb;
    surface.sheenAlpha = inputs[i + 7].w;
    surface.masking = uint(inputs[i + 8].x);
    writeGBuffer(surface);
}
