#pragma once
// What shaders and C++ share of the material models; their numbers come from the table scenes::materialModels() as
// defines (renderer/frame/FeatureDefines.h).
#include "interop.h"

// How the microfacet models hide microfacets from each other; scenes::Masking has the same order.
#define MASKING_WALTER 0u
#define MASKING_DIRECTIONAL 1u
#define MASKING_HALF_VECTOR 2u
#define MASKING_COUNT 3u

// The minimum of GGX alpha on every path, the reference included: below it D's denominator leaves fp32's range at the
// peak.
#define ALPHA_MIN 1e-3
