#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/Features.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/frame/LightPictures.h"
#include "renderer/frame/LightRange.h"
#include "scenes/Scene.h"
#include "shaders/shared/light.h"

namespace tessera::frame {

/// The type of a packed light.
scenes::LightType typeOf(const shared::LightTexels& light);

/// Bounding radius in metres of a packed area light's surface around its position; 0 for other types.
float surfaceReachMetres(scenes::LightType type, const shared::LightShapeTexels& shape);

/// Stores an outline's corner in vectors of two corners, as shaders read them: even numbers in xy, odd ones in zw.
void packCorner(std::span<glm::vec4> pairs, std::size_t number, const glm::vec2& corner);

/// The lights of one frame as the GPU reads them: first those with shadows, then the others, each in document order.
/// Lights that cannot change the image are left out.
struct PackedLights {
    std::vector<shared::LightTexels> texels;
    std::vector<shared::LightShapeTexels> shapes;   ///< parallel to texels
    std::vector<shared::LightCornerTexels> corners; ///< parallel to texels if any light is a polygon, else empty
    std::vector<shared::LightShadowTexels> shadows; ///< parallel to texels
    std::vector<ShownPicture> pictures;             ///< textures of all the scene's lights, packed or not
    std::vector<int> sceneIndex;                    ///< parallel to texels: index into Scene::lights
    FeatureSet features;                            ///< the light types and falloffs among them
    int shown = 0; ///< index into texels of the light that views of one light show: the first that is on, or with
                   ///< showsShadowsOfOne() the first one that also casts shadows and may light the view, if any;
                   ///< texels.size() if it is left out, since it lights nothing then
    std::size_t everywhere = 0; ///< lights of unlimited range among texels
    std::size_t shadowed = 0;   ///< lights with shadows among texels
    std::size_t off = 0;        ///< left out: disabled, or not the solo light
    std::size_t dark = 0;       ///< left out: no intensity, no range, no cone or no surface
    std::size_t unseen = 0;     ///< left out: the range ends outside the view
    TruncatedLights truncated;  ///< effect of settings.rangeTolerance on the lights that are on, left out or not
};

/// Packs the scene's lights as they are at settings.timeSeconds. Without settings.prune only lights that are off are
/// left out: dark and unseen ones are evaluated and add exactly 0.
PackedLights packLights(const scenes::Scene& scene, const CameraView& view, const FrameSettings& settings);

} // namespace tessera::frame
