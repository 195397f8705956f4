#pragma once
// Constants of the material models shared by C++ and GLSL; the numbers of the models are defines from the table
// scenes::materialModels() (renderer/frame/FeatureDefines.h).
#include "interop.h"

// Masking-shadowing options of the microfacet models, in the order of scenes::Masking.
#define MASKING_WALTER 0u
#define MASKING_DIRECTIONAL 1u
#define MASKING_HALF_VECTOR 2u
#define MASKING_COUNT 3u

// Minimum GGX alpha on every path, including the reference: below it D's denominator leaves fp32's range at the peak.
#define ALPHA_MIN 1e-3
