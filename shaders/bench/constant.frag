// Writes a constant wherever there is geometry; only alpha-masked materials discard.
#if HAS_ALPHA_MASK
#include "lib/raster/rasterised.glsl"
#endif

layout(location = 0) out vec4 value;

void main()
{
#if HAS_ALPHA_MASK
    if (materialCutOut(materialBaseColor(rasterisedFragment()))) discard;
#endif
    value = vec4(1.0);
}
