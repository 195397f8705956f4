#pragma once
#include <span>
#include <string>
#include <vector>

#include "apps/Request.h"
#include "base/Picture.h"

/// What commands and scripts have in common that make a picture.
namespace tessera::app {

/// Why a picture (RGBA, A the share of a pixel that is covered) shows nothing of its scene or is black, or how many of
/// its pixels are no numbers; empty: none of these. `cut` says how shadows may have made pixels NaN, or nothing.
std::string faultOf(const scenes::Scene& scene, frame::DebugView view, std::span<const float> rgba,
                    const std::string& cut);

/// Settings as the reference takes them where no filter is asked for: the exact one. Throws InputError where it takes
/// them not.
void settleForReference(const FrameOptions& options, frame::FrameSettings& settings);
/// Which settings were said and change nothing of the reference's pictures: a sentence or two each.
std::vector<std::string> unheededByReference(const FrameOptions& options, const Request& request);

} // namespace tessera::app
