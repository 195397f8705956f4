#pragma once
#include "renderer/frame/Features.h"

/// Which features (Features.h) the materials of a scene have.
namespace tessera::frame {

/// Whether its model has options of masking.
bool canMask(const scenes::Material& material);

/// Whether the material may spread light that passes through it, so that what is behind is blurred.
bool mayScatter(const scenes::Material& material);

/// Whether some material in use shows by rays what is behind it: one with a body, or one that scatters.
bool mayLookBehindGlass(const scenes::Scene& scene);

/// Whether light passes through the material and its lobe may be broader than a mirror.
bool mayPassByLobe(const scenes::Material& material);

/// The features of the materials in use. packLights adds those of visible lights and their shadows, makeFrameSpec those
/// of the camera.
FeatureSet materialFeatures(const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface = {});

/// What of a material decides the light that enters it, as one that reflects alike to all sides: what
/// takeEnteredValues() of shaders/passes/diffusion_light.frag leaves of its surface.
scenes::Material enteredMaterial(const scenes::Material& material);

/// What decides the light that enters a mesh with a material (Feature::SubsurfaceDiffusion), as the features of one
/// that reflects it alike to all sides.
FeatureSet enteringFeatures(const scenes::Scene& scene, int material, int mesh);

/// What surfaces are built for: the first where what the scene does not need is left out, else the second.
FeatureSet surfaceFeatures(const scenes::Scene& scene, bool prune, scenes::SubsurfaceRequest subsurface);

} // namespace tessera::frame
