#pragma once
#include <string>

#include "engine/Settings.h"
#include "engine/Techniques.h"
#include "renderer/frame/PreparedView.h"

namespace tessera::engine {

/// Throws InputError when the settings name a camera or light that the scene lacks, a size or number of samples that no
/// picture has, a range tolerance that is negative or not finite, or a setting that the technique cannot draw. Whoever
/// draws the view hands over the scene's bounds.
frame::PreparedView prepareView(const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings,
                                std::span<const frame::SurfaceBounds> bounds = {});

/// Throws InputError where views differ in a setting that all views of a frame share (Setting::isOfFrame), and
/// std::logic_error where there is no view.
void requireOneFrame(std::span<const ViewRequest> views);

/// Which lights cast no shadows, since the budget has no room for their maps, and what to do; empty: none.
std::string lostShadows(const frame::ShadowMaps& maps, const frame::FrameSettings& settings);
/// Why the view shows fewer shadows than were asked for; empty: it shows them all.
/// `bounds` are of everything drawn.
std::string missingShadows(const scenes::Scene& scene, std::span<const frame::SurfaceBounds> bounds,
                           const frame::PreparedView& prepared);
/// Over which objects light is asked to spread and does not, since their texels are larger than all widths of their
/// profiles, and what to do; empty: over none.
std::string unseenSpread(const scenes::Scene& scene, const frame::PreparedView& prepared);
/// Warning: loops of shadows or of area light samples may exceed Mesa's iteration limit. `why` names cause and remedy;
/// it is empty within the limit.
struct CutShadows {
    std::string why;
    std::size_t iterations = 0;
};
CutShadows cutShadows(const frame::PreparedView& prepared);

/// The camera that the settings ask for, where they put it.
scenes::Camera frameCamera(const scenes::Scene& scene, const frame::FrameSettings& settings);

} // namespace tessera::engine
