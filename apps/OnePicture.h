#pragma once
#include <span>
#include <string>
#include <vector>

#include "apps/Request.h"
#include "base/Picture.h"

/// Functions shared by the commands and scripts that render an image.
namespace tessera::app {

/// Warning about an image (RGBA; A: covered fraction of the pixel) that shows nothing of its scene, is black, or has
/// NaN or infinite pixels; empty: none of these. `cut`: how truncated shadow loops may have caused NaN, or empty.
std::string faultOf(const scenes::Scene& scene, frame::DebugView view, std::span<const float> rgba,
                    const std::string& cut);

/// Selects exact texture filtering unless a filter is given. Throws InputError for settings that the reference does not
/// support.
void settleForReference(const FrameOptions& options, frame::FrameSettings& settings);
/// Warnings for given settings that do not affect the reference's images: one or two sentences each.
std::vector<std::string> unusedByReference(const FrameOptions& options, const Request& request);

} // namespace tessera::app
