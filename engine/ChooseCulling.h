#pragma once
#include <vector>

#include "engine/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/frame/PackedLights.h"
#include "renderer/graph/Plan.h"

namespace tessera::engine {

bool takesMethod(Technique technique, culling::Method method);

/// Whether a technique lights from light lists at all.
bool hasLightLists(Technique technique);
/// Whether it builds them once a G-buffer tells the surfaces' normals.
bool listsFromGBuffer(Technique technique);

/// How a frame culls lights: the requested method, which the technique must take, else the fastest one measured on the
/// backend; none where nothing can be culled (settings.prune).
culling::Choice chooseCulling(Technique technique, const frame::FrameSettings& settings,
                              const frame::FeatureSet& features, const frame::PackedLights& lights);

/// The same in words, for a plan; empty for techniques without lists.
std::vector<graph::Plan::Choice> cullingChoices(Technique technique, const frame::FrameSettings& settings,
                                                const frame::FeatureSet& features, const culling::Choice& choice);

} // namespace tessera::engine
