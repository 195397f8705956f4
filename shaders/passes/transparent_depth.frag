// Nearest depth at which a transparent surface is lit, and farthest negated; the target keeps the larger of each.
#include "lib/raster/shading_place.glsl"

layout(location = 0) out vec2 depths;

void main()
{
    float depth = shadingPlace().depth;
    depths = vec2(depth, -depth);
}
