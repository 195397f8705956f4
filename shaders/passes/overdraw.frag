// Counts the fragments that a pass would shade or store at a pixel: blending adds them up.
#include "lib/raster/rasterised.glsl"
#include "lib/raster/coverage.glsl"

layout(location = 0) out vec4 surfaces;

void main()
{
    if (coversNothing(materialBaseColor(rasterisedFragment()))) discard;
    surfaces = vec4(1.0);
}
