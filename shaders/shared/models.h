#pragma once
// Ids of the material models as the G-buffer stores them; scenes::MaterialModel has the same order.
#include "interop.h"

#define MODEL_SINGLE_COLOR 0u
#define MODEL_LAMBERT 1u
#define MODEL_BLINN_PHONG 2u
#define MODEL_MICROFACET 3u
#define MODEL_MICROFACET_ANISOTROPIC 4u
#define MODEL_METALLIC_ROUGHNESS 5u

// How the microfacet models hide microfacets from each other; scenes::Masking has the same order.
#define MASKING_WALTER 0u
#define MASKING_DIRECTIONAL 1u
#define MASKING_HALF_VECTOR 2u

// The floor of GGX alpha on every path, the reference included: below it D's denominator leaves fp32's range at the
// peak.
#define ALPHA_MIN 1e-3
