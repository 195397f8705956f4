#pragma once
#include "renderer/frame/Features.h"

/// Which features (Features.h) the materials of a scene have.
namespace tessera::frame {

/// Whether the material's model has masking options.
bool canMask(const scenes::Material& material);

/// Whether the material may scatter transmitted light, which blurs the image behind it.
bool mayScatter(const scenes::Material& material);

/// Whether some material in use needs refracted rays: one with a volume, or one that scatters.
bool mayLookBehindGlass(const scenes::Scene& scene);

/// Whether the material transmits light with a lobe that may be broader than a mirror's.
bool mayPassByLobe(const scenes::Material& material);

/// The features of the materials in use. packLights adds those of visible lights and their shadows, makeFrameSpec those
/// of the camera.
FeatureSet materialFeatures(const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface = {});

/// The Lambert material that determines the irradiance on a diffusing material; matches takeEnteredValues() of
/// shaders/passes/diffusion_light.frag.
scenes::Material enteredMaterial(const scenes::Material& material);

/// The features that determine the irradiance on a mesh with a material (Feature::SubsurfaceDiffusion): those of
/// enteredMaterial() and of masked casters.
FeatureSet enteringFeatures(const scenes::Scene& scene, int material, int mesh);

/// The features that surfaces are built for: materialFeatures() with `prune`, else allFeatures().
FeatureSet surfaceFeatures(const scenes::Scene& scene, bool prune, scenes::SubsurfaceRequest subsurface);

} // namespace tessera::frame
