// What several features of a scene have in common; HAS_* of each comes from its table (renderer/frame/Features.cpp).
#pragma once

// Models whose highlight is computed, not only whose diffuse share.
#define HAS_GLOSSY_MODELS (HAS_BLINN_PHONG || HAS_MICROFACET || HAS_MICROFACET_ANISOTROPIC || HAS_METALLIC_ROUGHNESS)
// Surfaces that keep a tangent.
#define HAS_TANGENT_FRAME (HAS_MICROFACET_ANISOTROPIC || HAS_ANISOTROPY)
// Meshes that bring their tangents.
#define HAS_TANGENTS (HAS_TANGENT_SPACE_NORMALS || HAS_TANGENT_FRAME || HAS_CLEARCOAT_NORMAL_TEXTURE)
