#pragma once
#include <vector>

#include "engine/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/frame/PackedLights.h"
#include "renderer/graph/Plan.h"

namespace tessera::engine {

bool supportsMethod(Technique technique, culling::Method method);

/// Whether a technique uses light lists.
bool hasLightLists(Technique technique);
/// Whether it builds them after a G-buffer, which provides normals.
bool listsFromGBuffer(Technique technique);

/// Resolves the light culling of a frame: the requested method, which the technique must support, else the technique's
/// preferred one; none if nothing can be culled (settings.prune).
culling::Choice chooseCulling(Technique technique, const frame::FrameSettings& settings,
                              const frame::FeatureSet& features, const frame::PackedLights& lights);

/// Describes the choice for a plan; empty for techniques without lists.
std::vector<graph::Plan::Choice> cullingChoices(Technique technique, const frame::FrameSettings& settings,
                                                const frame::FeatureSet& features, const culling::Choice& choice);

} // namespace tessera::engine
