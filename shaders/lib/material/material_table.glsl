// Values of surfaces whose pixels store only the number of their material: computed as at rasterisation, by the same
// functions from the same constants.
#pragma once
#define MATERIAL_FROM_TABLE 1
#include "lib/material/material.glsl"

// MATERIAL_TEXELS per material, in member order. Read as integers: some members are, and floats keep their bits.
layout(binding = TEXTURE_UNIT_MATERIALS) uniform usamplerBuffer materialTable;

vec4 tabledConstants(int number, int texel)
{
    return uintBitsToFloat(texelFetch(materialTable, number * MATERIAL_TEXELS + texel));
}

void setTabledValues(int number, inout Surface surface)
{
    material.baseColor = tabledConstants(number, 0);
    material.emissive = tabledConstants(number, 1);
    material.microsurface = tabledConstants(number, 2);
    material.specular = tabledConstants(number, 3);
    material.mixed = tabledConstants(number, 4);
    material.anisotropy = tabledConstants(number, 5);
    material.clearcoat = tabledConstants(number, 6);
    material.sheen = tabledConstants(number, 7);
    material.kind = texelFetch(materialTable, number * MATERIAL_TEXELS + 8);
    Fragment fragment = plainFragment();
    setMaterialValues(fragment, materialBaseColor(fragment), surface);
}
