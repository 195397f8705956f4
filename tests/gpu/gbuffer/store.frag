// Stores one surface a pixel, taken from a list.
#define GBUFFER_WRITE
#include "lib/gbuffer.glsl"

// Five vec4 a surface: (albedo, metallic), (normal, alpha), (specular, ior or F90), (emission, model),
// (normal texel, 0).
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };

void main()
{
    int i = (int(gl_FragCoord.y) * WIDTH + int(gl_FragCoord.x)) * 5;
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
    writeGBuffer(surface);
}
