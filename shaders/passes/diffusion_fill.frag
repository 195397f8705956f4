// Copies an object's light to the next level; texels outside charts get it from where the surface continues.
#include "passes/filled_light.glsl"

layout(binding = TEXTURE_UNIT_DIFFUSION_LIGHT) uniform sampler2D light;

layout(location = 0) out vec4 filled;

vec4 lightAt(ivec2 texel)
{
    return texelFetch(light, texel, 0);
}

void main()
{
    filled = filledLightAt(ivec2(gl_FragCoord.xy));
}
