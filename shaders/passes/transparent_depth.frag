// Nearest shading depth of transparent surfaces, and the farthest negated; the target keeps the maximum of each.
#include "lib/raster/shading_place.glsl"

layout(location = 0) out vec2 depths;

void main()
{
    float depth = shadingPlace().depth;
    depths = vec2(depth, -depth);
}
