// Depth alone; only alpha-masked materials have anything to decide.
#if HAS_ALPHA_MASK
#include "lib/rasterised.glsl"
#endif

void main()
{
#if HAS_ALPHA_MASK
    if (materialCutOut(materialBaseColor(rasterisedFragment()))) discard;
#endif
}
