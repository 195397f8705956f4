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

/// The radius in metres of the ball around its position that the surface of a packed area light lies in; of other types
/// 0.
float surfaceReachMetres(scenes::LightType type, const shared::LightShapeTexels& shape);

/// Puts a corner of an outline into vectors of two each, as shaders read them: one in xy and the next in zw.
void packCorner(std::span<glm::vec4> pairs, std::size_t number, const glm::vec2& corner);

/// The lights of one frame as the GPU reads them: those that casters may hide, then the others, each in document order.
/// Lights that cannot change the picture are left out.
struct PackedLights {
    std::vector<shared::LightTexels> texels;
    std::vector<shared::LightShapeTexels> shapes;   ///< parallel to texels
    std::vector<shared::LightCornerTexels> corners; ///< where any is a polygon parallel to texels, else empty
    std::vector<shared::LightShadowTexels> shadows; ///< parallel to texels
    std::vector<ShownPicture> pictures;             ///< of all the scene's lights, whether they are packed or not
    std::vector<int> sceneIndex;                    ///< parallel to texels: index into Scene::lights
    FeatureSet features;                            ///< the light types and falloffs among them
    int shown = 0; ///< index into texels of the light that views of one light show: the first that is on,
                   ///< or with showsShadowsOfOne() the first of them that also casts shadows and reaches what
                   ///< is in view, if any; texels.size() when it is left out, since it then reaches nothing
    std::size_t everywhere = 0; ///< those among texels without a range
    std::size_t shadowed = 0;   ///< those among texels that casters may hide
    std::size_t off = 0;        ///< left out: disabled, or not the solo light
    std::size_t dark = 0;       ///< left out: no intensity, no range, no cone or no surface
    std::size_t unseen = 0;     ///< left out: the range ends outside the view
    TruncatedLights truncated;  ///< what settings.rangeTolerance did to those that are on, left out or not
};

/// Packs the scene's lights as they are at settings.timeSeconds. Without settings.prune only lights that are off are
/// left out: dark and unseen ones are evaluated and add exactly 0.
PackedLights packLights(const scenes::Scene& scene, const CameraView& view, const FrameSettings& settings);

} // namespace tessera::frame
